"""No kill, at whatever moment, loses a committed step or touches an archive that was there before."""

from __future__ import annotations

import io
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from embedding.archive import file, open_archive, repair, writer
from embedding.errors import ArchiveError
from tests.archive import small_writer

ROOT = Path(__file__).parents[2]


def start(path: Path) -> subprocess.Popen[bytes]:
    """A process that writes steps to ``path`` until it is killed."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "tests.archive.small_writer", str(path)]
    return subprocess.Popen(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE)


@pytest.mark.parametrize("trials", [2, pytest.param(30, marks=pytest.mark.slow)])
def test_killed_at_random_moments(trials: int, tmp_path: Path) -> None:
    moments = np.random.default_rng(7).uniform(0.0, 0.25, trials)
    for run, moment in enumerate(moments):
        path = tmp_path / f"{run}.vtkhdf"
        process = start(path)
        assert process.stdout is not None
        told = [process.stdout.readline()]
        time.sleep(moment)
        process.send_signal(signal.SIGKILL)
        told += process.stdout.readlines()
        process.stdout.close()
        process.wait()
        archive = open_archive(path)
        count = small_writer.check(archive)
        assert count >= len(told), f"{len(told)} steps were told of, {count} are there"
        assert archive.result.name == "unfinished"
        archive.verify()
        assert repair(path) == count == small_writer.check(open_archive(path))
        h5py.File(path, "r").close()  # what viewers do: no mark is left


class Tape(io.RawIOBase):
    """A file that remembers every write."""

    def __init__(self, content: bytes) -> None:
        self.file = io.BytesIO(content)
        self.log: list[tuple[int, bytes | int]] = []

    def readinto(self, buffer: Any) -> int:
        return self.file.readinto(buffer)

    def seek(self, offset: int, whence: int = 0) -> int:
        return self.file.seek(offset, whence)

    def tell(self) -> int:
        return self.file.tell()

    def write(self, data: Any) -> int:
        self.log.append((self.file.tell(), bytes(data)))
        return self.file.write(data)

    def truncate(self, size: int | None = None) -> int:
        size = self.file.tell() if size is None else size
        self.log.append((size, -1))
        return self.file.truncate(size)

    def readable(self) -> bool:
        return True

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True


class Taped:
    """An HDF5 file on a tape, which goes to the disk and to the log when the file is closed."""

    def __init__(self, opened: Any, tape: Tape, path: Path, log: list[tuple[int, bytes | int]]) -> None:
        self.opened, self.tape, self.path, self.log = opened, tape, path, log

    def __enter__(self) -> Any:
        return self.opened

    def __exit__(self, *error: object) -> None:
        self.opened.close()
        self.path.write_bytes(self.tape.file.getvalue())
        self.log.extend(self.tape.log)


@pytest.mark.parametrize("every", [31, pytest.param(1, marks=pytest.mark.slow)])
def test_killed_after_a_write(every: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The writes of five commits are logged, and every beginning of that log (the slow one: each single one) is a file
    that must be readable."""
    path = tmp_path / "run.vtkhdf"
    target = small_writer.writer(path)
    small_writer.write(target, 1)
    first = path.read_bytes()
    log: list[tuple[int, bytes | int]] = []
    real = h5py.File

    def taped(name: Any, mode: str, **options: Any) -> Any:
        tape = Tape(Path(name).read_bytes())
        return Taped(real(tape, mode, libver=options["libver"]), tape, Path(name), log)

    monkeypatch.setattr(writer.h5py, "File", taped)
    monkeypatch.setattr(writer, "_synchronise", lambda file: file.flush())
    starts = [0]
    for number in range(2, 7):
        small_writer.write(target, number)
        starts.append(len(log))
    target.finish({"result": {"name": "converged", "advice": "", "message": ""}})
    monkeypatch.undo()
    monkeypatch.setattr(file, "PATIENCE", -1.0)  # the writer is dead: nothing to wait for
    crashed, content = tmp_path / "crashed.vtkhdf", io.BytesIO(first)
    copy = tmp_path / "copy.vtkhdf"
    counts: dict[int, int] = {}
    for place, (offset, data) in enumerate(log):
        if isinstance(data, bytes):
            content.seek(offset)
            content.write(data)
        else:
            content.truncate(offset)
        if place % every and place + 1 not in (*starts, len(log)):
            continue
        crashed.write_bytes(content.getvalue())
        archive = open_archive(crashed)
        counts[place] = small_writer.check(archive)
        assert archive.result.name in ("unfinished", "converged")
        if len(counts) % 3 == 0:
            shutil.copy(crashed, copy)
            assert repair(copy) == counts[place] == small_writer.check(open_archive(copy))
    assert list(counts.values()) == sorted(counts.values())
    assert len(log) > 100
    assert [counts[begin - 1] for begin in starts[1:]] == [2, 3, 4, 5, 6]
    assert open_archive(crashed).result.name == "converged"


def test_a_start_that_is_killed_leaves_the_old_archive(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.vtkhdf"
    small_writer.write(small_writer.writer(path), 1)
    before = path.read_bytes()
    fresh = small_writer.writer(path)

    def killed(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(writer, "_synchronise", killed)
    with pytest.raises(KeyboardInterrupt):
        small_writer.write(fresh, 1)
    monkeypatch.undo()
    assert path.read_bytes() == before
    small_writer.write(fresh, 1)  # and a later start takes over, with nothing left behind
    assert small_writer.check(open_archive(path)) == 1
    names = sorted(one.name for one in tmp_path.iterdir())
    assert names == ["run.outside.vtkhdf", "run.shell.vtkhdf", "run.vtkhdf"]


def test_a_full_disk_is_told_and_keeps_what_is_committed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.vtkhdf"
    target = small_writer.writer(path)
    for number in (1, 2):
        small_writer.write(target, number)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(writer, "_synchronise", full)
    with pytest.raises(ArchiveError, match=r"run\.vtkhdf.*No space left.*2 steps committed before are kept"):
        small_writer.write(target, 3)
    monkeypatch.undo()
    assert small_writer.check(open_archive(path)) == 2
    small_writer.write(target, 3)
    assert small_writer.check(open_archive(path)) == 3
