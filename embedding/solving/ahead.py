"""Is there a limit point of the load ahead? The path is followed a little way by arc length, to see, and left again."""

from __future__ import annotations

from dataclasses import dataclass

from embedding.solving.compression import mostly_compressed, region_in_compression, strongly_compressed
from embedding.solving.continuation import Corrector, at_parameter
from embedding.solving.critical import Search
from embedding.solving.newton import Clock
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.shell_path import ShellPath
from embedding.solving.state import State
from embedding.solving.walk import Stride, Walk, start

STEPS, ITERATIONS = 40, 12
"""The most steps that are looked ahead, and the most iterations of one."""
STRIDE = Stride(0.1, 0.25, 1e-3)


@dataclass(frozen=True)
class Ahead:
    """What was seen: the load of a ``limit`` point, that the end is ``reached`` without one, or where a membrane was
    ``compressed`` before either; else nothing."""

    limit: Target | None = None
    reached: bool = False
    compressed: str | None = None


def look_ahead(problem: Problem, here: Target, end: Target, tolerance: float) -> Ahead:
    """Follow the path from the present state, in equilibrium at the load ``here``, towards the load ``end``.

    The state is left as it was.
    """
    path = ShellPath(problem, here, end, Clock())
    corrector, saved = Corrector(path, tolerance, ITERATIONS), path.save()
    try:
        return _seen(path, corrector)
    finally:
        path.restore(saved)


def _seen(path: ShellPath, corrector: Corrector) -> Ahead:
    problem, goal = path.problem, at_parameter(1.0)
    found = start(corrector, goal, _unwatched)
    if isinstance(found, Result):
        return Ahead()
    metric, point = found
    walk = Walk(corrector, metric, point, goal, STRIDE, _unwatched, _untold)
    for _ in range(STEPS):
        if walk.advance() is not None:
            return Ahead()
        before, tangent = walk.before, walk.here.tangent
        if before is not None and tangent is not None and tangent.parameter < 0.0:
            critical = Search(corrector, metric, _unwatched).between(before, walk.here) or []
            turns = [one for one in critical if one.kind == "limit"]
            path.restore(turns[0].point.saved if turns else walk.here.saved)
            if mostly_compressed(problem):
                return Ahead(compressed=region_in_compression(problem, State(problem)))
            if turns:
                return Ahead(path.target(turns[0].parameter))
            turned = max(before.parameter, walk.here.parameter)
            walk.retract()
            if not walk.shorten(Result.STEP_BELOW_MINIMUM):  # it is there, if not in digits
                return Ahead(path.target(turned))
            continue
        if strongly_compressed(problem):
            return Ahead(compressed=region_in_compression(problem, State(problem)))
        if walk.done:
            return Ahead(reached=True)
    return Ahead()


def _unwatched(number: int, size: float, decrement: float) -> None:
    """Iterations on the way are not told."""


def _untold(length: float, reason: Result) -> None:
    """Nor are steps that were cut."""
