"""Process start to the first Newton step, against a process that only imports ngsolve."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from statistics import median

FIRST_STEP = """
import sys
from embedding import Listener, solve
from benchmarks.scenes import balloon
class Stop(Listener):
    def iterated(self, step_number, target, iteration):
        raise KeyboardInterrupt
scene = balloon(shell_size=0.3)
scene = scene.model_copy(update={"model": {"reduction": sys.argv[1]}})
solve(scene, throw=False, listeners=[Stop()])
"""


def wall(code: str, *arguments: str) -> float:
    """Median wall time of three fresh processes that run ``code``."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run([sys.executable, "-c", code, *arguments], check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return median(times)


def report() -> Iterator[str]:
    """One line a reduction."""
    bare = wall("import ngsolve")
    for reduction in ("axisymmetric", "3d"):
        first = wall(FIRST_STEP, reduction)
        yield f"{reduction}: {first / bare:.2f} times the import of ngsolve alone"
