"""Archives and surfaces of strangers, and wrong words: no crash, no defect, nothing changed by a refusal."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from embedding import open_archive, verify
from embedding.archive import salvage
from embedding.archive.layout import LIBVER
from embedding.errors import ArchiveError
from tests.archive.resumed import ROOT
from tests.doors.batches import outcomes, stopped_run
from tests.doors.commands import ARCHIVE, SCENE, prepare


@pytest.fixture(scope="module")
def stopped(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An archive whose run can go on."""
    return stopped_run(tmp_path_factory.mktemp("stopped") / "whole.vtkhdf")


def some(*cases: tuple[int, int]) -> object:
    """The first cases by default, the others in the slow suite."""
    return pytest.mark.parametrize(
        "first, count", [cases[0], *(pytest.param(*one, marks=pytest.mark.slow) for one in cases[1:])]
    )


@some((0, 8), (1000, 500), (2000, 500))
def test_archives(first: int, count: int, stopped: Path) -> None:
    """Things in them removed, replaced, linked in circles; checksums that hold in spite of it."""
    lines, codes = outcomes("archives", stopped, first, count)
    bad = [line for line in lines if ": code 1" in line or " CHANGED" in line and "resume" not in line]
    assert bad == []
    assert lines[-1] == "ran: 0 []"
    assert codes.total() == count and codes["2"] > count / 4


@some((0, 6), (1000, 200), (2000, 200))
def test_surfaces(first: int, count: int, tmp_path: Path) -> None:
    """STEP and BREP files that the geometry kernel dies of."""
    lines, _ = outcomes("surfaces", tmp_path, first, count)
    assert len(lines) == count
    assert all(": planned" in line or ": refused: shell.shape" in line for line in lines)


@some((0, 25), (1000, 700), (2000, 700))
def test_commands(first: int, count: int, stopped: Path, tmp_path: Path) -> None:
    """Words lost, doubled, swapped and replaced by wrong ones, places that cannot be written."""
    prepare(tmp_path, stopped)
    lines, codes = outcomes("commands", tmp_path, first, count)
    assert [line for line in lines if ": code 1" in line or " LEFT " in line] == []
    assert codes.total() == count and set(codes) <= {"0", "2", "3", "4"} and codes["2"] > count / 2


@pytest.mark.parametrize(
    ("words", "code", "part"),
    [
        (("run", SCENE, "--out", SCENE), 2, "must end in '.vtkhdf'"),
        (("run", "missing.toml"), 2, "missing.toml: there is no such file"),
        (("run", SCENE, "--out", "no/x.vtkhdf"), 2, "--out: the folder 'no'"),
        (("info", "other.vtkhdf"), 2, "other.vtkhdf: "),
        (("info", "empty.vtkhdf"), 2, "empty.vtkhdf: is empty"),
        (("info", "a folder"), 2, "a folder: is a folder, not an archive"),
        (
            ("probe", ARCHIVE, "--from", "0", "0", "0", "--to", "0", "0", "1", "--points", "100000000000"),
            2,
            "at most 1000000",
        ),
        (("verify", ARCHIVE), 0, "whole; 2 steps"),
    ],
)
def test_as_a_process(words: tuple[str, ...], code: int, part: str, stopped: Path, tmp_path: Path) -> None:
    """What a person sees in a terminal."""
    prepare(tmp_path, stopped)
    command = [sys.executable, "-m", "embedding.cli", *words]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert (done.returncode, "Traceback" in done.stderr) == (code, False), done.stderr
    assert part in (done.stderr if code else done.stdout)


def test_texts_where_numbers_were(stopped: Path, tmp_path: Path) -> None:
    """HDF5 would put pointers where Python has objects: reading them was the end of the process."""
    path = tmp_path / "forged.vtkhdf"
    path.write_bytes(stopped.read_bytes())
    with h5py.File(path, "r+", libver=LIBVER) as file:
        del file["embedding/scalars/charge"]
        texts = file.create_dataset(
            "embedding/scalars/charge", data=[["a"], ["b"]], dtype=h5py.string_dtype(), maxshape=(None, 1)
        )
        texts.attrs["unit"] = np.bytes_(b"C")
    assert not verify(path).sound
    with pytest.raises(ArchiveError, match="damaged"):
        _ = open_archive(path).scalars


def test_a_thousand_ways_round(stopped: Path, tmp_path: Path) -> None:
    """Groups that hold each other have endless paths."""
    path = tmp_path / "circles.vtkhdf"
    path.write_bytes(stopped.read_bytes())
    with h5py.File(path, "r+", libver=LIBVER) as file:
        for number in range(50):
            file[f"embedding/way{number}"] = file["embedding"]
    assert "documents or meshes" in verify(path).damages


def test_more_steps_than_rows(stopped: Path, tmp_path: Path) -> None:
    path = tmp_path / "many.vtkhdf"
    path.write_bytes(stopped.read_bytes())
    with h5py.File(path, "r+", libver=LIBVER) as file:
        file["embedding/committed"][...] = [2**40, ~(2**40)]
    found = verify(path)
    assert "the number of steps" in found.damages and found.whole == (1, 2)
    with pytest.raises(ArchiveError, match="damaged: 1099511627776 steps, and rows of fewer"):
        open_archive(path)


def test_what_is_saved_is_another_file(stopped: Path, tmp_path: Path) -> None:
    path = tmp_path / "damaged.vtkhdf"
    path.write_bytes(stopped.read_bytes()[:-100])
    before = path.read_bytes()
    with pytest.raises(ArchiveError, match="is the damaged archive itself; name another file"):
        salvage(path, tmp_path / "." / "damaged.vtkhdf")
    assert path.read_bytes() == before
