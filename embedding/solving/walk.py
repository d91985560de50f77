"""Walking an equilibrium path by arc length: predict, correct, choose the next step, and land on the goal exactly.

The step follows from the number of iterations the last one took (Ramm, in: Nonlinear Finite Element Analysis in
Structural Mechanics, 1981, 63) and from the error of its prediction, which grows with a known power of the step. The
direction follows by continuity: the walk never turns back, at a limit point the load does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from embedding.solving.continuation import (
    Condition,
    Correction,
    Corrector,
    Direction,
    Metric,
    Watch,
    at_parameter,
)
from embedding.solving.curve import Curve, Point
from embedding.solving.memory import Memory, of_point, point_of
from embedding.solving.result import Result

AIM, EASE, NEAR = 5.0, 1.5, 1e-4
"""Iterations the step length aims at, and by what factor it changes for each one more or less; updates of less than
this part of the step are no sign of a hard one, and do not count."""
MISSED = 0.1
"""Largest error of a prediction, relative to the step, that lets the step grow."""
FASTEST, SLOWEST = 2.5, 0.4
"""The most and the least a step may be of the one before."""
STRAYED = 1.0
"""A point farther from its prediction, in steps, is on another path: that of a sheet turned inside out, for one."""
TURN = 0.5
"""Smallest cosine between a step and the tangents at its ends; below it another branch may have been met."""
REACH = 1.15
"""A goal this many steps ahead is reached in one."""
FARTHEST, LONGEST = 0.2, 1.0
"""The longest first step, and the longest one of all, in sizes of the structure."""
CUT = 0.5
CLOSER, MOST_CLOSER = 0.8, 40
"""By how much, and how often, a step is shortened that would change the parameter too much."""
WEIGHT, LIGHTEST, HEAVIEST = 0.3, 1e-12, 0.3
"""Weight of the parameter in lengths: relative to the response at the start, and its bounds."""


@dataclass(frozen=True)
class Stride:
    """Lengths of steps as changes of the parameter: the first one's, the largest, and the smallest part of the first
    before giving up."""

    first: float
    largest: float
    smallest: float


def start(corrector: Corrector, goal: Condition, watch: Watch) -> tuple[Metric, Point] | Result:
    """The metric of a walk and its first point: the present state, settled, with the tangent towards ``goal``.

    A reason if there is no equilibrium here, or none whose tangent is regular.
    """
    equilibrium = corrector.equilibrium
    here = at_parameter(equilibrium.parameter)
    settled = corrector.correct(equilibrium.values(), equilibrium.parameter, here, watch, thorough=True)
    if settled.reason is not None or settled.response is None:
        return settled.reason or Result.STEP_BELOW_MINIMUM
    response = settled.response
    size = math.sqrt(max(float(equilibrium.gradient(response) @ response), 0.0))
    if not math.isfinite(size):
        return Result.LINEAR_SOLVER_FAILED
    metric = Metric(equilibrium, min(max(WEIGHT * size, LIGHTEST), HEAVIEST))
    tangent = metric.unit(Direction(response, 1.0))
    values, parameter = equilibrium.values(), equilibrium.parameter
    rate = goal.value(tangent.values, tangent.parameter)
    if rate * goal.gap(values, parameter) > 0.0:
        tangent = tangent.scaled(-1.0)
    return metric, Point(values, parameter, 0.0, tangent, equilibrium.unstable_modes(), equilibrium.save())


def settled(corrector: Corrector, metric: Metric, here: Point, tangent: Direction, watch: Watch) -> list[Point]:
    """The point ``here`` of a walk on a structure that has become a little different and stands near it, found across
    the ``tangent`` that it had; none if there is no equilibrium nearby."""
    equilibrium = corrector.equilibrium
    values, parameter = equilibrium.values(), equilibrium.parameter
    along = metric.unit(tangent)
    plane = metric.plane(along, values, parameter)
    correction = corrector.correct(values, parameter, plane, watch, thorough=True)
    if correction.reason is not None or correction.response is None:
        return []
    tangent = metric.unit(Direction(correction.response, 1.0))
    if metric.inner(tangent, along) < 0.0:
        tangent = tangent.scaled(-1.0)
    values, parameter = equilibrium.values(), equilibrium.parameter
    return [Point(values, parameter, here.place, tangent, equilibrium.unstable_modes(), equilibrium.save())]


class Walk:
    """A walk from ``here`` until the scalar of ``goal`` takes its target for the first time.

    A step that fails is cut, except for the reason ``at_once``.
    """

    def __init__(
        self,
        corrector: Corrector,
        metric: Metric,
        here: Point,
        goal: Condition,
        stride: Stride,
        watch: Watch,
        cut: Callable[[float, Result], None],
    ) -> None:
        self.corrector, self.metric, self.here, self.goal, self.stride = corrector, metric, here, goal, stride
        self.before: Point | None = None
        self._older: Point | None = None
        self.done = False
        self.at_once: Result | None = None
        self._watch, self._told_cut = watch, cut
        rate = 1.0 if here.tangent is None else abs(here.tangent.parameter)
        self.length = self._first = min(stride.first / max(rate, LIGHTEST), FARTHEST)
        self._blind = False

    def advance(self) -> Result | None:
        """Take one step, with as many cuts as it needs; a reason if none was short enough."""
        while True:
            reason = self._attempt()
            if reason is None:
                return None
            if reason is self.at_once or not self.shorten(reason):
                return reason

    def shorten(self, reason: Result) -> bool:
        """Go back to ``here`` and halve the step; False if it would be too short."""
        self.corrector.equilibrium.restore(self.here.saved)
        self.length *= CUT
        if self.length < self.stride.smallest * self._first:
            return False
        self._told_cut(self.length / self._first, reason)
        return True

    def retract(self) -> None:
        """Give the last step up: it was an equilibrium, but not one to keep."""
        if self.before is None:
            raise ValueError("there is no step to give up")
        self.length = min(self.length, self.here.place - self.before.place)
        self.here, self.before, self.done = self.before, self._older, False

    def go_on_from(self, point: Point, length: float) -> None:
        """Leave the path: the last step ended at ``point``, on another one, to be left in steps of ``length``."""
        self.length = length
        self._older, self.before, self.here, self.done = None, None, point, False

    def memory(self) -> Memory:
        """What the walk goes on from, right after a step; the state of ``here`` is the equilibrium's."""
        return {
            "here": of_point(self.here),
            "before": None if self.before is None else of_point(self.before),
            "weight": self.metric.weight,
            "length": self.length,
            "first": self._first,
            "done": self.done,
            "blind": self._blind,
        }

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned, ``here`` and the metric being those of it."""
        before = memory["before"]
        self.before = None if before is None else point_of(before, None)  # gone back to in no case
        self.length, self._first = memory["length"], memory["first"]
        self.done, self._blind = memory["done"], memory["blind"]

    def _attempt(self) -> Result | None:
        curve = Curve(self.before, self.here)
        self._keep_close(curve)
        crossing = self._crossing(curve, (self.here.place, self.here.place + REACH * self.length))
        if crossing is not None and not self._blind:
            point = self._landed(curve.at(crossing))
            if isinstance(point, Point):
                self._accept(point)
                return None
            # What the prediction promised may not be there: behind a limit point, for one. Go on and see.
            self.corrector.equilibrium.restore(self.here.saved)
            self._blind = True
        guess = curve.at(self.here.place + self.length)
        chord = Direction(guess.values - self.here.values, guess.parameter - self.here.parameter)
        plane = self.metric.plane(self.metric.unit(chord), guess.values, guess.parameter)
        straight = curve.order == 2
        correction = self.corrector.correct(guess.values, guess.parameter, plane, self._watch, straight=straight)
        point = self._point(correction)
        if isinstance(point, Result):
            return point
        error = self.metric.length(Direction(point.values - guess.values, point.parameter - guess.parameter))
        if error > STRAYED * self.length:
            return Result.STEP_BELOW_MINIMUM
        passed = Curve(self.here, point)
        crossing = self._crossing(passed, (self.here.place, point.place))
        if crossing is not None:
            point = self._landed(passed.at(crossing))
            if isinstance(point, Result):
                return point
            self._accept(point)
            return None
        self._blind = False
        hard = sum(size > NEAR * self.length for size in correction.sizes) + 1
        growth = _growth(hard, error / self.length, curve.order)
        self._accept(point)
        self._lengthen(growth)
        return None

    def _keep_close(self, curve: Curve) -> None:
        """Shorten a step that is expected to change the parameter by too much."""
        for _ in range(MOST_CLOSER):
            ahead = curve.at(self.here.place + self.length).parameter - self.here.parameter
            if abs(ahead) <= self.stride.largest:
                return
            self.length *= CLOSER

    def _crossing(self, curve: Curve, ends: tuple[float, float]) -> float | None:
        """Where in ``ends`` the goal is met on ``curve``."""
        scalars = []
        for point in (curve.start, curve.stop):
            if point is None or point.tangent is None:
                scalars += [0.0, 0.0]
            else:
                scalars += [self.goal.gap(point.values, point.parameter), self._slope(point.tangent)]
        return curve.first_crossing(ends, (scalars[0], scalars[1], scalars[2], scalars[3]))

    def _slope(self, tangent: Direction) -> float:
        return self.goal.value(tangent.values, tangent.parameter)

    def _landed(self, guess: Direction) -> Point | Result:
        """The point of the goal next to ``guess``."""
        correction = self.corrector.correct(guess.values, guess.parameter, self.goal, self._watch, thorough=True)
        point = self._point(correction)
        self.done = isinstance(point, Point)
        return point

    def _point(self, correction: Correction) -> Point | Result:
        """The corrected state as the next point of the path; a reason if it is none."""
        if correction.reason is not None or correction.response is None:
            return correction.reason or Result.STEP_BELOW_MINIMUM
        equilibrium, here = self.corrector.equilibrium, self.here
        values, parameter = equilibrium.values(), equilibrium.parameter
        chord = Direction(values - here.values, parameter - here.parameter)
        length = self.metric.length(chord)
        tangent = self.metric.unit(Direction(correction.response, 1.0))
        ahead = self.metric.inner(tangent, chord)
        if ahead < 0.0:
            tangent, ahead = tangent.scaled(-1.0), -ahead
        turned = 1.0 if here.tangent is None else self.metric.inner(here.tangent, chord)
        if length == 0.0 or min(ahead, turned) < TURN * length or equilibrium.turned_over(here.values):
            return Result.STEP_BELOW_MINIMUM
        place = here.place + _arc(length, ahead / length, turned / length)
        return Point(values, parameter, place, tangent, equilibrium.unstable_modes(), equilibrium.save())

    def _accept(self, point: Point) -> None:
        self._older, self.before, self.here = self.before, self.here, point

    def _lengthen(self, growth: float) -> None:
        self.length = min(self.length * growth, LONGEST)
        rate = 0.0 if self.here.tangent is None else abs(self.here.tangent.parameter)
        if rate * self.length > self.stride.largest:
            self.length = self.stride.largest / rate


def _growth(iterations: int, error: float, order: int) -> float:
    """The next step as a multiple of the last one, whose prediction had a relative ``error``."""
    growth = math.pow(EASE, AIM - iterations)
    if error > 0.0:
        growth = min(growth, (MISSED / error) ** (1.0 / order))
    return min(max(growth, SLOWEST), FASTEST)


def _arc(chord: float, first: float, second: float) -> float:
    """Length of the arc over ``chord`` that leaves it at angles with the cosines ``first`` and ``second``."""
    half = 0.5 * (math.acos(min(first, 1.0)) + math.acos(min(second, 1.0)))
    return chord * half / math.sin(half) if half > 1e-6 else chord

