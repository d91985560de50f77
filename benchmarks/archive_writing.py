"""Writing the archive against solving: share of the time of one 3D run spent in the recorder. Target: at most 5 %."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.scenes import balloon
from embedding.archive import Recorder
from embedding.solving import run


class TimedRecorder(Recorder):
    """A recorder that adds up the time it takes."""

    seconds = 0.0

    def started(self, problem: Any) -> None:
        """Set up the archive, timed."""
        start = time.perf_counter()
        super().started(problem)
        self.seconds += time.perf_counter() - start

    def accepted(self, state: Any, record: Any) -> None:
        """Write a step, timed."""
        start = time.perf_counter()
        super().accepted(state, record)
        self.seconds += time.perf_counter() - start

    def finished(self, solution: Any) -> None:
        """Close the archive, timed."""
        start = time.perf_counter()
        super().finished(solution)
        self.seconds += time.perf_counter() - start


def report() -> Iterator[str]:
    """One line a mesh."""
    for shell_size in (0.3, 0.2):
        with tempfile.TemporaryDirectory() as folder:
            recorder = TimedRecorder(Path(folder) / "run.vtkhdf")
            start = time.perf_counter()
            solution = run(balloon(shell_size=shell_size), [recorder])
            whole = time.perf_counter() - start
            size = recorder.path.stat().st_size / 2**20
        share = recorder.seconds / (whole - recorder.seconds)
        yield f"mesh {shell_size:g}: {len(solution.steps)} steps, {size:.1f} MB, writing/solving {100 * share:.1f} %"
