"""Equilibrium paths: what a path follower asks of a structure, and the corrector that brings a guess onto the path.

A path is a curve of equilibria (x(s), t(s)): the unknowns x and a parameter t that the loads depend on. One more
condition, linear in x and t, picks a point on it: a value of t (load control), of a displacement, or of the distance
along the last tangent (arc length). Newton's method on equilibrium and condition together needs one factorisation and
two right sides a step, for any condition: Riks, Int. J. Solids Struct. 15 (1979) 529; Keller, in: Applications of
Bifurcation Theory (1977) 359. Theory page, "Following a path".
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from embedding.coupling.linear import LinearSolverError
from embedding.solving.result import Result

Array = npt.NDArray[np.float64]
Watch = Callable[[int, float, float], None]
"""Told of every iteration: its number, the size of its update and its decrement."""

LARGEST_UPDATE = 0.5
"""No update of one iteration may be larger, in sizes of the structure: Newton's method is lost then."""
CONTRACTING = 0.2
"""An update smaller than this times the last one is trusted to be followed by one that is smaller still."""
STALLED, PATIENCE = 0.7, 3
"""Newton is given up when the best of the last ``PATIENCE`` updates is above ``STALLED`` times the best before."""
FLOOR = 1e3
"""How far above the tolerance, at most, an update that rounding keeps from shrinking may stay."""


@dataclass(frozen=True)
class Linearised:
    """Newton's method at one state: residual r(x, t), its derivative ``load`` in t, and with K = dr/dx the ``update``
    -K^-1 r at fixed t and the ``response`` dx/dt of the unknowns, prescribed ones included."""

    residual: Array
    load: Array
    update: Array
    response: Array


class Equilibrium(Protocol):
    """A structure with unknowns (n,) and one parameter, standing at one state; all numbers are dimensionless."""

    @property
    def parameter(self) -> float:
        """The present value of the parameter t."""

    def values(self) -> Array:
        """A copy of the present unknowns x."""

    def move(self, values: Array, parameter: float, *, curved: bool = False) -> bool:
        """Go to another state, by a solution of linearised equations or else (``curved``) by a guess of another kind;
        False (and nothing moved) if it cannot be taken."""

    def linearise(self) -> Linearised:
        """Factor the tangent of the present state. Raises LinearSolverError."""

    @property
    def lagging(self) -> bool:
        """Had the tangent of the last :meth:`linearise` the stress of an earlier state? Then it says nothing of this
        one."""

    def solve(self, right_side: Array) -> Array:
        """K^-1 times ``right_side`` with the tangent of the last :meth:`linearise`. Raises LinearSolverError."""

    def gradient(self, direction: Array) -> Array:
        """M times ``direction``: x . M x is the mean square of the displacement, in sizes of the structure."""

    def turned_over(self, values: Array) -> bool:
        """Has all of the structure turned over since it had these ``values``? No path does that in one step."""

    def decrement(self, residual: Array, step: Array) -> float:
        """Energy norm of a Newton step."""

    def unstable_modes(self) -> int | None:
        """Negative eigenvalues of the tangent of the last :meth:`linearise`; None where that says nothing."""

    def save(self) -> Any:
        """A copy of the whole state."""

    def restore(self, saved: Any) -> None:
        """Go back to a state returned by :meth:`save`."""


@dataclass(frozen=True)
class Direction:
    """A change of unknowns and parameter."""

    values: Array
    parameter: float

    def scaled(self, factor: float) -> Direction:
        """``factor`` times the change."""
        return Direction(factor * self.values, factor * self.parameter)


@dataclass(frozen=True)
class Metric:
    """Lengths on a path: mean square displacement plus (``weight`` times the change of the parameter) squared.

    The weight only matters where nothing moves, and has the size of the response at the start, so that lengths do not
    depend on the units or on how large the loads of the parameter are.
    """

    equilibrium: Equilibrium
    weight: float

    def inner(self, a: Direction, b: Direction) -> float:
        """The inner product of two changes."""
        moved = float(self.equilibrium.gradient(a.values) @ b.values)
        return moved + self.weight**2 * a.parameter * b.parameter

    def length(self, a: Direction) -> float:
        """The length of a change."""
        return math.sqrt(max(self.inner(a, a), 0.0))

    def unit(self, a: Direction) -> Direction:
        """The change scaled to length 1; a change of no length is returned as it is."""
        length = self.length(a)
        return a.scaled(1.0 / length) if length > 0.0 else a

    def plane(self, normal: Direction, values: Array, parameter: float) -> Condition:
        """The plane across ``normal`` through a point."""
        row = self.equilibrium.gradient(normal.values)
        weight = self.weight**2 * normal.parameter
        return Condition(row, weight, float(row @ values) + weight * parameter)


@dataclass(frozen=True)
class Condition:
    """row . x + weight t = target; a row of None counts as zeros."""

    row: Array | None
    weight: float
    target: float

    def value(self, values: Array, parameter: float) -> float:
        """The left side."""
        return (0.0 if self.row is None else float(self.row @ values)) + self.weight * parameter

    def gap(self, values: Array, parameter: float) -> float:
        """Left side minus right side."""
        return self.value(values, parameter) - self.target


def at_parameter(target: float) -> Condition:
    """The condition of load control."""
    return Condition(None, 1.0, target)


@dataclass(frozen=True)
class Correction:
    """How a correction ended: sizes of its updates, the last response dx/dt; ``reason`` is None when it converged."""

    sizes: tuple[float, ...]
    response: Array | None
    reason: Result | None

    @property
    def contraction(self) -> float:
        """The first ratio of updates that says how good the guess was; 0 if the guess was already there."""
        return self.sizes[1] / self.sizes[0] if len(self.sizes) > 1 and self.sizes[0] > 0.0 else 0.0


class Corrector:
    """Newton's method on equilibrium and one condition, to a ``tolerance`` of update and decrement."""

    def __init__(self, equilibrium: Equilibrium, tolerance: float, max_iterations: int) -> None:
        self.equilibrium, self.tolerance, self.max_iterations = equilibrium, tolerance, max_iterations

    def correct(
        self,
        values: Array,
        parameter: float,
        condition: Condition,
        watch: Watch,
        *,
        thorough: bool = False,
        straight: bool = False,
    ) -> Correction:
        """Iterate from a guess; the state is only good afterwards if the outcome has no reason.

        The guess is ``straight`` if it lies on the tangent at the state of the last linearisation.
        The error left by an update is estimated by the update and its ratio to the one before; when ``thorough`` the
        update itself must be below the tolerance. An update that rounding keeps from shrinking ends the iteration, too.
        """
        equilibrium = self.equilibrium
        sizes: list[float] = []
        response: Array | None = None
        if not equilibrium.move(values, parameter, curved=not straight):
            return Correction((), None, Result.INVERTED_AMBIENT)
        for number in range(1, self.max_iterations + 1):
            try:
                linear = equilibrium.linearise()
            except LinearSolverError:
                return Correction(tuple(sizes), response, Result.LINEAR_SOLVER_FAILED)
            response = linear.response
            step = self._bordered(linear, condition)
            if step is None:
                return Correction(tuple(sizes), response, Result.LINEAR_SOLVER_FAILED)
            size = math.sqrt(max(float(equilibrium.gradient(step.values) @ step.values), 0.0))
            decrement = equilibrium.decrement(linear.residual, step.values)
            if not math.isfinite(size + decrement) or size > LARGEST_UPDATE:
                return Correction((*sizes, size), response, Result.STEP_BELOW_MINIMUM)
            if not equilibrium.move(equilibrium.values() + step.values, equilibrium.parameter + step.parameter):
                return Correction((*sizes, size), response, Result.INVERTED_AMBIENT)
            sizes.append(size)
            watch(number, size, decrement)
            if not equilibrium.lagging and self._converged(sizes, decrement, thorough):
                return Correction(tuple(sizes), response, None)
            if _stalled(sizes):
                break
        return Correction(tuple(sizes), response, Result.STEP_BELOW_MINIMUM)

    def _bordered(self, linear: Linearised, condition: Condition) -> Direction | None:
        """The step that solves the linearised equilibrium and the condition; None if it is not determined."""
        gap = condition.gap(self.equilibrium.values(), self.equilibrium.parameter)
        ahead, slope = 0.0, condition.weight
        if condition.row is not None:
            ahead = float(condition.row @ linear.update)
            slope += float(condition.row @ linear.response)
        if slope == 0.0:
            return None
        change = -(gap + ahead) / slope
        return Direction(linear.update + change * linear.response, change)

    def _converged(self, sizes: list[float], decrement: float, thorough: bool) -> bool:
        worst = max(sizes[-1], decrement)
        if worst < self.tolerance:
            return True
        if len(sizes) < 2:
            return False
        ratio = sizes[-1] / sizes[-2] if sizes[-2] > 0.0 else 0.0
        if not thorough and ratio < CONTRACTING and ratio * worst < self.tolerance:
            return True
        return len(sizes) > 2 and ratio > STALLED and worst < FLOOR * self.tolerance


def _stalled(sizes: list[float]) -> bool:
    """Have the last updates brought next to nothing over those before? Never asked of the first two."""
    if len(sizes) < PATIENCE + 2:
        return False
    return min(sizes[-PATIENCE:]) > STALLED * min(sizes[:-PATIENCE])
