"""Runs killed with -9 at random moments, again and again: no accepted step is lost, and the end is to the last bit that
of a run that nobody disturbed."""

from __future__ import annotations

import multiprocessing
import time
from multiprocessing.process import BaseProcess
from pathlib import Path

import numpy as np
import pytest

from embedding import open_archive, resume, verify
from tests.archive.resumed import work
from tests.archive.same import assert_same

AGAIN = 0.4
"""Part of the runs that are killed a second time."""


def worked(name: str, archive: Path, told: Path, seconds: float | None = None) -> float:
    """Let a process work on a scene (see ``work``) to its end, or kill it after so many seconds; returns how many it
    had."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["tests.archive.resumed"])  # so that a process is there at once
    process: BaseProcess = context.Process(target=work, args=(name, archive, told))
    process.start()
    started = time.monotonic()
    process.join(seconds)
    process.kill()
    process.join()
    assert process.exitcode in (0, -9)
    return time.monotonic() - started


@pytest.mark.parametrize(
    ("name", "trials"),
    [
        ("long balloon", 2),
        pytest.param("long balloon", 60, marks=pytest.mark.slow),
        pytest.param("membrane by arc length", 50, marks=pytest.mark.slow),
        pytest.param("past limit points, bending", 50, marks=pytest.mark.slow),
        pytest.param("two stages", 40, marks=pytest.mark.slow),
    ],
)
def test_killed_at_random_moments(name: str, trials: int, tmp_path: Path) -> None:
    whole = tmp_path / "whole.vtkhdf"
    worked(name, tmp_path / "first.vtkhdf", tmp_path / "told")  # the first process has more to load
    duration = worked(name, whole, tmp_path / "told")
    chance, found, undisturbed = np.random.default_rng(11), set[int](), open_archive(whole)
    for number in range(trials):
        path, told = tmp_path / f"run{number}.vtkhdf", tmp_path / f"told{number}"
        told.touch()
        for _ in range(1 + (chance.random() < AGAIN)):
            if path.exists() and open_archive(path).result.name == "CONVERGED":
                break
            worked(name, path, told, chance.uniform(0.1, 1.0) * duration)
            if path.exists():
                seen = verify(path)
                assert seen.sound, seen.message
                assert seen.steps >= told.stat().st_size, "an accepted step is lost"
        if not path.exists():
            assert told.stat().st_size == 0
            continue
        found.add(len(open_archive(path)))
        if open_archive(path).result.name != "CONVERGED":
            resume(path)
        assert_same(open_archive(path), undisturbed)
        path.unlink()
    if trials > 20:  # of a few, all may have been killed before their first step
        assert len(found) > 1, f"all were killed at the same steps {found}"
