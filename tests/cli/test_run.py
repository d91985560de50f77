"""`embedding run` with a solver that only pretends: options, output, exit codes, and nothing half-written."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from embedding.errors import SolveError
from embedding.progress import ProgressDisplay
from tests.cli.conftest import Outcome
from tests.cli.pretend import play, solution

Call = Callable[..., Outcome]


class Solver:
    """Stands in for the real solver and remembers how it was called."""

    def __init__(self) -> None:
        self.calls: list[dict[str, Any]] = []
        self.fail_at: int | None = None
        self.result = "NOT_CONVERGED"
        self.error: BaseException | None = None

    def __call__(self, scene: Any, *, archive: Path | None, progress: bool, listeners: list[Any]) -> Any:
        self.calls.append({"scene": scene, "archive": archive, "progress": progress})
        if self.error is not None:
            raise self.error
        with ProgressDisplay() as display:
            done = play(scene, [*listeners, display] if progress else listeners, self.fail_at)
        if self.fail_at is not None:
            outcome = solution(scene, archive, done, self.result)
            raise SolveError("Newton did not converge: take smaller steps", outcome)
        return solution(scene, archive, done)


@pytest.fixture
def solver(monkeypatch: pytest.MonkeyPatch) -> Solver:
    fake = Solver()
    monkeypatch.setattr("embedding.api.solve", fake)
    return fake


def test_run_prints_the_result(scene_file: Path, call: Call, solver: Solver) -> None:
    outcome = call("run", scene_file)
    assert outcome.code == 0
    assert outcome.out.startswith("small balloon: converged after 2 steps\n")
    for expected in (
        "stretch              1.2\n",
        "pressure_difference  500 Pa\n",
        "limit point          mechanical 0.74 (stage inflate, before step 2; unstable modes 0 to 1)\n",
        "2.0e-04 of stretch: discretisation 2.0e-04 (one order lower)",
        "1 min 15 s, 310 MB, 1120 unknowns",
        "small_balloon.vtkhdf",
    ):
        assert expected in outcome.out
    assert "step 2/2 (inflate)" in outcome.err


def test_archive_is_named_after_the_scene_or_by_the_user(scene_file: Path, call: Call, solver: Solver) -> None:
    call("run", scene_file)
    call("run", scene_file, "--set", "name=a/b c", "--no-progress")
    call("run", scene_file, "--out", scene_file.parent / "mine.vtkhdf")
    assert [one["archive"] for one in solver.calls] == [
        Path("small_balloon.vtkhdf"),
        Path("a_b_c.vtkhdf"),
        scene_file.parent / "mine.vtkhdf",
    ]


def test_overrides_reach_the_scene(scene_file: Path, call: Call, solver: Solver) -> None:
    outcome = call("run", "--set", "shell.thickness=0.3 mm", "--set", "path.0.steps=5", scene_file)
    assert outcome.code == 0
    scene = solver.calls[0]["scene"]
    assert scene.shell.thickness == pytest.approx(3e-4)
    assert scene.path[0].steps == 5


def test_json_is_the_only_output_on_stdout(scene_file: Path, call: Call, solver: Solver) -> None:
    outcome = call("run", scene_file, "--json", "--no-progress")
    report = json.loads(outcome.out)
    assert outcome.code == 0
    assert outcome.err == ""
    assert solver.calls[0]["progress"] is False
    assert report["scene"] == "small balloon"
    assert report["result"] == "CONVERGED"
    assert report["steps"] == 2
    assert report["scalars"] == {"stretch": 1.2, "pressure_difference": 500.0, "charge": None}
    assert report["estimated_error"]["value"] == 2e-4
    assert report["cost"]["unknowns"] == {"displacement": 120, "potential": 1000}
    assert report["archive"] == "small_balloon.vtkhdf"
    assert report["picture"] is None


def test_a_failed_solve_is_three(scene_file: Path, call: Call, solver: Solver) -> None:
    solver.fail_at = 2
    outcome = call("run", scene_file, "--no-progress")
    assert outcome.code == 3
    assert outcome.out == ""
    assert outcome.err == (
        "error: Newton did not converge: take smaller steps\nThe record of the run is in small_balloon.vtkhdf.\n"
    )


def test_a_failed_solve_as_json(scene_file: Path, call: Call, solver: Solver) -> None:
    solver.fail_at = 2
    outcome = call("run", scene_file, "--json", "--no-progress")
    assert outcome.code == 3
    assert outcome.err == ""
    error = json.loads(outcome.out)["error"]
    assert error["kind"] == "solve"
    assert error["result"] == "NOT_CONVERGED"
    assert error["steps"] == 1
    assert error["archive"] == "small_balloon.vtkhdf"


@pytest.mark.parametrize("typed", [True, False])
def test_an_interrupt_is_130(scene_file: Path, call: Call, solver: Solver, typed: bool) -> None:
    if typed:
        solver.fail_at, solver.result = 2, "INTERRUPTED"
    else:
        solver.error = KeyboardInterrupt()
    outcome = call("run", scene_file, "--no-progress")
    assert outcome.code == 130
    assert outcome.err.startswith("error: ")
    assert "Traceback" not in outcome.err


def test_a_defect_is_one_message(scene_file: Path, call: Call, solver: Solver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("EMBEDDING_DEBUG", raising=False)
    solver.error = ZeroDivisionError("division by zero")
    outcome = call("run", scene_file)
    assert outcome.code == 1
    assert outcome.err.startswith("error: ZeroDivisionError: division by zero\nThis is a defect of embedding")
    monkeypatch.setenv("EMBEDDING_DEBUG", "1")
    with pytest.raises(ZeroDivisionError):
        call("run", scene_file)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            ("--out", "nowhere/x.vtkhdf"),
            "error: --out: the folder 'nowhere' of 'nowhere/x.vtkhdf' does not exist\n",
        ),
        (("--out", "x.h5"), "error: --out: 'x.h5' must end in '.vtkhdf'\n"),
        (("--out", "folder.vtkhdf"), "error: --out: 'folder.vtkhdf' is a folder, a file name is needed\n"),
        (("--picture", "x.jpg"), "error: --picture: 'x.jpg' must end in '.png'\n"),
        (
            ("--picture", "nowhere/x.png"),
            "error: --picture: the folder 'nowhere' of 'nowhere/x.png' does not exist\n",
        ),
    ],
)
def test_outputs_are_checked_before_anything_is_solved(
    scene_file: Path, call: Call, solver: Solver, words: tuple[str, ...], message: str
) -> None:
    (scene_file.parent / "folder.vtkhdf").mkdir()
    outcome = call("run", scene_file, *words)
    assert (outcome.code, outcome.out, outcome.err) == (2, "", message)
    assert solver.calls == []


@pytest.mark.parametrize(("option", "suffix"), [("--out", ".vtkhdf"), ("--picture", ".png")])
def test_a_scene_is_not_written_over(scene_file: Path, call: Call, solver: Solver, option: str, suffix: str) -> None:
    """Nor by another name of its file."""
    scene, link = scene_file.with_suffix(suffix), scene_file.with_name(f"link{suffix}")
    text = scene_file.read_text()
    scene.write_text(text)
    link.symlink_to(scene)
    for name in (scene, link):
        outcome = call("run", scene, option, name)
        expected = f"error: {option}: {str(name)!r} is the file that is read, and would be lost: name another\n"
        assert (outcome.code, outcome.out, outcome.err) == (2, "", expected)
    assert solver.calls == [] and scene.read_text() == text


def test_pictures_need_a_driver(scene_file: Path, call: Call, solver: Solver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("embedding.view.rendering.can_render", lambda: False)
    outcome = call("run", scene_file, "--picture", "x.png")
    assert outcome.code == 2
    assert "apt-get install libegl1 libgl1-mesa-dri" in outcome.err
    assert solver.calls == []
    assert list(scene_file.parent.iterdir()) == [scene_file]
