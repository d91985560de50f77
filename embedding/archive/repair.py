"""Copies of an archive: one that viewers open after a kill, one for a run that goes on, one of what can be saved."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from embedding.archive.digests import slot_digest
from embedding.archive.file import check_target, reading
from embedding.archive.layout import LIBVER, SLOTS, count_of, counted, growable, mesh_of, table, to_disk
from embedding.archive.verification import reading_what_is_left, verified
from embedding.archive.views import write_views
from embedding.errors import ArchiveError


def repair(path: str | os.PathLike[str]) -> int:
    """Rewrite the archive at ``path`` so that viewers open it too, and return its number of steps.

    A run killed in the middle of a commit leaves its file marked as open for writing. ``open_archive``
    reads it all the same, viewers refuse it. What was committed is copied to a fresh file, which then takes
    the place of the old one; nothing is changed in place. Don't call it while the run is at work.

    Raises ArchiveError if the archive cannot be read, or the copy not be written.
    """
    return rewrite(Path(path))


def salvage(path: str | os.PathLike[str], target: str | os.PathLike[str]) -> int:
    """Write those steps of a damaged archive that are whole, from the first one on, as an archive of their own to
    ``target``; returns how many.

    Raises ArchiveError if there are none, or if the archive cannot be written.
    """
    source, copy = Path(path), check_target(target)
    with reading_what_is_left(source) as (file, damages):
        found = verified(source, file, damages)
        if not found.saveable:
            raise ArchiveError(found.message if found.whole else f"{found.message}. The first step is not whole")
        write_copy(file, copy, found.saveable, ended=found.sound, salvaged=True)
        write_views(copy, list(file["VTKHDF/Assembly/Scene"]))
    return found.saveable


def rewrite(source: Path, new_run: str | None = None) -> int:
    """:func:`repair`; with ``new_run``, by whose name the run goes on, as an archive without an end."""
    with reading(source) as old:
        steps = count_of(old["embedding/committed"])
        write_copy(old, source, steps, new_run=new_run, ended=new_run is None)
    return steps


def write_copy(
    old: Any, target: Path, steps: int, *, new_run: str | None = None, ended: bool = True, salvaged: bool = False
) -> None:
    """Write the first ``steps`` of the open archive ``old`` to ``target``, whole or not at all; how the run ended
    belongs to it if it is ``ended``. ``new_run`` is the name of a run that goes on there. Rows that cannot be read are
    zeros in what is ``salvaged``: nothing that counts is among them.

    Raises ArchiveError if the copy cannot be written.
    """
    temporary = target.with_name(f"{target.name}.partial")
    try:
        with h5py.File(temporary, "w", libver=LIBVER, locking=False) as new:
            _Copy(old, steps, new_run, ended=ended, salvaged=salvaged).group(old, new)
            own = new["embedding"]
            own["committed"][...] = counted(steps)
            if not ended:
                own["finish/length"][...] = counted(0)
            if steps:
                _drop_other_checkpoint(own["checkpoint"][SLOTS[steps % 2]], steps)
        to_disk(temporary)
        os.replace(temporary, target)
        to_disk(target.parent)
    except OSError as error:
        raise ArchiveError(f"{target}: cannot be written: {error}") from error


def _drop_other_checkpoint(slot: Any, steps: int) -> None:
    """Empty the slot that belongs to the last step, unless it is that step's."""
    if int(slot["extent"][0]) != steps or not np.array_equal(slot_digest(slot), slot["digest"][...]):
        slot["extent"][...] = 0
        slot["digest"][...] = slot_digest(slot)


class _Copy:
    """Copies what counts of an open archive; datasets that are linked from several groups stay one
    dataset."""

    def __init__(self, file: Any, steps: int, new_run: str | None, *, ended: bool, salvaged: bool) -> None:
        self.new_run, self.committed, self.salvaged = new_run, steps, salvaged
        ends = file["embedding/steps/newton_end"] if self.committed else []
        self.newton = int(ends[self.committed - 1]) if self.committed else 0
        self.finish = count_of(file["embedding/finish/length"]) if ended else 0
        self.ends = {name: self.end(file, name) for name in file["VTKHDF/Assembly/Scene"]}
        self.copied: dict[Any, Any] = {}

    def end(self, file: Any, block: str) -> int:
        """Where the rows that count of the fields of ``block`` end."""
        if not self.committed:
            return 0
        group, last = file["VTKHDF"][block], self.committed - 1
        points = int(group["NumberOfPoints"][mesh_of(group, last)["Part"]])
        return int(file["embedding/vtk"][table("Row", block)][last]) + points

    def group(self, old: Any, new: Any) -> None:
        """Fill the group ``new`` with the attributes and members of ``old``."""
        for name, value in old.attrs.items():
            if name == "NSteps":
                value = np.int64(self.committed)
            elif name == "run" and self.new_run is not None:
                value = np.bytes_(self.new_run)
            new.attrs[name] = value
        for name in old:
            link = old.get(name, getlink=True)
            if isinstance(link, h5py.SoftLink):
                new[name] = h5py.SoftLink(link.path)
            elif isinstance(old[name], h5py.Group):
                self.group(old[name], new.create_group(name, track_order=True))
            else:
                self.dataset(old[name], new, name)

    def dataset(self, old: Any, group: Any, name: str) -> None:
        """Copy a dataset, cut down to the rows that count, or link to the copy that exists already."""
        place = h5py.h5o.get_info(old.id).addr
        if place in self.copied:
            group[name] = self.copied[place]
        elif old.maxshape and old.maxshape[0] is None:
            self.copied[place] = self.table(old, group, name)
        else:
            old.file.copy(old, group, name)
            self.copied[place] = group[name]

    def rows(self, place: list[str]) -> int:
        """How many rows count of a dataset that grows in the group at ``place``."""
        if place[-1] == "PointData":
            return self.ends[place[-2]]
        if place[1] == "VTKHDF" and len(place) == 3:
            return sys.maxsize  # meshes
        if place[-2] == "checkpoint":
            return sys.maxsize
        return {"newton": self.newton, "finish": self.finish}.get(place[-1], self.committed)

    def table(self, old: Any, group: Any, name: str) -> Any:
        """Copy the rows that count of a dataset that grows."""
        rows = min(self.rows(group.name.split("/")), len(old))
        new = growable(group, name, old.dtype, "1", old.shape[1:], old.chunks[0], old.fletcher32)
        new.resize(rows, axis=0)
        pace = 1 << 16
        for begin in range(0, rows, pace):
            try:
                new[begin : begin + pace] = old[begin : min(begin + pace, rows)]
            except OSError:
                if not self.salvaged:
                    raise
        del new.attrs["unit"]
        for key, value in old.attrs.items():
            new.attrs[key] = value
        return new
