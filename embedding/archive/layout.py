"""What an archive looks like inside: two groups side by side in one HDF5 file.

::

    /VTKHDF                        a PartitionedDataSetCollection (VTKHDF specification 2.2), for viewers
        <block>                    UnstructuredGrid of Lagrange cells: Points, Connectivity, Offsets, Types
            PointData/<field>      all steps one after another, float32
                                   (a mesh that a run changes: all meshes one after another, as parts)
            FieldData/<scalar>     links to the scalars below
            Steps                  NSteps, Values (step numbers), and where each step's rows begin
    /embedding                     what reproduces and explains the run
        committed                  number of steps that count (and its complement); everything behind is to be ignored
        scene, plan, scales, versions, run     documents: TOML, or JSON
        digest                     of the documents, meshes, units and origins
        steps/, scalars/           one row a step; steps/rows_digest and fields_digest are of what the step wrote
        newton/                    one row a Newton iteration; steps/newton_end says where a step's rows end
        checkpoint/even, odd       what a run goes on from after the last accepted step, in alternating slots
        origins/1, 2, ...          the state that each mesh after the first was made around
        finish/                    JSON of result, cost and error; ``length`` is 0 until the run has ended

Rules that make it survive a kill at any moment (``writer.py`` keeps them): rows of a field start at a chunk
of their own, so that no checksummed chunk of an old step is ever rewritten; every chunk index exists before
the first commit; tables that share a chunk over steps carry no checksum, but digests; a new mesh is added to a copy
of the file, which then takes its place.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt

from embedding.archive.arrays import growable, link, note, put, rows, stored
from embedding.archive.lagrange import LagrangeBlock
from embedding.archive.memory import packed
from embedding.archive.units import scalar_unit

SCHEMA = 3
LIBVER = ("v110", "v110")  # chunk indices of this format grow without being rewritten
VTKHDF_VERSION = (2, 2)
FIELD_CHUNK = 1 << 16  # rows at most in one chunk of a field
STAGE = h5py.string_dtype("utf-8", 64)
STEP_COLUMNS = {
    "number": ("i8", "1"),
    "stage": (STAGE, "1"),
    "newton_end": ("i8", "1"),
    "wall_seconds": ("f8", "s"),
    "factor_mechanical": ("f8", "1"),
    "factor_field": ("f8", "1"),
}
DIGESTS = ("rows_digest", "fields_digest")
DIGEST_SIZE = 32
NEWTON_COLUMNS = {
    "number": ("i8", "1"),
    "update": ("f8", "1"),
    "residual": ("f8", "1"),
    "pressure_top": ("f8", "Pa"),
    "pressure_bottom": ("f8", "Pa"),
}
SLOTS = ("even", "odd")
KINDS = ("PointData", "CellData", "FieldData")
PLACES = ("Part", "Point", "Cell", "ConnectivityId")
TOPOLOGY = PLACES[2:]
"""What VTKHDF asks of every step: where its mesh begins, counted in these; the last ones in a column."""


def to_disk(path: str | os.PathLike[str]) -> None:
    """Wait until a file or folder, as it is now, has reached the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def chunk_rows(points: int) -> int:
    """Rows of a chunk of a field on ``points`` nodes."""
    chunks = -(-points // FIELD_CHUNK)
    return -(-points // chunks)


def table(place: str, block: str) -> str:
    """Name of the table in /embedding/vtk of where each step begins in a ``block``: one of ``PLACES``, or the "Row" of
    its fields."""
    return f"first_{place.lower()}_of_{block}"


def first_row(shared: Any, group: Any, block: str, step: int) -> int:
    """Where the rows of ``step`` begin in the fields of ``block``, whose ``group`` has all meshes up to it; at a chunk
    of their own, behind those of the step before."""
    fields = group["PointData"]
    if step == 0 or not len(fields):
        return 0
    chunk = int(stored(fields, next(iter(fields))).get_create_plist().get_chunk()[0])
    part = part_of(group, step - 1)
    points = int(rows(stored(group, "NumberOfPoints"), part, part + 1)[0])
    return int(rows(stored(shared, table("Row", block)), step - 1, step)[0]) + -(-points // chunk) * chunk


def create_record(file: Any, documents: Mapping[str, str], run: str) -> Any:
    """Make the group /embedding with its documents and empty tables."""
    record = file.create_group("embedding")
    record.attrs["schema"] = SCHEMA
    note(record, "run", run)
    record["committed"] = counted(0)
    record["digest"] = np.zeros(DIGEST_SIZE, "u1")
    record.create_group("origins")
    for name, text in documents.items():
        record[name] = np.bytes_(text.encode() or b" ")
    for table, columns in (("steps", STEP_COLUMNS), ("newton", NEWTON_COLUMNS)):
        group = record.create_group(table)
        for name, (dtype, unit) in columns.items():
            growable(group, name, dtype, unit)
    for name in DIGESTS:
        growable(record["steps"], name, "u1", "1", shape=(DIGEST_SIZE,))
    record.create_group("scalars")
    create_finish(record)
    return record


def create_finish(record: Any) -> None:
    """Where it will be said how the run ended."""
    finish = record.create_group("finish")
    growable(finish, "json", "u1", "1", chunk=4096)
    finish["length"] = counted(0)
    finish["digest"] = np.zeros(DIGEST_SIZE, "u1")


def counted(count: int) -> npt.NDArray[np.int64]:
    """How a count that decides over everything else is stored: with its complement, lest one flipped bit changes it."""
    return np.array([count, ~count], "i8")


def count_of(dataset: Any) -> int:
    """The count in a dataset that holds :func:`counted`. Raises ValueError if it is damaged."""
    count, complement = (int(number) for number in dataset[:2])
    if count < 0 or complement != ~count:
        raise ValueError(f"{dataset.name} is damaged")
    return count


def create_scalars(record: Any, names: Sequence[str], per_length: bool) -> None:
    """One growing column (n, 1) a scalar in /embedding/scalars."""
    for name in names:
        growable(record["scalars"], name, "f8", scalar_unit(name, per_length), shape=(1,))


def create_checkpoint(record: Any, numbers: int) -> None:
    """Two slots for what a run goes on from, of about so many ``numbers``: one holds the last accepted step while the
    other is written."""
    chunk = min(max(numbers, 128), FIELD_CHUNK)
    for slot in SLOTS:
        group = record.create_group(f"checkpoint/{slot}")
        growable(group, "text", "u1", "1", chunk=4096)
        growable(group, "numbers", "f8", "1", chunk=chunk)
        group["extent"] = np.zeros(3, "i8")  # the step, bytes of text, numbers
        group["digest"] = np.zeros(DIGEST_SIZE, "u1")


def add_origin(record: Any, memory: Any) -> None:
    """Keep the state that the next mesh is made around."""
    text, numbers = packed(memory)
    group = record["origins"].create_group(str(len(record["origins"]) + 1))
    group["text"] = np.frombuffer(text.encode(), "u1")
    group["numbers"] = numbers
    for name in ("text", "numbers"):
        note(group[name], "unit", "1")


def create_blocks(file: Any, blocks: Mapping[str, LagrangeBlock]) -> None:
    """Make /VTKHDF with the meshes of all blocks; fields and steps come with the first step."""
    root = _group(file, "VTKHDF", "PartitionedDataSetCollection")
    assembly = root.create_group("Assembly", track_order=True).create_group("Scene", track_order=True)
    for index, (name, block) in enumerate(blocks.items()):
        group = _group(root, name, "UnstructuredGrid")
        group.attrs["Index"] = np.int64(index)
        group.attrs["order"] = np.int64(block.order)
        assembly[name] = h5py.SoftLink(f"/VTKHDF/{name}")
        for key, (data, unit) in _mesh(block).items():
            filters = {"compression": "gzip", "compression_opts": 1, "shuffle": True, "fletcher32": True}
            limits = (None, *data.shape[1:])
            note(group.create_dataset(key, data=data, chunks=True, maxshape=limits, **filters), "unit", unit)


def add_mesh(group: Any, block: LagrangeBlock) -> dict[str, int]:
    """Put the mesh of ``block`` behind those that its ``group`` has; returns where it begins, by ``PLACES``."""
    begin = {"Part": len(group["NumberOfPoints"])}
    for place in PLACES[1:]:
        begin[place] = int(group[f"NumberOf{place}s"][...].sum())
    for key, (data, _) in _mesh(block).items():
        put(group[key], len(group[key]), data)
    return begin


def part_tables(file: Any, block: str, steps: int) -> None:
    """Give ``block`` tables of its own of where the mesh of a step begins, with the ``steps`` so far on its first mesh;
    until then it shares tables of zeros with all others."""
    shared, linked = file["embedding/vtk"], file["VTKHDF"][block]["Steps"]
    for place in PLACES:
        if table(place, block) not in shared:
            columns: tuple[int, ...] = (1,) if place in TOPOLOGY else ()
            own = growable(shared, table(place, block), "i8", "1", shape=columns)
            put(own, 0, np.zeros((steps, *columns), "i8"))
            del linked[f"{place}Offsets"]
            linked[f"{place}Offsets"] = own


def part_of(group: Any, step: int) -> int:
    """Which of the meshes of a block's ``group`` that of a ``step`` is."""
    return int(rows(stored(group, "Steps/PartOffsets"), step, step + 1)[0])


def mesh_of(group: Any, step: int) -> dict[str, int]:
    """Where the mesh of a ``step`` begins in the ``group`` of a block, by ``PLACES``."""
    return {place: int(group["Steps"][f"{place}Offsets"][step].item()) for place in PLACES}


def _mesh(block: LagrangeBlock) -> dict[str, tuple[npt.NDArray[Any], str]]:
    """The arrays of one mesh, with their units."""
    cells, nodes = block.cells.shape
    counts = {"Points": block.point_count, "Cells": cells, "ConnectivityIds": cells * nodes}
    return {f"NumberOf{key}": (np.array([count], "i8"), "1") for key, count in counts.items()} | {
        "Points": (np.asarray(block.points, "f8"), "m"),
        "Connectivity": (block.cells.ravel().astype("i8"), "1"),
        "Offsets": (np.arange(cells + 1, dtype="i8") * nodes, "1"),
        "Types": (np.full(cells, block.cell_type, "u1"), "1"),
    }


def create_fields(file: Any, fields: Mapping[str, Mapping[str, tuple[str, tuple[int, ...]]]]) -> None:
    """Make the growing fields ``{block: {name: (unit, shape of a row)}}``, and the step tables of every
    block.

    The tables that are equal in all blocks exist once and are linked; scalars are links to
    /embedding/scalars.
    """
    shared = file["embedding"].create_group("vtk")
    growable(shared, "values", "f8", "1")
    growable(shared, "row", "i8", "1")
    growable(shared, "zero", "i8", "1")
    growable(shared, "zeros", "i8", "1", shape=(1,))
    growable(shared, "one", "i8", "1")
    for block, declared in fields.items():
        group = file["VTKHDF"][block]
        steps = group.create_group("Steps", track_order=True)
        steps.attrs.create("NSteps", np.int64(0))
        link(steps, "Values", shared["values"])
        for place in PLACES:
            link(steps, f"{place}Offsets", shared["zeros" if place in TOPOLOGY else "zero"])
        link(steps, "NumberOfParts", shared["one"])
        chunk = chunk_rows(int(group["NumberOfPoints"][0]))
        data = {kind: group.create_group(kind, track_order=True) for kind in KINDS}
        offsets = {kind: steps.create_group(f"{kind}Offsets", track_order=True) for kind in KINDS}
        first = growable(shared, table("Row", block), "i8", "1")
        for name, (unit, shape) in declared.items():
            growable(data["PointData"], name, "f4", unit, shape, chunk, checked=True)
            link(offsets["PointData"], name, first)
        row = shared["row"]
        for name, dataset in file["embedding/scalars"].items():
            link(data["FieldData"], name, dataset)
            link(offsets["FieldData"], name, row)


def _group(parent: Any, name: str, kind: str) -> Any:
    group = parent.create_group(name, track_order=True)
    group.attrs["Version"] = np.array(VTKHDF_VERSION, "i8")
    group.attrs.create("Type", np.bytes_(kind))
    return group
