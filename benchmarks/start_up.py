"""Processes against one that only imports ngsolve: up to the first Newton step, and a whole run to 1e-3.

``python -m benchmarks.start_up [docs]``; with ``docs`` the lines go on the page of the manual.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from benchmarks.pages import tell
from problems import charged_balloon

PAGE, MARK = Path(__file__).parent.parent / "docs" / "speed.md", "<!-- start up -->"

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
ASKED, ONE_STEP, TEN_STEPS = "accuracy.relative=1e-3", "path.0.steps=1", "path.0.steps=10"
"""The scene states no number of steps: the solver takes six of its own choice."""
RUNS = ((), (ASKED,), (ASKED, TEN_STEPS), (ASKED, ONE_STEP))
PAIRS = 7


def environment() -> dict[str, str]:
    """That of this process, in which Python keeps what it has compiled, as it does unless it is told not to."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def timed(command: Sequence[str], folder: str) -> tuple[float, float, str]:
    """Seconds of computing of a process, of the user's and the system's, its wall seconds, and what it printed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment(), cwd=folder)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, wall, done.stdout


def against_import(command: Sequence[str], pairs: int = PAIRS) -> tuple[str, str]:
    """Its time over that of the bare import, from processes in turn so that load is that of both: the median of the
    computing, its range, and the least wall times; and what it printed last. One process goes before them all, so that
    nothing is compiled or read for the first time.
    """
    bare = [sys.executable, "-c", "import ngsolve"]
    with TemporaryDirectory() as folder:
        timed(command, folder)
        turns = [(timed(bare, folder), timed(command, folder)) for _ in range(pairs)]
    ratios = sorted(whole[0] / alone[0] for alone, whole in turns)
    wall = min(whole[1] for _, whole in turns) / min(alone[1] for alone, _ in turns)
    return f"{median(ratios):.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}; wall {wall:.2f})", turns[-1][1][2]


def run_command(changes: Sequence[str]) -> list[str]:
    """`embedding run problems/charged_balloon.toml` with overrides, as a process."""
    words = [word for change in changes for word in ("--set", change)]
    scene = Path(charged_balloon.__file__).with_suffix(".toml")
    return [sys.executable, "-m", "embedding.cli", "run", str(scene), "--json", *words]


def error_of(printed: str, changes: Sequence[str]) -> float:
    """Relative error of the stretch that a run printed, against the exact thick sphere."""
    scalars = json.loads(printed)["scalars"]
    exact = charged_balloon.exact(charged_balloon.scene(*changes)).stretch(scalars["voltage"])
    return abs(scalars["stretch"] / exact - 1.0)


def report() -> Iterator[str]:
    """One line a reduction, and one for every run."""
    for reduction in ("axisymmetric", "3d"):
        ratio, _ = against_import([sys.executable, "-c", FIRST_STEP, reduction], 3)
        yield f"{reduction}, to the first Newton step: {ratio} times the import of ngsolve alone"
    for changes in RUNS:
        ratio, printed = against_import(run_command(changes))
        told = "embedding run problems/charged_balloon.toml" + "".join(f" --set '{change}'" for change in changes)
        yield (
            f"`{told}`: {ratio} times the import of ngsolve alone, the whole process; "
            f"error {error_of(printed, changes):.1e}"
        )


if __name__ == "__main__":
    tell((f"* {line}" for line in report()), PAGE if "docs" in sys.argv[1:] else None, MARK)
