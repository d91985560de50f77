"""Hysteresis: what a load that goes up and down makes of a path with two limit points.

The path itself is followed without jumps, along the unstable branch between the limit points. A structure under a
load that is raised slowly leaves its branch at the limit point where the load is greatest, and comes back, as the load
falls, at the one where it is least; both jumps go at a constant load. Theory page, "Critical points".
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
import numpy.typing as npt

from embedding.solving.events import StepRecord
from embedding.solving.solution import CriticalPoint, Solution

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Loop:
    """Two limit points of a stage in the order in which the path meets them; ``load`` names the factor that turns."""

    load: Literal["mechanical", "field"]
    first: CriticalPoint
    second: CriticalPoint

    @property
    def rising(self) -> CriticalPoint:
        """Where the state jumps as the load grows."""
        return max(self.first, self.second, key=self.factor)

    @property
    def falling(self) -> CriticalPoint:
        """Where it jumps as the load falls."""
        return min(self.first, self.second, key=self.factor)

    def factor(self, state: CriticalPoint | StepRecord) -> float:
        """The load factor of a state."""
        return state.factor_mechanical if self.load == "mechanical" else state.factor_field


@dataclass(frozen=True)
class Traced:
    """Curves (n, 2) of load factor and scalar, in the order in which they are run through."""

    rising: Array
    falling: Array


def loops(solution: Solution) -> tuple[Loop, ...]:
    """Every pair of limit points that follow each other in one stage of ``solution``."""
    limits = [point for point in solution.critical_points if point.kind == "limit"]
    return tuple(
        Loop("mechanical" if first.factor_mechanical != second.factor_mechanical else "field", first, second)
        for first, second in pairwise(limits)
        if first.stage == second.stage
    )


def traced(solution: Solution, loop: Loop, name: str) -> Traced:
    """The ``loop`` in the scalar ``name``: up along one stable branch, over to the other, and back.

    Where a jump ends is interpolated linearly between the accepted steps of the other branch; a branch that was not
    followed as far as that load is left out of the curve.

    Raises:
        KeyError: no such scalar.
    """
    solution[name]
    beyond = [point for point in solution.critical_points if point.kind == "limit" and point.stage == loop.first.stage]
    number = next(number for number, point in enumerate(beyond) if point is loop.second)
    before = _branch(solution, loop, name, None, loop.first)[::-1]
    behind = _branch(solution, loop, name, loop.second, beyond[number + 1] if number + 1 < len(beyond) else None)
    # Both begin at their own limit point.
    up, down = (before, behind) if loop.rising is loop.first else (behind, before)
    return Traced(
        np.concatenate([up[::-1], _landing(down, loop.factor(loop.rising), 1.0)]),
        np.concatenate([down[::-1], _landing(up, loop.factor(loop.falling), -1.0)]),
    )


def _branch(
    solution: Solution, loop: Loop, name: str, after: CriticalPoint | None, before: CriticalPoint | None
) -> Array:
    """Loads and scalars from one limit point (or the stage's start) to the next one (or its end), both included."""
    steps = [
        step
        for step in solution.steps
        if step.stage == loop.first.stage
        and (after is None or step.number >= after.before_step)
        and (before is None or step.number < before.before_step)
    ]
    states: list[CriticalPoint | StepRecord] = list(steps)
    states = [*([after] if after else []), *states, *([before] if before else [])]
    return np.array([(loop.factor(state), state.scalars[name]) for state in states]).reshape(-1, 2)


def _landing(branch: Array, load: float, sign: float) -> Array:
    """Where a jump at ``load`` comes down on ``branch``, which begins at its limit point, and on from there; loads grow
    along it with the ``sign`` 1 and fall with -1."""
    loads, values = sign * branch[:, 0], branch[:, 1]
    for number, (low, high) in enumerate(pairwise(loads)):
        if low <= sign * load <= high:
            value = np.interp(sign * load, [low, high], values[number : number + 2])
            return np.concatenate([[[load, value]], branch[number + 1 :]])
    return np.empty((0, 2))
