"""Limit and bifurcation points between two states of a path: where the tangent matrix is singular.

At a limit point the parameter turns, and the path's own tangent is the critical mode. Where an eigenvalue passes
through zero and the parameter goes on, another branch crosses: a bifurcation. Both are roots of a scalar on the path -
the rate of the parameter, the smallest eigenvalue - bracketed by the two states and found by solving for states between
them. Theory page, "Critical points".
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import scipy.linalg

from embedding.coupling.linear import LinearSolverError
from embedding.solving.continuation import Array, Corrector, Direction, Equilibrium, Metric, Watch
from embedding.solving.curve import Curve, Point

Kind = Literal["limit", "bifurcation"]

PLACE = 1e-6
"""How closely a place is found, relative to the step it lies in."""
NEARBY = 1e-7
"""And in sizes of the structure."""
MOST_PROBES = 30
PATIENT = 10
"""How many states between two others are solved for at most, and from which on the bracket is simply halved."""
BESIDE = 1e-3
"""How far from a limit point, in parts of the step, its two sides are looked at."""
SUBSPACE, ROUNDS, SETTLED = 4, 12, 1e-4
"""Vectors and rounds of the subspace iteration, and the relative change of the eigenvalue that ends it."""


@dataclass(frozen=True)
class Critical:
    """A singular state: parameter, the critical mode (n,) of mean square displacement 1, unstable modes before and
    after, the path's tangent there, and the saved state."""

    kind: Kind
    parameter: float
    mode: Array
    unstable: tuple[int | None, int | None]
    point: Point


class Search:
    """Looks between two neighbouring points of a path for critical ones."""

    def __init__(self, corrector: Corrector, metric: Metric, watch: Watch) -> None:
        self._corrector, self._metric, self._watch = corrector, metric, watch

    def between(self, low: Point, high: Point) -> list[Critical]:
        """The critical points of the step from ``low`` to ``high`` that can be located, in their order.

        The equilibrium is left anywhere; restore it.
        """
        try:
            return list(self._found(low, high))
        except LinearSolverError:
            return []

    def _found(self, low: Point, high: Point) -> Iterator[Critical]:
        limit = self._limit(low, high)
        if limit is None:
            yield from self._bifurcations(low, high)
            return
        change = (high.unstable or 0) - (low.unstable or 0)
        if low.unstable is None or high.unstable is None or abs(change) == 1:
            yield Critical(limit.kind, limit.parameter, limit.mode, (low.unstable, high.unstable), limit.point)
            return
        away = BESIDE * (high.place - low.place)
        sides = [self._probe(low, high, limit.point.place + shift) for shift in (-away, away)]
        if sides[0] is not None:
            yield from self._bifurcations(low, sides[0])
        unstable = tuple(side.unstable if side is not None else None for side in sides)
        yield Critical(limit.kind, limit.parameter, limit.mode, (unstable[0], unstable[1]), limit.point)
        if sides[1] is not None:
            yield from self._bifurcations(sides[1], high)

    def _probe(self, low: Point, high: Point, place: float) -> Point | None:
        """The state of the path at ``place`` between two points; None if it cannot be solved for."""
        guess = Curve(low, high).at(place)
        chord = Direction(high.values - low.values, high.parameter - low.parameter)
        plane = self._metric.plane(self._metric.unit(chord), guess.values, guess.parameter)
        correction = self._corrector.correct(guess.values, guess.parameter, plane, self._watch, thorough=True)
        if correction.reason is not None or correction.response is None:
            return None
        tangent = self._metric.unit(Direction(correction.response, 1.0))
        if self._metric.inner(tangent, chord) < 0.0:
            tangent = tangent.scaled(-1.0)
        equilibrium = self._corrector.equilibrium
        values, parameter = equilibrium.values(), equilibrium.parameter
        return Point(values, parameter, place, tangent, equilibrium.unstable_modes(), equilibrium.save())

    def _limit(self, low: Point, high: Point) -> Critical | None:
        """Where the rate of the parameter changes its sign: the root of the cubic's slope, again and again."""
        if _rate(low) * _rate(high) >= 0.0:
            return None
        close = min(PLACE * (high.place - low.place), NEARBY)
        last = math.inf
        best: Point | None = None
        for _ in range(MOST_PROBES):
            probe = self._probe(low, high, _turning(low, high))
            if probe is None:
                break
            best = probe
            if abs(probe.place - last) < close or _rate(probe) == 0.0:
                break
            last = probe.place
            low, high = (probe, high) if _rate(probe) * _rate(low) > 0.0 else (low, probe)
        if best is None or best.tangent is None:
            return None
        return Critical("limit", best.parameter, self._normalised(best.tangent.values), (None, None), best)

    def _bifurcations(self, low: Point, high: Point) -> Iterator[Critical]:
        """Where eigenvalues change their sign, one after the other."""
        while low.unstable is not None and high.unstable is not None and low.unstable != high.unstable:
            found = self._first_change(low, high)
            if found is None:
                return
            critical, low = found
            yield critical

    def _first_change(self, low: Point, high: Point) -> tuple[Critical, Point] | None:
        """The first place where the number of unstable modes changes, and the next state known behind it."""
        count, close = low.unstable, min(PLACE * (high.place - low.place), NEARBY)
        tried: list[tuple[float, float]] = []
        place, mode, probe = 0.5 * (low.place + high.place), None, None
        for _ in range(MOST_PROBES):
            probe = self._probe(low, high, place)
            if probe is None:
                return None
            value, mode = nearest_mode(self._corrector.equilibrium, mode)
            low, high = (probe, high) if probe.unstable == count else (low, probe)
            tried.append((place, value))
            place = _secant(tried[-2:] if len(tried) < PATIENT else [], low.place, high.place)
            if abs(place - tried[-1][0]) < close:
                break
        if probe is None or mode is None:
            return None
        unstable = (count, high.unstable)
        return Critical("bifurcation", probe.parameter, self._normalised(mode[:, 0]), unstable, probe), high

    def _normalised(self, mode: Array) -> Array:
        size = float(self._metric.equilibrium.gradient(mode) @ mode)
        largest = mode[np.argmax(np.abs(mode))]
        return mode * np.sign(largest) / math.sqrt(size) if size > 0.0 else mode


def nearest_mode(equilibrium: Equilibrium, start: Array | None = None) -> tuple[float, Array]:
    """The eigenvalue next to zero of K x = value M x at the last linearisation, and vectors (n, k), its mode first.

    By subspace iteration with the factors at hand; ``start`` holds vectors from a state near by.
    """
    count = len(equilibrium.values())
    space = np.random.default_rng(0).standard_normal((count, SUBSPACE)) if start is None else start
    value = math.inf
    for _ in range(ROUNDS):
        images = np.column_stack([equilibrium.solve(equilibrium.gradient(column)) for column in space.T])
        weighted = np.column_stack([equilibrium.gradient(column) for column in images.T])
        # With Y = K^-1 M X: Y'KY = Y'MX on the left, Y'MY on the right.
        stiffness, mass = weighted.T @ space, weighted.T @ images
        values, vectors = _pencil(stiffness, mass)
        order = np.argsort(np.abs(values))
        space = images @ vectors[:, order]
        last, value = value, float(values[order[0]])
        if abs(value - last) <= SETTLED * abs(value):
            break
    return value, space


def _pencil(stiffness: Array, mass: Array) -> tuple[Any, Any]:
    """Eigenvalues and vectors of a small symmetric pencil whose mass matrix may be nearly singular."""
    sizes, axes = scipy.linalg.eigh((mass + mass.T) / 2)
    kept = sizes > 1e-12 * sizes.max()
    basis = axes[:, kept] / np.sqrt(sizes[kept])
    values, vectors = scipy.linalg.eigh(basis.T @ ((stiffness + stiffness.T) / 2) @ basis)
    return values, basis @ vectors


def _rate(point: Point) -> float:
    return 0.0 if point.tangent is None else point.tangent.parameter


def _turning(low: Point, high: Point) -> float:
    """Where the cubic of the parameter between two points turns; their rates have different signs."""
    length = high.place - low.place
    mean, first, last = (high.parameter - low.parameter) / length, _rate(low), _rate(high)
    roots = np.roots([3 * (first + last) - 6 * mean, 6 * mean - 4 * first - 2 * last, first])
    inside = [float(r.real) for r in np.atleast_1d(roots) if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0]
    return low.place + length * (inside[0] if inside else first / (first - last))


def _secant(tried: list[tuple[float, float]], low: float, high: float) -> float:
    """The root of the line through the last two values, if it lies within the bracket; else its middle."""
    if len(tried) == 2:
        (a, at_a), (b, at_b) = tried
        if at_a != at_b:
            root = b - at_b * (b - a) / (at_b - at_a)
            if low <= root <= high:
                return root
    return 0.5 * (low + high)
