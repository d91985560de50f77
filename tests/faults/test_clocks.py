"""A clock that is set while a run is at work changes nothing but the date it began."""

from __future__ import annotations

import itertools
import os
import time
from pathlib import Path

import pytest

from embedding import load_scene, open_archive, solve
from embedding.bench import measure_spending
from tests.archive.same import assert_same
from tests.faults.runs import SCENE, SETS


def test_a_clock_that_jumps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    paths = [tmp_path / "one.vtkhdf", tmp_path / "other.vtkhdf"]
    scene = load_scene(SCENE, SETS)
    solve(scene, archive=paths[0])
    now, jumps = time.time(), itertools.cycle((0.0, -4e8, 4e8, 3.0, -3.0))
    with monkeypatch.context() as patch:
        patch.setattr(time, "time", lambda: now + next(jumps))
        patch.setattr(time, "time_ns", lambda: int(1e9 * (now + next(jumps))))
        solution = solve(scene, archive=paths[1])
        archive = open_archive(paths[1])
        assert_same(open_archive(paths[0]), archive)
    assert 0.0 < sum(step.wall_seconds for step in archive.steps) <= solution.cost.wall_seconds < 600.0
    assert all(step.wall_seconds >= 0.0 for step in archive.steps)
    assert all(seconds >= 0.0 for seconds in solution.cost.parts.values())


@pytest.mark.parametrize("date", [0.0, 4e9])
def test_archives_of_the_past_and_of_the_future(date: float, tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    solve(load_scene(SCENE, (*SETS, "path.0.steps=1")), archive=path)
    os.utime(path, (date, date))
    assert len(open_archive(path)) > 0
    with path.open("r+b") as file:  # marked as open, as a killed run leaves it
        file.truncate(path.stat().st_size)
    os.utime(path, (date, date))
    open_archive(path).verify()


def test_what_a_bench_measures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two processes: by a clock that both share and that nobody can set."""
    monkeypatch.setattr(time, "time", lambda: 1e12)
    found = measure_spending(Path(SCENE), (*SETS, "path.0.steps=1"))
    assert all(0.0 <= part.seconds <= 1.05 * found.total for part in found.parts)
