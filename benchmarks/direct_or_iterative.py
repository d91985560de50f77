"""Where iteration beats factorisation: the ambient's motion, the potential and the joint step, by size and dimension.

The charged balloon at order 3, a tenth larger than at rest. Each cell is the time by iteration over that by
factorisation; below 1 iteration wins. "motion" is a step of the ambient to the inflated shell, "potential" its solve,
"joint" the residual, matrix and solution of one Newton step. One thread, seconds of computing.

``python -m benchmarks.direct_or_iterative``: a quarter of an hour; with ``docs`` it writes the table of
docs/coupled_step.md.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

from ngsolve import SetNumThreads, TaskManager

from benchmarks.coupled_step import LARGER, PAGE, inflate
from benchmarks.pages import tell
from benchmarks.scenes import balloon
from embedding.plan import explain
from embedding.solving.problem import Problem

MESHES = {
    "3d": ((0.141, 0.746), (0.116, 0.634), (0.0836, 0.479), (0.06, 0.362)),
    "axisymmetric": ((0.02, 0.1), (0.0105, 0.05), (0.0075, 0.035)),
}
"""Sizes of the elements on the shell and far away, in radii: 20 to 120 thousand unknowns of the potential in 3D, 60 to
400 thousand in two dimensions."""
PARTS = ("motion", "potential", "joint")


def measure(reduction: str, shell_size: float, ambient_size: float, linear: str) -> dict[str, Any]:
    """Unknowns and seconds of each part."""
    SetNumThreads(1)
    scene = balloon(shell_size=shell_size, ambient_size=ambient_size, linear=linear, reduction=reduction)
    with TaskManager():
        problem = Problem(scene, explain(scene))
        system, potential = problem.system, problem.system.potential
        if potential is None:
            raise RuntimeError("the timed scene has a field")
        system.load(1.0, 1.0, None)
        inflate(problem, LARGER)
        moments = [time.process_time()]
        for work in (system.follow, potential.solve, system.newton_update):
            work()
            moments.append(time.process_time())
    unknowns = (
        sum(int(motion.free.NumSet()) for motion in system.motions.values()),
        system.unknowns.count["phi"],
        system.free_count,
    )
    seconds = (after - before for before, after in zip(moments, moments[1:], strict=False))
    return {part: each for part, *each in zip(PARTS, unknowns, seconds, strict=True)}


def _row(reduction: str, shell_size: float, ambient_size: float) -> str:
    found = []
    for linear in ("direct", "iterative"):
        arguments = ["--one", reduction, str(shell_size), str(ambient_size), linear]
        command = [sys.executable, "-m", "benchmarks.direct_or_iterative", *arguments]
        found.append(json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout))
    direct, iterative = found
    cells = (f"{iterative[part][1] / direct[part][1]:.2f} | {direct[part][0]:,}" for part in PARTS)
    whole = sum(iterative[part][1] for part in PARTS) / sum(direct[part][1] for part in PARTS)
    return f"| {reduction} | {' | '.join(cells)} | {whole:.2f} |"


def report() -> Iterator[str]:
    """The table, line by line."""
    yield "| reduction | " + " | ".join(f"{part} | unknowns" for part in PARTS) + " | all three |"
    yield "|---" * (2 + 2 * len(PARTS)) + "|"
    for reduction, meshes in MESHES.items():
        yield from (_row(reduction, *sizes) for sizes in meshes)


def main(arguments: list[str]) -> None:
    """Print the table; with "docs" also write the page's."""
    tell(report(), PAGE if arguments == ["docs"] else None, "<!-- direct or iterative -->")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        _, _, reduction, shell_size, ambient_size, linear = sys.argv
        print(json.dumps(measure(reduction, float(shell_size), float(ambient_size), linear)))
    else:
        main(sys.argv[1:])
