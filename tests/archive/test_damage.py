"""Whatever happens to the bytes of an archive: it is told, what is whole can be saved, and nothing wrong is read."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import h5py
import numpy as np
import pytest

from embedding import open_archive, solve, verify
from embedding.archive import Recorder, repair, salvage
from embedding.archive.layout import LIBVER
from embedding.errors import ArchiveError
from embedding.solving import session
from tests.archive.damage import damages, everything
from tests.archive.made_up_run import Problem, tell
from tests.archive.resumed import ROOT, Copies, load_scene, resume
from tests.archive.same import assert_same


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of a small run on three meshes."""
    changes = ("discretisation.order=1", 'discretisation.shell_size="15 mm"', "path=[{control='load', steps=3}]")
    path = tmp_path_factory.mktemp("damaged") / "run.vtkhdf"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(session, "WORN", 1.0)
        solution = solve(load_scene(ROOT / "problems" / "grounded_balloon.toml", changes), archive=path)
    assert solution["remeshings"].tolist() == [0, 1, 2]
    return path


@pytest.mark.parametrize("count", [12, pytest.param(800, marks=pytest.mark.slow)])
def test_any_damage(count: int, archive: Path, tmp_path: Path) -> None:
    """Of a file as it is, in a process of its own, which must not die of it."""
    copy = tmp_path / "run.vtkhdf"
    copy.write_bytes(archive.read_bytes())
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "tests.archive.damage", str(copy), "3", str(count)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-300:] + done.stderr[-3000:]
    outcomes = Counter(line.rsplit(": ")[1] for line in done.stdout.splitlines())
    assert outcomes.total() == count
    assert outcomes["damaged"] > outcomes["sound"] / 4, "damage to what counts, not only to what is left empty"


def flipped(archive: Path, target: Path, place: str, row: int) -> None:
    """A copy of an archive in which one number is another, as HDF5 would have written it."""
    target.write_bytes(archive.read_bytes())
    with h5py.File(target, "r+", libver=LIBVER) as file:
        data = file[place]
        data[row] = data[row] + 1


@pytest.mark.parametrize(
    ("place", "row", "what", "whole"),
    [
        ("embedding/scalars/charge", 1, "rows of step 2", (1, 3)),
        ("embedding/newton/update", 0, "rows of step 1", (2, 3)),
        ("embedding/steps/factor_field", 2, "rows of step 3", (1, 2)),
        ("embedding/vtk/first_point_of_outside", 2, "rows of step 3", (1, 2)),
        ("VTKHDF/outside/PointData/phi", 3, "fields of step 1", (2, 3)),
        ("VTKHDF/shell/Points", 3, "documents or meshes", ()),
        ("embedding/origins/1/numbers", 3, "documents or meshes", ()),
        ("embedding/checkpoint/odd/numbers", 3, "the checkpoint of step 3", (1, 2, 3)),
        ("embedding/committed", 0, "the number of steps", (1, 2, 3)),
        ("embedding/finish/json", 40, "how the run ended", (1, 2, 3)),
        ("embedding/finish/length", 0, "how the run ended", (1, 2, 3)),
    ],
)
def test_what_is_damaged_is_named(
    place: str, row: int, what: str, whole: tuple[int, ...], archive: Path, tmp_path: Path
) -> None:
    path = tmp_path / "spoilt.vtkhdf"
    flipped(archive, path, place, row)
    found = verify(path)
    assert not found.sound
    assert what in found.damages
    assert found.whole == whole
    with pytest.raises(ArchiveError, match="the archive is damaged"):
        open_archive(path).verify()


def test_a_unit_that_is_another(archive: Path, tmp_path: Path) -> None:
    path = tmp_path / "spoilt.vtkhdf"
    for name in ("VTKHDF/shell/PointData/p_t", "embedding/scalars/charge"):
        path.write_bytes(archive.read_bytes())
        with h5py.File(path, "r+", libver=LIBVER) as file:
            file[name].attrs["unit"] = np.bytes_(b"km")
        assert verify(path).damages == ("documents or meshes",)
        with pytest.raises(ArchiveError, match="documents or meshes"):
            open_archive(path).block("shell")


def test_a_whole_one(archive: Path) -> None:
    found = verify(archive)
    assert found.sound and not found.resumable and found.leftovers == ()  # it is finished
    assert (found.steps, found.saveable, found.whole) == (3, 3, (1, 2, 3))
    assert found.message == f"{archive}: whole; 3 steps"


@pytest.mark.slow
def test_without_its_end(archive: Path, tmp_path: Path) -> None:
    """What was written first outlives what was written last."""
    path, saved = tmp_path / "cut.vtkhdf", tmp_path / "saved.vtkhdf"
    content = archive.read_bytes()
    counts = []
    for part in np.linspace(0.2, 0.999, 12):
        path.write_bytes(content[: int(part * len(content))])
        with pytest.raises(ArchiveError, match="truncated"):
            open_archive(path)
        try:
            found = verify(path)
        except ArchiveError as error:
            assert "its end is missing. Nothing can be saved" in str(error)
            continue
        assert found.damages[0] == "its end is missing"
        counts.append(found.saveable)
        if found.saveable:
            saved.unlink(missing_ok=True)
            assert salvage(path, saved) == found.saveable
            assert verify(saved).sound
    assert max(counts) >= 2


def test_what_is_saved_of_a_run_can_go_on_from_the_step_before(tmp_path: Path) -> None:
    """The last step is lost; the checkpoint of the one before is still there."""
    changes = ("discretisation.order=2", "path.0.steps=3")
    whole = tmp_path / "whole.vtkhdf"
    copies = Copies(whole)
    solve(load_scene(ROOT / "problems" / "charged_balloon.toml", changes), archive=whole, listeners=[copies])
    spoilt, saved = tmp_path / "spoilt.vtkhdf", tmp_path / "saved.vtkhdf"
    flipped(copies.paths[1], spoilt, "embedding/scalars/charge", 1)
    with pytest.raises(ArchiveError, match=r"damaged: rows of step 2\. Whole, and to be saved: step 1 of 2 steps"):
        resume(spoilt)
    assert salvage(spoilt, saved) == 1
    resume(saved)
    assert_same(open_archive(saved), open_archive(whole))
    flipped(copies.paths[2], spoilt, "embedding/scalars/charge", 1)
    saved.unlink()
    assert salvage(spoilt, saved) == 1
    with pytest.raises(ArchiveError, match="saved from a damaged archive, without what a run goes on from"):
        resume(saved)


def test_half_a_step_is_reported(tmp_path: Path) -> None:
    """A kill between the rows of a step and the number of steps that count."""
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("axisymmetric", 1.0), steps=3, result="INTERRUPTED")
    with h5py.File(path, "r+", libver=LIBVER) as file:
        file["embedding/committed"][...] = [2, ~2]
    found = verify(path)
    assert found.sound and found.resumable and found.steps == 2
    assert found.message == f"{path}: whole; 2 steps. A half-written step 3 is ignored"
    assert repair(path) == 2
    assert verify(path).leftovers == ()


def test_documents_are_what_they_were(archive: Path) -> None:
    assert everything(open_archive(archive)) == everything(open_archive(archive))
    assert json.loads(everything(open_archive(archive)))["units"]["charge"] == "C"
    assert len(list(damages(b"abc", 1, 8))) == 8
