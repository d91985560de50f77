"""Digests of what counts in an archive: a bit that is flipped anywhere in it is noticed.

Metadata of HDF5 carry checksums of their own, and so do the chunks of fields and meshes (weak ones); tables that steps
share, texts and attributes have none. So every step is stored with a SHA-256 of its rows in all tables and one of its
fields; the documents, meshes, units and names share one, and so have each slot of the checkpoint and the finish.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt

from embedding.archive.arrays import attributes, rows, stored, stored_in, value_of
from embedding.archive.axes import AXES
from embedding.archive.layout import DIGESTS, part_of, table

Digest = npt.NDArray[np.uint8]
TABLES = ("steps", "scalars", "vtk")
GROWING = ("embedding/committed", "embedding/digest", *(f"embedding/{name}" for name in (
    *TABLES, "newton", "checkpoint", "finish")))  # fmt: skip
MOST_ITEMS, DEEPEST = 100_000, 8
"""Of the groups, datasets and attributes of an archive, and of groups in groups: more are links in a circle."""
LINKS = ("Steps", "FieldData")
"""Groups of a block that hold nothing of their own: links to tables."""
CHANGING = ("NSteps", "run", *AXES)
"""Attributes that change while a run is written, or that only name axes, which HDF5 keeps without checksums: they say
no more than the number of steps, who writes, and what the axes are."""


def digest_of(*parts: Any) -> Digest:
    """SHA-256 of arrays and texts, one after the other, with their sizes."""
    found = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else np.ascontiguousarray(part).tobytes()
        found.update(len(data).to_bytes(8, "little"))
        found.update(data)
    return np.frombuffer(found.digest(), "u1")


def rows_digests(own: Any, begin: int, end: int) -> Iterator[Digest]:
    """Of the steps from ``begin`` on, before ``end``: what they have in the tables of ``own``, the group /embedding."""
    columns = {
        f"{name}/{column}": rows(dataset, begin, end)
        for name in TABLES
        for column, dataset in stored_in(own[name]).items()
        if column not in DIGESTS
    }
    ends = columns["steps/newton_end"].tolist()
    first = int(own["steps/newton_end"][begin - 1]) if begin else 0
    last = ends[-1] if ends else first
    newton = {name: rows(column, first, last) for name, column in stored_in(own["newton"]).items()}
    starts = [0, *(end - first for end in ends)]
    for row in range(end - begin):
        here = {name: column[row] for name, column in columns.items()}
        yield row_digest(here, {name: column[starts[row] : starts[row + 1]] for name, column in newton.items()})


def row_digest(columns: Mapping[str, Any], newton: Mapping[str, Any]) -> Digest:
    """Of one step: its entry in each column of the tables, by TABLE/COLUMN, and its Newton iterations by column.

    Columns follow each other by table as in ``TABLES``, in each by name.
    """
    order = sorted(columns, key=lambda name: (TABLES.index(name.partition("/")[0]), name))
    parts = [part for name in order for part in (name, columns[name])]
    parts += [part for name in sorted(newton) for part in (name, newton[name])]
    return digest_of(*parts)


def damaged_rows(own: Any, steps: int) -> list[int]:
    """Numbers, from 1, of those of the first so many ``steps`` whose rows are not what was written."""
    if not steps:
        return []
    stored = own["steps/rows_digest"][:steps]
    found = list(rows_digests(own, 0, steps))
    return [k + 1 for k in range(steps) if k >= len(stored) or not np.array_equal(stored[k], found[k])]


def fields_digest(file: Any, step: int) -> Digest:
    """Of all fields of one step, read from the file."""
    found: dict[str, Any] = {}
    for block in file["VTKHDF/Assembly/Scene"]:
        group = file["VTKHDF"][block]
        part = part_of(group, step)
        points = int(rows(stored(group, "NumberOfPoints"), part, part + 1)[0])
        begin = int(rows(stored(file, f"embedding/vtk/{table('Row', block)}"), step, step + 1)[0])
        found |= {
            f"{block}/{name}": rows(dataset, begin, begin + points)
            for name, dataset in stored_in(group["PointData"]).items()
        }
    return values_digest(found)


def values_digest(fields: Mapping[str, Any]) -> Digest:
    """Of all fields of one step, by BLOCK/FIELD, as they are stored."""
    in_order = sorted(fields, key=lambda name: name.split("/", 1))
    return digest_of(*(part for name in in_order for part in (name, fields[name])))


def record_digest(file: Any) -> Digest:
    """Of all that does not grow with the steps: documents, meshes, origins, and the names and attributes of all."""
    parts = list(islice(_static(file["/"].id, ""), MOST_ITEMS + 1))
    if len(parts) > MOST_ITEMS:
        raise ValueError("links that lead round in a circle")
    return digest_of(*parts)


def _static(group: Any, path: str) -> Iterator[Any]:
    if path.count("/") > DEEPEST:
        raise ValueError("links that lead round in a circle")
    yield from _attributes(group, path)
    for name in sorted(link.decode() for link in group):
        place = f"{path}/{name}".lstrip("/")
        yield place
        if path == "VTKHDF/Assembly/Scene":
            yield h5py.Group(group).get(name, getlink=True).path
            continue
        item = h5py.h5o.open(group, name.encode())
        if name in LINKS and place.startswith("VTKHDF/"):
            yield from _names(h5py.Group(item))
            continue
        if isinstance(item, h5py.h5g.GroupID):
            yield from _static(item, place)
            continue
        yield from _attributes(item, place)
        yield f"{item.dtype} {item.shape[1:]}"
        if not _grows(place):
            yield h5py.Dataset(item)[...]


def _names(group: Any) -> Iterator[str]:
    """Names of links, and those within the groups "PointDataOffsets" and the like, as VTKHDF has them."""
    for name in sorted(group):
        yield name
        if name.endswith("DataOffsets"):
            yield from sorted(group[name])


def _grows(place: str) -> bool:
    if place.startswith("VTKHDF/"):
        return place.count("/") > 2
    return place.startswith(GROWING)


def _attributes(item: Any, place: str) -> Iterator[Any]:
    for name, attribute in attributes(item).items():
        if name not in CHANGING:
            yield f"{place}@{name}"
            yield value_of(attribute)


def slot_digest(slot: Any) -> Digest:
    """Of one slot of the checkpoint."""
    extent = rows(stored(slot, "extent"), 0, 3)
    _, text, numbers = extent.tolist()
    return digest_of(extent, rows(stored(slot, "text"), 0, text), rows(stored(slot, "numbers"), 0, numbers))
