"""Writing an archive so that a killed run never loses, and never damages, a step that was committed.

Every step is written in two phases: first all its rows, behind everything that counts; then, when they have
reached the disk, the number of steps that count. Between steps the file is closed. ``layout.py`` says what
the file holds.
"""

from __future__ import annotations

import json
import os
import shutil
import uuid
from collections.abc import Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import h5py
import numpy as np
import numpy.typing as npt

from embedding.archive import layout, views
from embedding.archive.arrays import noted, put, rows, stored, stored_in
from embedding.archive.axes import label_axes
from embedding.archive.digests import (
    damaged_rows,
    digest_of,
    record_digest,
    row_digest,
    rows_digests,
    slot_digest,
    values_digest,
)
from embedding.archive.file import check_target, reading
from embedding.archive.lagrange import LagrangeBlock
from embedding.archive.memory import Floats, packed
from embedding.archive.repair import rewrite
from embedding.archive.room import require_room
from embedding.errors import ArchiveError
from embedding.process import abandon

if TYPE_CHECKING:
    from collections.abc import Iterator

    from embedding.solving.events import StepRecord

Packed = tuple[str, Floats]
"""What a run goes on from, as its text and its row of numbers."""


@dataclass(frozen=True)
class SampledField:
    """Values of a field at the nodes of a block: (n,) for a scalar, (n, c) for c components; ``unit`` is SI."""

    block: str
    name: str
    unit: str
    values: npt.NDArray[np.float64]


class ArchiveWriter:
    """Writes one run. Nothing is on disk before the first step is.

    The first step goes to ``<name>.<run>.partial``, which takes the place of ``target`` only when that step is
    committed: an archive that was there before stays whole until then, whatever happens to this run. A run
    that ends without an accepted step leaves its record (why it failed) at ``target`` if nothing is there,
    else at ``<stem>.failed<suffix>``. ``path`` says where the record is, or will be.

    Raises ArchiveError if the target cannot be written, if the disk fails, or if another run has taken the
    file.
    """

    def __init__(
        self,
        target: str | os.PathLike[str],
        blocks: Mapping[str, LagrangeBlock],
        documents: Mapping[str, str],
        per_length: bool = False,
    ) -> None:
        self.target = check_target(target)
        self.path = self.target
        self.blocks, self.documents, self.per_length = dict(blocks), dict(documents), per_length
        self.committed = 0
        self._begin: dict[str, dict[str, int]] = {}
        self._remeshed, self._origins = False, list[Any]()
        self._run = uuid.uuid4().hex
        self._partial = self.target.with_name(f"{self.target.name}.{self._run[:8]}.partial")

    @classmethod
    def going_on(cls, target: Path, blocks: Mapping[str, LagrangeBlock], steps: int) -> ArchiveWriter:
        """The writer of a run that goes on from the last of the ``steps`` of the archive ``target``, on the meshes of
        its ``blocks``. Whatever else may still be writing there is refused from now on.

        Raises ArchiveError if the archive cannot be read or written, has got more steps, or its last meshes are others.
        """
        writer = cls(target, blocks, {})
        rewrite(target, writer._run, steps)
        with reading(target) as file:
            writer.committed = layout.count_of(file["embedding/committed"])
            shared = file["embedding/vtk"]
            for name, block in blocks.items():
                first = layout.mesh_of(file["VTKHDF"][name], writer.committed - 1)
                if int(file["VTKHDF"][name]["NumberOfPoints"][first["Part"]]) != block.point_count:
                    raise ArchiveError(f"{target}: block {name!r} has another mesh than the run that would go on")
                if layout.table("Part", name) in shared:
                    writer._begin[name] = first
        views.write_views(target, list(blocks))
        return writer

    def remesh(self, blocks: Mapping[str, LagrangeBlock], origin: Any = None) -> None:
        """The steps from here on are on other meshes, of the same ``blocks`` by name; ``origin`` is what they are made
        from."""
        self.blocks, self._remeshed = dict(blocks), True
        self._origins.append(origin)

    def append(
        self, record: StepRecord, fields: Sequence[SampledField], memory: Mapping[str, Any]
    ) -> None:
        """Commit one accepted step: its record, the fields of all blocks, and what a run goes on from.

        The fields and scalars of the first step are those of the run; ``memory`` is what ``memory.packed`` takes.
        """
        kept = packed(memory)
        if self.committed and self._remeshed:
            self._append_on_new_meshes(record, fields, kept)
            return
        more = _size(fields, kept)
        if self.committed:
            with self._open(self.path, "r+", more) as file:
                self._step(file, record, fields, kept)
            self.committed += 1
            return
        self._remeshed = False
        with self._open(self._partial, "w", more + _size_of(self.blocks)) as file:
            self._create(file)
            layout.create_scalars(file["embedding"], list(_scalars(record)), self.per_length)
            layout.create_checkpoint(file["embedding"], len(kept[1]))
            declared: dict[str, dict[str, tuple[str, tuple[int, ...]]]] = {name: {} for name in self.blocks}
            for field in fields:
                declared[field.block][field.name] = (field.unit, field.values.shape[1:])
            layout.create_fields(file, declared)
            self._add_origins(file["embedding"])
            label_axes(file)
            file["embedding/digest"][...] = record_digest(file)
            self._step(file, record, fields, kept)
        self.committed = 1
        self._place(self.target, list(self.blocks))

    def _append_on_new_meshes(self, record: StepRecord, fields: Sequence[SampledField], kept: Packed) -> None:
        """Commit a step that changes what there is in the file, in a copy that takes its place."""
        more = _size(fields, kept) + _size_of(self.blocks)
        self._copy()
        with self._open(self._partial, "r+", more) as file:
            own, steps = file["embedding"], self.committed
            if damaged_rows(own, steps):
                raise ArchiveError(f"{self.path}: the archive has been damaged on the disk; see embedding verify")
            for name, block in self.blocks.items():
                layout.part_tables(file, name, steps)
                self._begin[name] = layout.add_mesh(file["VTKHDF"][name], block)
            put(own["steps/rows_digest"], 0, list(rows_digests(own, 0, steps)))  # of more tables than before
            self._add_origins(own)
            label_axes(file)
            file["embedding/digest"][...] = record_digest(file)
            self._step(file, record, fields, kept)
        self.committed, self._remeshed = self.committed + 1, False
        self._place(self.path, list(self.blocks))

    def _add_origins(self, own: Any) -> None:
        for origin in self._origins:
            layout.add_origin(own, origin)
        self._origins = []

    def _copy(self) -> None:
        try:
            shutil.copyfile(self.path, self._partial)
        except OSError as error:
            self._partial.unlink(missing_ok=True)
            raise ArchiveError(f"{self.path}: cannot copy the archive for a new mesh: {error}") from error

    def finish(self, summary: Mapping[str, Any]) -> None:
        """Add how the run ended; ``summary`` is plain data for JSON."""
        data = np.frombuffer(json.dumps(summary, default=_plain).encode(), "u1")
        if self.committed:
            with self._open(self.path, "r+", len(data)) as file:
                self._end(file, data)
            return
        with self._open(self._partial, "w", len(data) + _size_of(self.blocks)) as file:
            self._create(file)
            file["embedding/digest"][...] = record_digest(file)
            self._end(file, data)
        taken = self.target.exists()
        self._place(self.target.with_stem(f"{self.target.stem}.failed") if taken else self.target, [])

    def _create(self, file: Any) -> None:
        layout.create_record(file, self.documents, self._run)
        layout.create_blocks(file, self.blocks)

    def _step(
        self,
        file: Any,
        record: StepRecord,
        fields: Sequence[SampledField],
        kept: Packed,
    ) -> None:
        own, step = file["embedding"], self.committed
        shared = own["vtk"]
        first = {name: layout.first_row(shared, file["VTKHDF"][name], name, step) for name in self.blocks}
        data = {name: stored_in(file["VTKHDF"][name]["PointData"]) for name in self.blocks}
        scalars, tables = stored_in(own["scalars"]), stored_in(shared)
        written = {}
        for field in fields:
            here = self._known(data[field.block], field.name)
            written[f"{field.block}/{field.name}"] = put(here, first[field.block], field.values.astype("f4"))
        columns, newton = self._rows(own, record)
        for name, value in _scalars(record).items():
            columns[f"scalars/{name}"] = put(self._known(scalars, name), step, [[value]])[0]
        entries = {"values": record.number, "row": step, "zero": 0, "zeros": 0, "one": 1}
        entries |= {layout.table("Row", block): row for block, row in first.items()}
        for block, begin in self._begin.items():
            entries |= {layout.table(place, block): value for place, value in begin.items()}
        for name, entry in entries.items():
            shape = (1, *tables[name].shape[1:])
            columns[f"vtk/{name}"] = put(tables[name], step, np.reshape(entry, shape))[0]
        put(stored(own, "steps/rows_digest"), step, [row_digest(columns, newton)])
        put(stored(own, "steps/fields_digest"), step, [values_digest(written)])
        self._keep(own["checkpoint"][layout.SLOTS[(step + 1) % 2]], kept)
        _synchronise(file)
        for block in self.blocks:
            file["VTKHDF"][block]["Steps"].attrs.modify("NSteps", np.int64(step + 1))
        put(stored(own, "committed"), 0, layout.counted(step + 1))
        _synchronise(file)

    def _keep(self, slot: Any, kept: Packed) -> None:
        """Write what the run goes on from into the slot that does not count yet."""
        text, numbers = kept
        data = np.frombuffer(text.encode(), "u1")
        put(stored(slot, "text"), 0, data)
        put(stored(slot, "numbers"), 0, numbers)
        put(stored(slot, "extent"), 0, [self.committed + 1, len(data), len(numbers)])
        put(stored(slot, "digest"), 0, slot_digest(slot))

    def _rows(self, own: Any, record: StepRecord) -> tuple[dict[str, Any], dict[str, Any]]:
        """The rows of a step in the tables of steps and of Newton iterations, as they are stored, by column."""
        step = self.committed
        steps, newton = stored_in(own["steps"]), stored_in(own["newton"])
        begin = int(rows(steps["newton_end"], step - 1, step)[0]) if step else 0
        turns = {
            name: put(newton[name], begin, [getattr(one, name) for one in record.iterations])
            for name in layout.NEWTON_COLUMNS
        }
        row = {
            "number": record.number,
            "stage": _short(record.stage),
            "wall_seconds": record.wall_seconds,
            "factor_mechanical": record.factor_mechanical,
            "factor_field": record.factor_field,
            "newton_end": begin + len(record.iterations),
        }
        return {f"steps/{name}": put(steps[name], step, [row[name]])[0] for name in layout.STEP_COLUMNS}, turns

    def _end(self, file: Any, data: npt.NDArray[np.uint8]) -> None:
        finish = file["embedding/finish"]
        put(finish["json"], 0, data)
        finish["digest"][...] = digest_of(data)
        _synchronise(file)
        finish["length"][...] = layout.counted(len(data))
        _synchronise(file)

    def _known(self, known: Mapping[str, Any], name: str) -> Any:
        dataset = known.get(name)
        if dataset is None:
            raise ArchiveError(f"{self.path}: a step brings {name!r}, which the first step did not have")
        return dataset

    @contextmanager
    def _open(self, path: Path, mode: str, more: int) -> Iterator[Any]:
        """The file, open for one commit of so many bytes ``more``. Locks are not asked for: a viewer that holds the
        file must not end the run."""
        try:
            require_room(path, more)
        except OSError as error:
            self._fail(path, error)
        try:
            with h5py.File(path, mode, libver=layout.LIBVER, locking=False) as file:
                if mode == "r+" and ("embedding" not in file or noted(file["embedding"], "run") != self._run):
                    raise ArchiveError(f"{path}: another run has replaced the archive of this one")
                yield file
        except (OSError, RuntimeError) as error:
            abandon()  # HDF5 would try to write again at the end of the process, and die of it
            self._fail(path, error)

    def _fail(self, path: Path, error: Exception) -> NoReturn:
        """Raise the ArchiveError of a commit that failed; what was begun is removed."""
        if path == self._partial:
            path.unlink(missing_ok=True)
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        kept = f"; the {self.committed} steps committed before are kept" if self.committed else ""
        hint = f". When that is mended, go on with: embedding resume {self.path}" if self.committed else ""
        raise ArchiveError(f"{self.path}: cannot write the archive: {reason}{kept}{hint}") from error

    def _place(self, path: Path, blocks: list[str]) -> None:
        """Move the partial file to its final name and write the view files of its blocks."""
        try:
            os.replace(self._partial, path)
            layout.to_disk(path.parent)
            self.path = path
            views.write_views(path, blocks)
        except OSError as error:
            self._partial.unlink(missing_ok=True)
            self._fail(path, error)


def _synchronise(file: Any) -> None:
    """Bring everything written so far to the disk, before anything is written that relies on it."""
    file.flush()
    layout.to_disk(file.filename)


def _size(fields: Sequence[SampledField], kept: Packed) -> int:
    """Bytes that a step takes at most, but for its tables."""
    return sum(2 * 4 * field.values.size for field in fields) + 2 * kept[1].nbytes


def _size_of(blocks: Mapping[str, LagrangeBlock]) -> int:
    """Bytes of meshes, at most."""
    return sum(2 * 8 * (block.points.size + block.cells.size) for block in blocks.values())


def _scalars(record: StepRecord) -> dict[str, float]:
    return {
        **record.scalars,
        "factor_mechanical": record.factor_mechanical,
        "factor_field": record.factor_field,
    }


def _plain(value: Any) -> Any:
    """NumPy's numbers as Python's, paths as texts."""
    return value.item() if isinstance(value, np.generic) else str(value)


def _short(text: str) -> bytes:
    """As much of ``text`` as the fixed column of stages holds, cut between characters."""
    return text.encode()[: layout.STAGE.itemsize].decode(errors="ignore").encode()
