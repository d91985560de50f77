"""Growing arrays of an archive, and the texts that go with them, by HDF5's own calls.

A step writes a few rows into each of some hundred arrays; the layer of h5py above these calls would take five times as
long.
"""

from __future__ import annotations

from typing import Any

import h5py
import numpy as np
import numpy.typing as npt
from h5py import h5a, h5d, h5o, h5p, h5s, h5t

TABLE_CHUNK = 256


def note(item: Any, name: str, text: str) -> None:
    """Give a group or dataset a text as an attribute.

    Of fixed length: HDF5 keeps texts of variable length in heaps without checksums, and reads damaged ones without end.
    """
    value = np.array(text.encode())
    if h5a.exists(item.id, name.encode()):
        h5a.delete(item.id, name.encode())
    made = h5a.create(item.id, name.encode(), h5t.py_create(value.dtype), h5s.create(h5s.SCALAR))
    made.write(value)


def noted(item: Any, name: str) -> str:
    """The text of an attribute."""
    return bytes(item.attrs[name]).decode()


def attributes(item: Any) -> dict[str, Any]:
    """The attributes of a group or dataset, by its identifier: in the order of their names, as they are stored."""
    names: list[bytes] = []
    h5a.iterate(item, names.append)
    return {name.decode(): h5a.open(item, name) for name in sorted(names)}


def value_of(attribute: Any) -> npt.NDArray[Any]:
    """The value of a stored attribute: a number, a text of fixed length, or an array of these."""
    value = np.empty(attribute.shape, _plain(attribute))
    attribute.read(value)
    return np.asarray(value[()])


def link(group: Any, name: str, item: Any) -> None:
    """Let ``group`` have ``item`` under another name too."""
    h5o.link(item.id, group.id, name.encode())


def stored(group: Any, path: str) -> Any:
    """The identifier of the dataset at ``path`` below ``group``."""
    return h5d.open(group.id, path.encode())


def stored_in(group: Any) -> dict[str, Any]:
    """The identifiers of the datasets in ``group``, which has no others, by name."""
    return {name.decode(): h5d.open(group.id, name) for name in sorted(group.id)}


def growable(
    group: Any,
    name: str,
    dtype: Any,
    unit: str,
    shape: tuple[int, ...] = (),
    chunk: int = TABLE_CHUNK,
    checked: bool = False,
) -> h5py.Dataset:
    """An empty dataset (0, *shape) that grows along its first axis and whose chunk index exists already."""
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_chunk((chunk, *shape))
    properties.set_obj_track_times(False)
    if checked:
        properties.set_fletcher32()
    space = h5s.create_simple((0, *shape), (h5s.UNLIMITED, *shape))
    kind = h5t.py_create(np.dtype(dtype), logical=True)
    dataset = h5py.Dataset(h5d.create(group.id, name.encode(), kind, space, properties))
    put(dataset, 0, np.zeros((1, *shape), dtype))
    dataset.id.set_extent((0, *shape))
    note(dataset, "unit", unit)
    return dataset


def put(dataset: Any, start: int, rows: Any) -> npt.NDArray[Any]:
    """Write ``rows`` from row ``start`` of a dataset (or its identifier) on, over whatever an unfinished step may have
    left there; returns them as they are stored."""
    stored = dataset if isinstance(dataset, h5d.DatasetID) else dataset.id
    values = np.ascontiguousarray(rows, _plain(stored))
    length, shape = stored.shape[0], stored.shape[1:]
    if start + len(values) > length:
        stored.set_extent((start + len(values), *shape))
    if len(values):
        memory, place = _places(stored, start, values.shape)
        stored.write(memory, place, values, stored.get_type())
    return values


def rows(dataset: Any, begin: int, end: int) -> npt.NDArray[Any]:
    """The rows of a dataset (or its identifier) from ``begin`` on, before ``end``, as far as there are any."""
    stored = dataset if isinstance(dataset, h5d.DatasetID) else dataset.id
    length, shape = stored.shape[0], stored.shape[1:]
    values = np.empty((max(min(end, length) - begin, 0), *shape), _plain(stored))
    if values.size:
        memory, place = _places(stored, begin, values.shape)
        stored.read(memory, place, values, stored.get_type())
    return values


def _plain(stored: Any) -> npt.DTypeLike:
    """The type of a stored dataset or attribute. Texts of variable length are refused, which no archive has: HDF5's own
    calls would put pointers to them where Python has objects."""
    if stored.dtype.hasobject:
        raise ValueError(f"{stored.dtype} where numbers were written")
    return stored.dtype  # type: ignore[no-any-return]


def _places(stored: Any, start: int, shape: tuple[int, ...]) -> tuple[Any, Any]:
    """Where rows of that ``shape`` lie in memory, and from ``start`` on in the file."""
    place = stored.get_space()
    place.select_hyperslab((start, *(0 for _ in shape[1:])), shape)
    return h5s.create_simple(shape), place
