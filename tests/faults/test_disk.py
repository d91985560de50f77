"""Disks that are full, read-only or gone, and files that others hold: docs/faults.md has the table of outcomes."""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import h5py
import pytest

from embedding import Listener, load_scene, open_archive, resume, solve, verify
from embedding.archive.room import SPARE
from embedding.errors import ArchiveError
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from embedding.studies.errors import StudyError
from embedding.studies.index import Index, read_index
from tests.archive.resumed import ROOT
from tests.archive.same import assert_same
from tests.faults.runs import SCENE, SETS, ended, limited, words


class Sizes(Listener):
    """How large the archive is after each step."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.path.with_suffix(".sizes").touch()

    def accepted(self, state: State, record: StepRecord) -> None:
        with self.path.with_suffix(".sizes").open("a") as file:
            file.write(f"{self.path.stat().st_size}\n")


def room_for_some(whole: Path) -> int:
    """Bytes in which a run begins and does not end."""
    return SPARE + int(whole.with_suffix(".sizes").read_text().split()[2])


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The archive of the run that nothing happens to."""
    path = tmp_path_factory.mktemp("whole") / "run.vtkhdf"
    solve(load_scene(SCENE, SETS), archive=path, listeners=[Sizes(path)])
    return path


@contextmanager
def file_limit(size: int) -> Iterator[None]:
    """No file of this process may grow beyond ``size`` bytes."""
    former = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, former[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, former)


@contextmanager
def mounted(folder: Path, *options: str) -> Iterator[Path]:
    """A file system of its own at ``folder``; the test is left out where that needs rights it has not."""
    folder.mkdir(exist_ok=True)
    done = subprocess.run(["mount", "-t", "tmpfs", *options, "tmpfs", folder], capture_output=True, check=False)
    if done.returncode:
        pytest.skip("a file system cannot be mounted here")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


def test_full_before_the_first_step(tmp_path: Path) -> None:
    old = tmp_path / "run.vtkhdf"
    old.write_bytes(b"what was there before")
    with file_limit(50_000), pytest.raises(ArchiveError, match="cannot write the archive: File too large"):
        solve(load_scene(SCENE, SETS), archive=old)
    assert old.read_bytes() == b"what was there before"
    assert list(tmp_path.iterdir()) == [old]


def test_full_after_some_steps(whole: Path, tmp_path: Path) -> None:
    """What is there is whole, and goes on when there is room, to the last bit."""
    path = tmp_path / "run.vtkhdf"
    with (
        file_limit(room_for_some(whole)),
        pytest.raises(ArchiveError, match="File too large; the . steps .* embedding resume"),
    ):
        solve(load_scene(SCENE, SETS), archive=path)
    found = verify(path)
    assert found.sound and found.resumable and 0 < found.steps < 6, found.message
    resume(path)
    assert_same(open_archive(path), open_archive(whole))


def test_full_and_not_noticed(tmp_path: Path) -> None:
    """What HDF5 makes of a disk that fails in the middle of a commit is told, and the process does not die of it."""
    program = (
        "import sys; from embedding.archive import writer; writer.require_room = lambda *_: None; "
        "from embedding.cli import main; sys.exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, *words(tmp_path / "run.vtkhdf")],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        preexec_fn=limited(resource.RLIMIT_FSIZE, 300_000),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2, done.stderr[-500:]
    assert "error: " in done.stderr and "cannot write the archive" in done.stderr
    found = verify(tmp_path / "run.vtkhdf")
    assert found.saveable > 0


def test_a_small_disk(whole: Path, tmp_path: Path) -> None:
    """Really full: a file system of some megabytes."""
    with mounted(tmp_path / "disk", "-o", f"size={room_for_some(whole)}") as disk:
        code, _, err = ended(words(disk / "run.vtkhdf"), tmp_path)
        assert code == 2 and "No space left on device" in err and "Traceback" not in err
        found = verify(disk / "run.vtkhdf")
        assert found.sound and found.resumable and 0 < found.steps < 6, found.message
        table = disk / "p.csv"
        table.write_text("what was there before")
        with suppress(OSError), (disk / "rest").open("wb", 0) as rest:
            while rest.write(bytes(4096)) == 4096:
                pass
        code, _, err = ended(["balance", str(disk / "run.vtkhdf"), "--csv", str(table)], tmp_path)
        assert code == 2 and "No space left on device" in err and "Traceback" not in err
        assert table.read_text() == "what was there before"
        shutil.copy(disk / "run.vtkhdf", tmp_path / "run.vtkhdf")
    resume(tmp_path / "run.vtkhdf")
    assert_same(open_archive(tmp_path / "run.vtkhdf"), open_archive(whole))


def test_full_while_a_study_is_written(tmp_path: Path) -> None:
    path = tmp_path / "index.jsonl"
    first = {"case": "a", "status": "done", "reason": ""}
    with Index(path) as index:
        index.append(first)
        with file_limit(path.stat().st_size + 10), pytest.raises(StudyError, match="cannot be written: .* run again"):
            index.append({"case": "b", "status": "done", "reason": ""})
    assert read_index(path) == {"a": first}
    with Index(path) as index:
        index.append({"case": "c", "status": "done", "reason": ""})
    assert list(read_index(path)) == ["a", "c"]


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    with mounted(tmp_path / "disk", "-o", "ro") as disk:
        code, _, err = ended(words(disk / "run.vtkhdf"), tmp_path)
        assert code == 2 and "no permission to write" in err
        with pytest.raises(ArchiveError, match="no permission to write into the folder"):
            solve(load_scene(SCENE, SETS), archive=disk / "run.vtkhdf")


class Gone(Listener):
    """Removes a folder after two steps."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def accepted(self, state: State, record: StepRecord) -> None:
        if record.number == 2:
            shutil.rmtree(self.folder)


def test_the_folder_goes_away(tmp_path: Path) -> None:
    folder = tmp_path / "gone"
    folder.mkdir()
    with pytest.raises(ArchiveError, match=r"run\.vtkhdf: cannot write the archive: No such file or directory"):
        solve(load_scene(SCENE, SETS), archive=folder / "run.vtkhdf", listeners=[Gone(folder)])
    assert not folder.exists()


class Held(Listener):
    """Holds the archive, as a viewer does that locks what it reads, from the first step on."""

    def __init__(self, path: Path) -> None:
        self.path, self.files = path, list[h5py.File]()

    def accepted(self, state: State, record: StepRecord) -> None:
        holding = f"f = h5py.File({str(self.path)!r}, 'r', locking=True)"
        program = f"import h5py, time; {holding}; print(1, flush=True); time.sleep(99)"
        if record.number == 1:
            self.process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE)
            assert self.process.stdout is not None and self.process.stdout.readline() == b"1\n"


def test_another_process_has_locked_it(whole: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    held = Held(path)
    try:
        solve(load_scene(SCENE, SETS), archive=path, listeners=[held])
        assert_same(open_archive(path), open_archive(whole))
    finally:
        held.process.kill()
        held.process.communicate()
