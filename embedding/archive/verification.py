"""Is an archive what its run wrote? And if not, what of it can be saved?"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from embedding.archive.digests import damaged_rows, digest_of, fields_digest, record_digest, slot_digest
from embedding.archive.file import check_origin, check_signature, opened_for_reading
from embedding.archive.layout import SLOTS, count_of
from embedding.errors import ArchiveError


@dataclass(frozen=True)
class Verification:
    """What was found in the archive at ``path``: the number of ``steps`` that count, those that are ``whole`` (numbers
    from 1), what is damaged, and what a killed run has left behind, which is ignored. ``resumable`` says whether the
    run has not reached its end, and what it goes on from is whole."""

    path: Path
    steps: int
    whole: tuple[int, ...]
    damages: tuple[str, ...]
    leftovers: tuple[str, ...]
    resumable: bool

    @property
    def sound(self) -> bool:
        """Is everything that counts what was written?"""
        return not self.damages

    @property
    def saveable(self) -> int:
        """How many steps, from the first one on, are whole."""
        count = 0
        while count + 1 in self.whole:
            count += 1
        return count

    @property
    def message(self) -> str:
        """The whole finding, in words."""
        if self.sound:
            found = f"{self.path}: whole; {_steps(self.steps)}"
        else:
            found = f"{self.path}: the archive is damaged: {'; '.join(self.damages)}. {self._saved()}"
        return ". ".join([found, *self.leftovers])

    def _saved(self) -> str:
        if not self.whole:
            return "Nothing can be saved"
        return f"Whole, and to be saved: {_listed(self.whole)} of {_steps(self.steps)}"


def verify(path: str | os.PathLike[str]) -> Verification:
    """Read everything that counts in the archive at ``path`` and compare it with its checksums.

    Raises ArchiveError if there is nothing to look at: no such file, not an archive, an archive of another version, or
    damaged so that HDF5 finds nothing in it.
    """
    source = Path(path)
    with reading_what_is_left(source) as (file, damages):
        return verified(source, file, damages)


def verified(path: Path, file: Any, damages: list[str]) -> Verification:
    """:func:`verify` of what :func:`reading_what_is_left` has opened."""
    return _Check(path, file, list(damages)).verification()


@contextmanager
def reading_what_is_left(path: Path) -> Iterator[tuple[Any, list[str]]]:
    """The archive at ``path``, read as far as it goes, and what is wrong with the file as such. What is missing at its
    end reads as zeros. Raises ArchiveError like ``file.reading``."""
    check_signature(path)
    damages: list[str] = []
    with ExitStack() as stack:
        try:
            file = stack.enter_context(opened_for_reading(path, stack))
        except OSError as error:
            if "truncated" not in str(error):
                raise ArchiveError(f"{path}: the archive is damaged: {error}. Nothing can be saved") from error
            damages.append("its end is missing")
            file = stack.enter_context(_padded(path, error, stack))
        try:
            check_origin(path, file)
        except ArchiveError:
            raise
        except Exception as error:
            raise ArchiveError(f"{path}: the archive is damaged: {error}. Nothing can be saved") from error
        yield file, damages


def _padded(path: Path, error: OSError, stack: ExitStack) -> Any:
    """The HDF5 file at ``path`` with zeros in place of its missing end."""
    size = int(str(error).rsplit("stored_eof =", 1)[1].split(",")[0].strip(" )"))
    try:
        return h5py.File(stack.enter_context(closing(_Padded(path, size))), "r")
    except Exception as again:
        raise ArchiveError(f"{path}: the archive is truncated, its end is missing. Nothing can be saved") from again


class _Padded(io.RawIOBase):
    """A file followed by zeros up to ``size`` bytes."""

    def __init__(self, path: Path, size: int) -> None:
        self._file, self._size, self._at = path.open("rb"), size, 0

    def readinto(self, buffer: Any) -> int:
        self._file.seek(self._at)
        data = self._file.read(len(buffer))
        count = min(len(buffer), self._size - self._at)
        buffer[:count] = data[:count] + bytes(count - len(data[:count]))
        self._at += count
        return count

    def seek(self, offset: int, whence: int = 0) -> int:
        self._at = offset + {0: 0, 1: self._at, 2: self._size}[whence]
        return self._at

    def tell(self) -> int:
        return self._at

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def close(self) -> None:
        self._file.close()
        super().close()


class _Check:
    """One look at everything in an archive."""

    def __init__(self, path: Path, file: Any, damages: list[str]) -> None:
        self.path, self.file, self.damages = path, file, damages
        self.leftovers: list[str] = []

    def verification(self) -> Verification:
        """Look, and say what was found."""
        record = self._holds("documents or meshes", lambda: _same(record_digest(self.file), "embedding", self.file))
        steps = self._count()
        rows = self._damaged_rows(steps)
        fields = [k + 1 for k in range(steps) if k + 1 in rows or not self._fields_hold(k)]
        for name, damaged in (("rows", rows), ("fields", [k for k in fields if k not in rows])):
            if damaged:
                self.damages.append(f"{name} of {_listed(damaged)}")
        kept = bool(steps) and self._holds(f"the checkpoint of step {steps}", lambda: self._slot_holds(steps))
        resumable = kept and int(self._slot(steps)["extent"][0]) == steps and not self._finished
        self._holds("how the run ended", self._finish_holds)
        if record:
            self._holds("what viewers take for the number of steps", lambda: self._views_hold(steps))
        self._look_behind(steps)
        whole = tuple(k + 1 for k in range(steps) if record and k + 1 not in fields)
        return Verification(
            self.path, steps, whole, tuple(self.damages), tuple(self.leftovers), resumable and len(whole) == steps
        )

    def _holds(self, what: str, check: Callable[[], bool]) -> bool:
        try:
            holds = check()
        except Exception:  # where bytes are wrong, HDF5 and h5py fail in many ways
            holds = False
        if not holds:
            self.damages.append(what)
        return holds

    def _count(self) -> int:
        """The number of steps; if it is damaged, of those that have whole rows."""
        try:
            count, steps = count_of(self.file["embedding/committed"]), len(self.file["embedding/steps/rows_digest"])
            if count <= steps:
                return count
        except Exception:
            pass
        self.damages.append("the number of steps")
        try:
            steps = len(self.file["embedding/steps/rows_digest"])
        except Exception:
            return 0
        damaged = self._damaged_rows(steps)
        return min(damaged, default=steps + 1) - 1

    def _damaged_rows(self, steps: int) -> list[int]:
        try:
            return damaged_rows(self.file["embedding"], steps)
        except Exception:
            pass
        damaged = list(range(1, steps + 1))
        for count in range(1, steps + 1):  # a chunk that cannot be read spoils those that follow
            try:
                damaged = [k for k in damaged if k > count or k in damaged_rows(self.file["embedding"], count)]
            except Exception:
                break
        return damaged

    def _fields_hold(self, step: int) -> bool:
        try:
            stored = self.file["embedding/steps/fields_digest"][step]
            return bool(np.array_equal(fields_digest(self.file, step), stored))
        except Exception:
            return False

    def _slot_holds(self, steps: int) -> bool:
        """What is saved of a damaged archive may have none: then the slot is empty."""
        slot = self._slot(steps)
        return int(slot["extent"][0]) in (0, steps) and bool(np.array_equal(slot_digest(slot), slot["digest"][...]))

    def _slot(self, steps: int) -> Any:
        return self.file["embedding/checkpoint"][SLOTS[steps % 2]]

    def _finish_holds(self) -> bool:
        data = self._finish
        return len(data) == 0 or _same(digest_of(data), "embedding/finish", self.file)

    @property
    def _finish(self) -> Any:
        finish = self.file["embedding/finish"]
        return finish["json"][: count_of(finish["length"])]

    @property
    def _finished(self) -> bool:
        """Has the run reached the end of its path? Not if that cannot be read: it is told as a damage then."""
        try:
            return bool(json.loads(bytes(self._finish))["result"]["name"] == "CONVERGED")
        except Exception:  # as in _holds; or empty, where it has not ended
            return False

    def _views_hold(self, steps: int) -> bool:
        """A run that is killed right before it counts a step has told viewers already."""
        groups = [self.file["VTKHDF"][name] for name in self.file["VTKHDF/Assembly/Scene"]]
        told = [int(group["Steps"].attrs["NSteps"]) for group in groups if "Steps" in group]
        return all(number in (steps, steps + 1) for number in told)

    def _look_behind(self, steps: int) -> None:
        """What a killed run has written of a step that does not count."""
        try:
            behind = len(self.file["embedding/steps/number"]) > steps or len(self.file["embedding/vtk/row"]) > steps
        except Exception:
            return
        if behind:
            self.leftovers.append(f"A half-written step {steps + 1} is ignored")


def _same(digest: Any, group: str, file: Any) -> bool:
    return bool(np.array_equal(digest, file[group]["digest"][...]))


def _steps(count: int) -> str:
    return f"{count} step" if count == 1 else f"{count} steps"


def _listed(numbers: Any) -> str:
    """Step numbers in words, runs of them together."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    parts = [str(a) if a == b else f"{a} to {b}" for a, b in runs]
    return f"step{'s' if len(parts) > 1 or runs[0][0] != runs[0][1] else ''} {', '.join(parts)}"
