"""The progress of a solve, on a terminal and elsewhere."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from rich.console import Console

from embedding.progress import ProgressDisplay
from embedding.scene import load_scene
from tests.cli.pretend import iteration, play, problem, record, solution


class Clock:
    """A clock that advances when told."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def test_plain_lines_elsewhere(scene_file: Path) -> None:
    stream, clock, scene = io.StringIO(), Clock(), load_scene(scene_file)
    with ProgressDisplay(Console(file=stream, width=40), clock) as progress:
        clock.now = 61.0
        done = play(scene, [progress])
        progress.finished(solution(scene, None, done))
    lines = stream.getvalue().splitlines()
    assert lines == [
        "small balloon: axisymmetric, 2 steps",
        "step 1/2 (inflate): mechanical 0.5, 2 iterations, stretch 1.1, 1:01",
        "step 2/2 (inflate): mechanical 1, 2 iterations, stretch 1.2, 1:01",
        "converged, 1:01",
    ]


def test_a_cut_is_told(scene_file: Path) -> None:
    stream = io.StringIO()
    progress = ProgressDisplay(Console(file=stream))
    play(load_scene(scene_file), [progress], fail_at=1)
    assert "step 1 is retried at 0.5 of its length: Newton did not converge" in stream.getvalue()


def test_panel_shows_the_present_step(scene_file: Path) -> None:
    scene, clock = load_scene(scene_file), Clock()
    progress = ProgressDisplay(Console(file=io.StringIO(), force_terminal=True), clock)
    clock.now = 125.0
    progress.live = None
    progress.started(problem(scene))
    progress.iterated(1, {"mechanical": 0.5, "field": 1.0}, iteration(1))
    progress.accepted(None, record(1, 2))  # type: ignore[arg-type]
    progress.iterated(2, {"mechanical": 1.0, "field": 1.0}, iteration(1))
    progress.iterated(2, {"mechanical": 1.0, "field": 1.0}, iteration(2))
    screen = Console(file=io.StringIO(), width=110, record=True)
    screen.print(progress.panel())
    text = screen.export_text()
    for expected in (
        "small balloon",
        "1/2 steps",
        "2:05",
        "step 2, inflate: mechanical 1\n",
        "1.00e-02",
        "1.00e-04",
        "402",
        "last accepted: step 1, stretch 1.1",
    ):
        assert expected in text, text
    assert text.count("e-02") == 1, "the history holds the present step only"


def test_a_terminal_is_left_as_it_was(scene_file: Path) -> None:
    stream, scene = io.StringIO(), load_scene(scene_file)
    console = Console(file=stream, force_terminal=True, width=100)
    with pytest.raises(KeyboardInterrupt), ProgressDisplay(console) as progress:
        play(scene, [progress])
        raise KeyboardInterrupt
    assert progress.live is None
    assert stream.getvalue().endswith("\x1b[?25h") or "\x1b[?25h" in stream.getvalue(), "the cursor is back"
