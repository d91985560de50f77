"""One coupled Newton step against one ambient Poisson solve (assemble, factor, solve), same mesh, 3D, order 3.

The step consists of the ambient's motion, the potential's own solve and the joint update. The Poisson solve is that
of the potential on the moved mesh. The interface is closed, opened where the scene needs it ("auto": at the top of a
conductor), or opened at both faces. Target: a ratio of at most 5.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from statistics import median

from benchmarks.scenes import balloon
from embedding.plan import explain
from embedding.solving.problem import Problem

MESHES = ((0.3, 2.0), (0.2, 2.0), (0.2, 1.0), (0.15, 1.0))


def seconds(work: Callable[[], object], repeats: int = 5) -> float:
    """Median wall time of ``work``, after one run that is not counted."""
    work()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return median(times)


def operations(problem: Problem) -> tuple[Callable[[], object], Callable[[], object]]:
    """The Poisson solve and the whole step on ``problem``, whose system stays where it is."""
    system = problem.system
    system.load(1.0, 0.5, None)
    system.follow()
    potential = system.potential
    if potential is None:
        raise RuntimeError("the timed scene has a field")
    still = system.unknowns.state.vec.FV().NumPy().copy()
    step_count = [0]

    def step() -> None:
        # A face that moves back and forth by a noticeable amount makes the ambient follow in every step.
        sign = -1.0 if step_count[0] % 2 else 1.0
        step_count[0] += 1
        system.unknowns.state.vec.FV().NumPy()[:] = still * (1 + 0.01 * sign)
        system.load(1.0, 0.5, None)
        system.follow()
        potential.solve()
        system.newton_update()

    def poisson() -> None:
        potential.forget()
        potential.solve()

    return poisson, step


def measure(shell_size: float, ambient_size: float, interface: str) -> str:
    """One line of the table."""
    scene = balloon(shell_size=shell_size, ambient_size=ambient_size, interface=interface)
    problem = Problem(scene, explain(scene))
    poisson, whole = (seconds(work) for work in operations(problem))
    counts = problem.system.unknowns.count
    return (
        f"{interface:7s} mesh {shell_size:g}/{ambient_size:g}: {problem.mesh.ne} tets, {counts['phi']} potential and "
        f"{problem.system.free_count} joint unknowns: ratio {whole / poisson:.1f}"
    )


def report() -> Iterator[str]:
    """The table, line by line."""
    for interface in ("closed", "auto", "opened"):
        for shell_size, ambient_size in MESHES:
            yield measure(shell_size, ambient_size, interface)
