"""Copies of an archive: one that viewers open after a kill, one for a run that goes on, one of what can be saved."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from embedding.archive import layout
from embedding.archive.arrays import growable, put
from embedding.archive.axes import AXES, label_axes
from embedding.archive.digests import slot_digest
from embedding.archive.file import check_target, reading
from embedding.archive.layout import LIBVER, SLOTS, count_of, counted, part_of, table, to_disk
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

    Raises ArchiveError if there are none, if ``target`` exists, or if the archive cannot be written.
    """
    source, copy = Path(path), check_target(target)
    if copy.exists() and copy.samefile(source):
        raise ArchiveError(f"{copy}: is the damaged archive itself; name another file")
    if copy.exists():
        raise ArchiveError(f"{copy}: exists already; what is saved needs a file of its own")
    with reading_what_is_left(source) as (file, damages):
        found = verified(source, file, damages)
        if not found.saveable:
            raise ArchiveError(f"{found.message}. The first step is not whole" if found.whole else found.message)
        with _written(copy) as new:
            _Copy(file, found.saveable, ended=False, salvaged=True).group(file, new)
            _copy_memory(file, new, found.saveable)
            layout.create_finish(new["embedding"])  # how it ended is not known
            new["embedding/committed"][...] = counted(found.saveable)
        write_views(copy, list(file["VTKHDF/Assembly/Scene"]))
    return found.saveable


def rewrite(source: Path, new_run: str | None = None, known: int | None = None) -> int:
    """:func:`repair`; with ``new_run``, by whose name the run goes on, as an archive without an end.

    Raises ArchiveError if there are other steps than the ``known`` ones that the run goes on from.
    """
    with reading(source) as old, _written(source) as new:
        steps = count_of(old["embedding/committed"])
        if known not in (None, steps):
            raise ArchiveError(f"{source}: another run is at work there: step {steps} came meanwhile. Let it end first")
        _Copy(old, steps, new_run, ended=new_run is None).group(old, new)
        if steps and not _copy_memory(old, new, steps):
            raise ArchiveError(f"{source}: the archive is damaged: the checkpoint of step {steps}")
        if new_run is not None:
            new["embedding/finish/length"][...] = counted(0)
    return steps


@contextmanager
def _written(target: Path) -> Iterator[Any]:
    """A new HDF5 file that becomes ``target`` when it is written, whole or not at all. Raises ArchiveError."""
    temporary = target.with_name(f"{target.name}.{os.getpid()}.partial")  # another process may write the same target
    try:
        with h5py.File(temporary, "w", libver=LIBVER, locking=False) as new:
            yield new
            label_axes(new)
        to_disk(temporary)
        os.replace(temporary, target)
        to_disk(target.parent)
    except (OSError, RuntimeError) as error:
        raise ArchiveError(f"{target}: cannot be written: {error}") from error
    finally:
        temporary.unlink(missing_ok=True)


def _copy_memory(old: Any, new: Any, steps: int) -> bool:
    """Copy what a run goes on from after the last of so many ``steps``, and after the one before; False, and the slot
    is empty, if the former is not whole. The other slot may be half-written by a run that was killed."""
    whole = {}
    for slot, number in ((SLOTS[steps % 2], steps), (SLOTS[(steps + 1) % 2], steps - 1)):
        with suppress(Exception):  # where bytes are wrong, HDF5 and h5py fail in many ways
            group = old["embedding/checkpoint"][slot]
            extent = group["extent"][...]
            rows = group["text"][: extent[1]], group["numbers"][: extent[2]]
            if int(extent[0]) == number and np.array_equal(slot_digest(group), group["digest"][...]):
                whole[slot] = extent, *rows
    layout.create_checkpoint(new["embedding"], max((len(numbers) for _, _, numbers in whole.values()), default=0))
    for slot, group in new["embedding/checkpoint"].items():
        if slot in whole:
            group["extent"][...], text, numbers = whole[slot]
            put(group["text"], 0, text)
            put(group["numbers"], 0, numbers)
        group["digest"][...] = slot_digest(group)
    return SLOTS[steps % 2] in whole


class _Copy:
    """Copies what counts of an open archive but for its checkpoint; datasets that are linked from several groups stay
    one dataset.

    What is ``salvaged`` is without its end, and rows that cannot be read, none of which counts, are zeros.
    """

    def __init__(
        self, file: Any, steps: int, new_run: str | None = None, *, ended: bool = True, salvaged: bool = False
    ) -> None:
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
        points = int(group["NumberOfPoints"][part_of(group, last)])
        return int(file["embedding/vtk"][table("Row", block)][last]) + points

    def group(self, old: Any, new: Any) -> None:
        """Fill the group ``new`` with the attributes and members of ``old``."""
        self.attributes(old, new)
        for name in old:
            if old.name == "/embedding" and (name == "checkpoint" or (name == "finish" and self.salvaged)):
                continue
            link = old.get(name, getlink=True)
            if isinstance(link, h5py.SoftLink):
                new[name] = h5py.SoftLink(link.path)
            elif isinstance(old[name], h5py.Group):
                self.group(old[name], new.create_group(name, track_order=True))
            else:
                self.dataset(old[name], new, name)

    def attributes(self, old: Any, new: Any) -> None:
        """Copy the attributes; names of axes are made anew, as they refer to other places in the file."""
        for name in old.attrs:
            if name == "NSteps":
                new.attrs[name] = np.int64(self.committed)
            elif name == "run" and self.new_run is not None:
                new.attrs[name] = np.bytes_(self.new_run)
            elif name not in AXES:
                new.attrs[name] = old.attrs[name]

    def dataset(self, old: Any, group: Any, name: str) -> None:
        """Copy a dataset, cut down to the rows that count, or link to the copy that exists already."""
        place = h5py.h5o.get_info(old.id).addr
        if place in self.copied:
            group[name] = self.copied[place]
        elif old.maxshape and old.maxshape[0] is None and not self.is_mesh(group):
            self.copied[place] = self.table(old, group, name)
        else:
            old.file.copy(old, group, name, without_attrs=True)
            self.attributes(old, group[name])
            self.copied[place] = group[name]

    @staticmethod
    def is_mesh(group: Any) -> bool:
        """Does the ``group`` hold meshes, which count as a whole?"""
        place = group.name.split("/")
        return place[1] == "VTKHDF" and len(place) == 3

    def rows(self, place: list[str]) -> int:
        """How many rows count of a dataset that grows in the group at ``place``."""
        if place[-1] == "PointData":
            return self.ends[place[-2]]
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
        self.attributes(old, new)
        return new
