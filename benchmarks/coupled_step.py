"""One coupled Newton step against one Poisson solve as the ambient grows, 3D, order 3: seconds, memory, exponents.

The scene is the charged balloon, its top face opened, meshes refined everywhere alike. The step consists of the
ambient's motion, the potential's own solve and the joint update; the Poisson solve assembles, prepares and solves the
potential's system on the moved mesh. Both run on one thread and are measured in its seconds of computing, so that other
work on the machine does not count. Every size has a process of its own for the peak of its memory.

``python -m benchmarks.coupled_step [unknowns ...]``: 10000 and 100000 by default; 1000000 takes a quarter of an hour.
"""

from __future__ import annotations

import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from benchmarks.newton_step import operations
from benchmarks.scenes import balloon
from embedding.plan import explain
from embedding.solving.problem import Problem

MESHES = {10_000: (0.2, 1.0), 100_000: (0.0627, 0.376), 1_000_000: (0.0257, 0.154)}
"""Sizes of the elements on the shell and far away, in radii, that give about so many unknowns of the potential."""
DEFAULT = (10_000, 100_000)


def measure(unknowns: int, linear: str = "auto") -> dict[str, Any]:
    """Unknowns, seconds, iterations and memory of one size."""
    shell_size, ambient_size = MESHES[unknowns]
    scene = balloon(shell_size=shell_size, ambient_size=ambient_size, linear=linear)
    problem = Problem(scene, explain(scene))
    poisson, step = operations(problem)
    poisson()  # what is prepared once, as the patches
    times = [_computing(poisson), _computing(step)]
    system = problem.system
    potential = system.potential
    iterative = potential is not None and potential.iterative is not None
    return {
        "unknowns": system.unknowns.count["phi"],
        "joint": system.free_count,
        "poisson": times[0],
        "step": times[1],
        "iterations": system.iterations if iterative else None,
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20,
    }


def _computing(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def table(sizes: Sequence[int]) -> Iterator[str]:
    """The table as Markdown, and by what power of the unknowns each column grows."""
    yield "| potential | joint unknowns | Poisson solve | Newton step | ratio | iterations | memory |"
    yield "|---|---|---|---|---|---|---|"
    rows = []
    for size in sizes:
        command = [sys.executable, "-m", "benchmarks.coupled_step", "--one", str(size)]
        rows.append(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
        row = rows[-1]
        counts = "direct" if row["iterations"] is None else " and ".join(map(str, row["iterations"]))
        yield (
            f"| {row['unknowns']:,} | {row['joint']:,} | {row['poisson']:.2g} s | {row['step']:.2g} s "
            f"| {row['step'] / row['poisson']:.1f} | {counts} | {row['memory']:.1f} GB |"
        )
    for before, after in zip(rows, rows[1:], strict=False):
        growth = math.log(after["unknowns"] / before["unknowns"])
        names = ("poisson", "step", "memory")
        powers = (f"{name} {math.log(after[name] / before[name]) / growth:.2f}" for name in names)
        yield f"growth from {before['unknowns']:,} to {after['unknowns']:,}: {', '.join(powers)}"


def report() -> Iterator[str]:
    """The table of the default sizes, line by line."""
    yield from table(DEFAULT)


if __name__ == "__main__":
    if "--one" in sys.argv:
        print(json.dumps(measure(int(sys.argv[sys.argv.index("--one") + 1]))))
    else:
        for line in table([int(size) for size in sys.argv[1:]] or DEFAULT):
            print(line, flush=True)
