"""A run that was stopped, however, goes on as if it had not been: equal to the last bit."""

from __future__ import annotations

import re
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import h5py
import pytest

from embedding import ArchiveError, Result, Scene, SolveError, open_archive, resume, solve
from embedding.archive import recorder, resuming, verify
from embedding.archive.writer import ArchiveWriter
from embedding.solving import ramp, session
from tests.archive.resumed import CHANGES, KILL, Stop, check_resumed_after, scene_called, start
from tests.archive.same import assert_same
from tests.balloons import SMALL

SLOW = {
    "bending in space", "bent strip in a field", "coupled in space", "out of rest, past pull-in", "pull-in under load",
    "two stages",
}  # fmt: skip
SOME = {
    "past limit points, bending": 7, "out of rest, past pull-in": 4, "bending in space": 6, "pull-in under load": 4,
    "bent strip in a field": 5,
}  # fmt: skip
"""After every how many steps; after every second one else."""
BY_ARC_LENGTH = pytest.param("membrane by arc length", marks=pytest.mark.slow)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in CHANGES]
)
def test_after_a_step(name: str, tmp_path: Path) -> None:
    check_resumed_after(scene_called(name), tmp_path, SOME.get(name, 2))


COLUMN = """
name = "column"
[shell]
shape = { kind = "strip", length = "1 m" }
thickness = "10 mm"
material = { law = "st-venant-kirchhoff", youngs_modulus = "1 GPa", poisson_ratio = 0 }
[[supports]]
where = "x0"
kind = "clamped"
[[loads.edge_tractions]]
edge = "x1"
traction = ["-308 N/m", 0, 0]
"""
"""Under 1.5 times Euler's load."""
NEXT = pytest.param(1.0, [True, False], marks=pytest.mark.slow)


@pytest.mark.parametrize(("part", "found"), [(0.5, [False, True]), NEXT])
def test_onto_a_branch_or_not(part: float, found: list[bool], tmp_path: Path) -> None:
    """Two stages that ask for one: met in the first one, or in the second."""
    stages = (f'[[path]]\nname = "{name}"\nmechanical = {to}\nbranch = {{}}' for name, to in (("a", part), ("b", 1.1)))
    check_resumed_after(Scene.from_toml("\n".join((COLUMN, *stages))), tmp_path, 7)
    assert [c.good for c in open_archive(tmp_path / "whole.vtkhdf").health if c.topic == "branch"] == found


@pytest.mark.parametrize("name", [BY_ARC_LENGTH, "membrane", "staggered"])
def test_with_new_meshes_on_the_way(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(session, "WORN", 1.0)
    check_resumed_after(scene_called(name), tmp_path, 3)
    assert open_archive(tmp_path / "whole.vtkhdf").scalars["remeshings"][-1] >= 2


@pytest.mark.slow
def test_with_a_new_mesh_that_was_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried = []
    monkeypatch.setattr(session, "WORN", 1.0)
    monkeypatch.setattr(ramp, "_remeshed", lambda now: tried.append(now.remesh(lambda _: False)))
    check_resumed_after(scene_called("membrane"), tmp_path, 2)
    assert tried and not any(tried)


@pytest.mark.parametrize("name", ["bare balloon", BY_ARC_LENGTH])
def test_killed_and_killed_again(name: str, tmp_path: Path) -> None:
    """Processes that end without a word in their second and third step; the next ones go on."""
    whole, path = tmp_path / "whole.vtkhdf", tmp_path / "run.vtkhdf"
    last = len(solve(scene_called(name), archive=whole).steps)
    assert start(name, path, "2", "1").wait() == -9
    assert len(open_archive(path)) == 1
    if last > 2:
        assert start(name, path, "resume", "3", "2").wait() == -9
        assert len(open_archive(path)) == 2
    assert start(name, path, "resume").wait() == 0
    assert_same(open_archive(path), open_archive(whole))


@pytest.mark.parametrize("name", ["membrane", BY_ARC_LENGTH, "past limit points, bending"])
def test_interrupted(name: str, tmp_path: Path) -> None:
    whole, path = tmp_path / "whole.vtkhdf", tmp_path / "run.vtkhdf"
    scene = scene_called(name)
    solve(scene, archive=whole)
    with pytest.raises(SolveError, match=re.escape(f"embedding resume {path}")) as stopped:
        solve(scene, archive=path, listeners=[Stop(2, 2, KeyboardInterrupt)])
    assert stopped.value.solution.result is Result.INTERRUPTED
    assert open_archive(path).result.name == "INTERRUPTED"
    assert solve(scene, resume=path).archive == path
    assert_same(open_archive(path), open_archive(whole))


def test_an_error_of_a_listener(tmp_path: Path) -> None:
    whole, path = tmp_path / "whole.vtkhdf", tmp_path / "run.vtkhdf"
    solve(scene_called("bare balloon"), archive=whole)
    with pytest.raises(ZeroDivisionError):
        solve(scene_called("bare balloon"), archive=path, listeners=[Stop(2, 1, ZeroDivisionError)])
    resume(path)
    assert_same(open_archive(path), open_archive(whole))


def stopped(folder: Path, text: str = SMALL) -> Path:
    """The archive of a run that stopped in its second step."""
    path = folder / "run.vtkhdf"
    solve(Scene.from_toml(text), archive=path, throw=False, listeners=[Stop(2, 1, KeyboardInterrupt)])
    return path


def test_what_may_not_go_on(tmp_path: Path) -> None:
    path = stopped(tmp_path)
    with pytest.raises(ArchiveError, match="another scene"):
        solve(Scene.from_toml(SMALL.replace("500 Pa", "510 Pa")), resume=path)
    with pytest.raises(ArchiveError, match="in its own archive"):
        solve(Scene.from_toml(SMALL), resume=path, archive=tmp_path / "other.vtkhdf")
    assert resume(path).result.ok
    before = path.read_bytes()
    with pytest.raises(ArchiveError, match="finished: there is nothing to resume"):
        resume(path)
    assert path.read_bytes() == before
    never = tmp_path / "never.vtkhdf"
    solve(Scene.from_toml(SMALL), archive=never, throw=False, listeners=[Stop(1, 1, KeyboardInterrupt)])
    with pytest.raises(ArchiveError, match="no step was accepted"):
        resume(never)
    with pytest.raises(ArchiveError, match="no such archive"):
        resume(tmp_path / "missing.vtkhdf")


def test_a_damaged_or_older_archive(tmp_path: Path) -> None:
    path = stopped(tmp_path)
    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        file["embedding/scalars/stretch"][0] *= 1.001
    with pytest.raises(ArchiveError, match="damaged: rows of step 1.*cannot be resumed"):
        resume(path)
    with h5py.File(path, "r+") as file:
        file["embedding"].attrs["schema"] = 2
    with pytest.raises(ArchiveError, match="has layout 2; this version of embedding reads layout 3"):
        resume(path)


KEPT = {
    "": "at branches critical_points cuts iterations layout mesh meshed_at solver stage start system way",
    "system": "assembled linearised measured motions ranges turned unknowns",
    "membrane": "accepted end former landmark length start",
    "membrane by arc length": "end goal known launched start walk",
    "walk": "before blind done first here length weight",
}


@pytest.mark.parametrize("name", ["membrane", BY_ARC_LENGTH])
def test_whoever_changes_what_is_kept_raises_its_layout(name: str, tmp_path: Path) -> None:
    solve(scene_called(name), archive=tmp_path / "run.vtkhdf")
    memory = open_archive(tmp_path / "run.vtkhdf").checkpoint()
    assert memory["layout"] == 2
    tables = {"": memory, "system": memory["system"], name: memory["way"]}
    tables |= {"walk": memory["way"]["walk"]} if "walk" in memory["way"] else {}
    assert {part: " ".join(sorted(table)) for part, table in tables.items()} == {part: KEPT[part] for part in tables}


def test_what_another_layout_kept_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = stopped(tmp_path)
    before = path.read_bytes()
    monkeypatch.setattr(resuming, "LAYOUT", 1)
    with pytest.raises(ArchiveError, match="written by another version of embedding: .* Solve the scene again"):
        resume(path)
    assert path.read_bytes() == before


def test_other_versions_are_warned_of(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = stopped(tmp_path)
    true = recorder.versions()
    monkeypatch.setattr(resuming, "versions", lambda: true | {"ngsolve": "7.0"})
    with pytest.warns(resuming.OtherVersionsWarning, match=r"ngsolve .* then, 7\.0 now: .* last digits"):
        assert resume(path).result.ok


def test_another_mesh_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = stopped(tmp_path)
    before = path.read_bytes()
    monkeypatch.setattr(session, "mesh_digest", lambda mesh: "another one")
    with pytest.raises(session.OtherMeshError, match="mesh comes out different"):
        resume(path)
    assert path.read_bytes() == before


def test_a_moved_archive_goes_on_where_it_is(tmp_path: Path) -> None:
    path = stopped(tmp_path)
    moved = tmp_path / "elsewhere" / "it.vtkhdf"
    moved.parent.mkdir()
    path.rename(moved)
    assert resume(moved).archive == moved
    assert sorted(one.name for one in moved.parent.iterdir()) == ["it.shell.vtkhdf", "it.vtkhdf"]


def test_nobody_writes_into_a_run_that_went_on_elsewhere(tmp_path: Path) -> None:
    """A run that was taken for dead stops at its next step; the one that took over is not disturbed."""
    path, other = tmp_path / "run.vtkhdf", tmp_path / "other.vtkhdf"

    class TakeOver(Stop):
        def iterated(self, step_number, target, iteration) -> None:  # type: ignore[no-untyped-def]
            if (step_number, iteration.number) == self.where:
                with warnings.catch_warnings():
                    resume(path)
                    other.write_bytes(path.read_bytes())

    with pytest.raises(ArchiveError, match="another run has replaced"):
        solve(scene_called("bare balloon"), archive=path, listeners=[TakeOver(2, 1, KILL)])
    assert path.read_bytes() == other.read_bytes()


TAKEN_OVER = """
import sys
from pathlib import Path
from embedding.archive.repair import rewrite
for number in range(25):
    rewrite(Path(sys.argv[1]), f"{number:032x}")
"""


@pytest.mark.slow
def test_two_that_go_on_at_once_do_not_mix(tmp_path: Path) -> None:
    """Each copies the archive into a file of its own: whichever comes last has a whole one."""
    path = stopped(tmp_path)
    both = [subprocess.Popen([sys.executable, "-c", TAKEN_OVER, path], stderr=subprocess.PIPE) for _ in range(2)]
    ends = [one.communicate()[1].decode() for one in both]
    assert [one.returncode for one in both] == [0, 0], ends
    assert verify(path).sound
    assert [one.name for one in tmp_path.glob("*.partial")] == []
    assert resume(path, progress=False).result is Result.CONVERGED


def test_a_run_that_is_still_at_work_is_not_taken_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It writes a step while another gets ready to go on: that one would write the same step again."""
    path = stopped(tmp_path)
    before, going_on = path.read_bytes(), ArchiveWriter.going_on
    resume(path, progress=False)
    after = path.read_bytes()
    path.write_bytes(before)

    def late(*arguments: Any) -> ArchiveWriter:
        path.write_bytes(after)
        return going_on(*arguments)

    monkeypatch.setattr(ArchiveWriter, "going_on", late)
    with pytest.raises(ArchiveError, match="another run is at work there"):
        resume(path, progress=False)
    assert path.read_bytes() == after
