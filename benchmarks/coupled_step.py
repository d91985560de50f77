"""One coupled Newton step against one Poisson solve as the ambient grows, 3D, order 3: seconds, memory, exponents.

The scene is the charged balloon, its top face opened, meshes refined everywhere alike. It starts a tenth larger than at
rest, and Newton's method brings it to equilibrium; beyond ``WHOLE`` unknowns only the first step is taken. The step of
the table is that first one: the ambient's motion, the potential's own solve and the joint update. The Poisson solve
assembles, prepares and solves the potential's system on the moved mesh, with the same solver. All runs on one thread
and is measured in its seconds of computing, so that other work on the machine does not count. Every size has a process
of its own for the peak of its memory.

A second table has the parts of that step and of the Poisson solve.

``python -m benchmarks.coupled_step [unknowns ...]``: 10000 and 100000 by default; 1000000 takes a quarter of an hour.
With ``docs`` before them the tables are written to docs/coupled_step.md.
"""

from __future__ import annotations

import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from ngsolve import BND, SetNumThreads, TaskManager

from benchmarks.pages import tell
from benchmarks.scenes import balloon
from embedding.plan import explain
from embedding.solving.events import Iteration
from embedding.solving.newton import Newton
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.state import State
from embedding.timing import Watch, watching

MESHES = {10_000: (0.2, 1.0), 100_000: (0.0627, 0.376), 1_000_000: (0.0257, 0.154)}
"""Sizes of the elements on the shell and far away, in radii, that give about so many unknowns of the potential."""
DEFAULT = (10_000, 100_000)
WHOLE = 200_000
LARGER = 0.1
LEAST = 0.01
"""Parts of less than so many Poisson solves are left out."""
PAGE = Path(__file__).parent.parent / "docs" / "coupled_step.md"


def measure(unknowns: int, linear: str = "auto") -> dict[str, Any]:
    """Unknowns, seconds, iterations and memory of one size."""
    shell_size, ambient_size = MESHES[unknowns]
    scene = balloon(shell_size=shell_size, ambient_size=ambient_size, linear=linear)
    SetNumThreads(1)
    watch, parts = Watch(time.process_time), dict[str, dict[str, float]]()
    with TaskManager(), watching(watch):
        problem = Problem(scene, explain(scene))
        system, potential = problem.system, problem.system.potential
        if potential is None:
            raise RuntimeError("the timed scene has a field")
        inflate(problem, LARGER)
        most = scene.solver.max_iterations if unknowns <= WHOLE else 1
        newton = Newton(system, scene.solver.tolerance, most, State(problem).mean_pressures)
        newton.load(Target(1.0, 1.0, None, None))
        seconds = since(watch)
        times = [time.process_time()]

        def note(_: Iteration) -> None:
            times.append(time.process_time())
            parts.setdefault("step", seconds())

        outcome = newton.solve(note)
        if outcome.reason is not None and most > 1:
            raise RuntimeError(f"Newton's method ended: {outcome.reason.name}")
        linear_iterations = None if potential.iterative is None else system.iterations
        potential.forget()
        seconds = since(watch)
        start = time.process_time()
        potential.solve()
        poisson = time.process_time() - start
        parts["poisson"] = seconds()
    return {
        "unknowns": system.unknowns.count["phi"],
        "joint": system.free_count,
        "poisson": poisson,
        "step": times[1] - times[0],
        "solve": times[-1] - times[0] if most > 1 else None,
        "steps": len(outcome.iterations),
        "iterations": linear_iterations,
        "parts": parts,
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20,
    }


def since(watch: Watch) -> Callable[[], dict[str, float]]:
    """What tells the seconds spent in each part from now on."""
    watch.charge()
    before = dict(watch.seconds)

    def spent() -> dict[str, float]:
        watch.charge()
        return {" > ".join(names): t - before.get(names, 0.0) for names, t in watch.seconds.items()}

    return spent


def inflate(problem: Problem, part: float) -> None:
    """Put the shell where it is larger by ``part``."""
    unknowns = problem.system.unknowns
    unknowns.field("u").Set(part * problem.reduction.position, BND, definedon=problem.domain.shell)
    unknowns.field("u").vec.FV().NumPy()[~unknowns.trace.free] = 0.0
    problem.system.place_faces()


def measured(sizes: Sequence[int]) -> Iterator[dict[str, Any]]:
    """Every size, in a process of its own."""
    for size in sizes:
        command = [sys.executable, "-m", "benchmarks.coupled_step", "--one", str(size)]
        yield json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)


def table(rows: Iterable[dict[str, Any]]) -> Iterator[str]:
    """The table as Markdown, and by what power of the unknowns each column grows."""
    yield "| potential | joint unknowns | linear iterations | Poisson solve | Newton step | Newton solve | memory |"
    yield "|---|---|---|---|---|---|---|"
    known: list[dict[str, Any]] = []
    for row in rows:
        known.append(row)
        yield _line(row)
    for before, after in pairwise(known):
        powers = {name: _power(before, after, name) for name in ("poisson", "step", "solve", "memory")}
        cells = " | ".join(powers.values())
        yield f"| power from {before['unknowns']:,} to {after['unknowns']:,} | | | {cells} |"


def table_of_parts(rows: Sequence[dict[str, Any]]) -> Iterator[str]:
    """Where the step and the Poisson solve go, in Poisson solves: by part, and what is inside it."""
    columns = [(row, kind) for row in rows for kind in ("step", "poisson")]
    heads = (f"{row['unknowns']:,}: {'Newton step' if kind == 'step' else 'Poisson solve'}" for row, kind in columns)
    yield "| part | " + " | ".join(heads) + " |"
    yield "|---" * (1 + len(columns)) + "|"
    names = dict.fromkeys(name for row, kind in columns for name in row["parts"][kind] if name)
    for name in sorted(names):
        shares = [row["parts"][kind].get(name, 0.0) / row["poisson"] for row, kind in columns]
        if max(shares) >= LEAST:
            yield f"| {name} | " + " | ".join(f"{share:.2f}" if share >= LEAST else "" for share in shares) + " |"


def _line(row: dict[str, Any]) -> str:
    counts = "direct" if row["iterations"] is None else " and ".join(map(str, row["iterations"]))
    step, poisson = row["step"], row["poisson"]
    solve = "" if row["solve"] is None else f"{row['steps']} steps, {row['solve'] / poisson:.1f} Poisson solves"
    sizes = f"| {row['unknowns']:,} | {row['joint']:,} | {counts} "
    return f"{sizes}| {poisson:.2g} s | {step / poisson:.1f} Poisson solves | {solve} | {row['memory']:.2g} GB |"


def _power(before: dict[str, Any], after: dict[str, Any], name: str) -> str:
    if before[name] is None or after[name] is None:
        return ""
    return f"{math.log(after[name] / before[name]) / math.log(after['unknowns'] / before['unknowns']):.2f}"


def report() -> Iterator[str]:
    """The tables of the default sizes, line by line."""
    rows = list(measured(DEFAULT))
    yield from table(rows)
    yield from table_of_parts(rows)


def main(arguments: list[str]) -> None:
    """Print the tables; with "docs" first also write the page's."""
    docs = arguments[:1] == ["docs"]
    sizes = [int(size) for size in arguments[docs:]] or (tuple(MESHES) if docs else DEFAULT)
    rows: list[dict[str, Any]] = []

    def kept() -> Iterator[dict[str, Any]]:
        for row in measured(sizes):
            rows.append(row)
            yield row

    page = PAGE if docs else None
    tell(table(kept()), page, "<!-- coupled step -->")
    tell(table_of_parts(rows[:2]), page, "<!-- parts of the step -->")


if __name__ == "__main__":
    if "--one" in sys.argv:
        print(json.dumps(measure(int(sys.argv[sys.argv.index("--one") + 1]))))
    else:
        main(sys.argv[1:])
