"""Limit and bifurcation points between two states of a path: where the tangent matrix is singular.

At a limit point the parameter turns, and the path's own tangent is the critical mode. Where an eigenvalue passes
through zero and the parameter goes on, another branch crosses: a bifurcation. Both are roots of a scalar on the path -
the rate of the parameter, the smallest eigenvalue - bracketed by the two states and found by solving for states between
them. Theory page, "Critical points".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from embedding.coupling.linear import LinearSolverError
from embedding.errors import EmbeddingError
from embedding.solving.continuation import Array, Corrector, Direction, Equilibrium, Metric, Watch
from embedding.solving.curve import Curve, Point

Kind = Literal["limit", "bifurcation"]

BESIDE = (0.02, 5e-4)
"""How far beside where it is expected a critical point is looked for, in parts of the step: first, then closer."""
CLOSE = 3.0
"""A bracket of this many times the closer distance is small enough."""
BLURRED = 0.06
"""Beside a bifurcation two branches may be too near to be told apart, or joined to one by errors of the mesh. A state
of the path that is lost there ends the search if the bracket is this part of the step; if it is wider, its middle is
tried first."""
ASIDE = 0.02
"""A state found this far from where it was expected, in parts of the bracket, lies on another branch."""
MOST_ROUNDS = 8
SUBSPACE, ROUNDS, SETTLED = 3, 12, 1e-4
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


class LostError(EmbeddingError):
    """A state between two others could not be solved for."""


class Search:
    """Looks between two neighbouring points of a path for critical ones."""

    def __init__(self, corrector: Corrector, metric: Metric, watch: Watch) -> None:
        self._corrector, self._metric, self._watch = corrector, metric, watch

    def between(self, low: Point, high: Point) -> list[Critical] | None:
        """The critical points of the step from ``low`` to ``high`` in their order; None if the step is too long to
        find them.

        The equilibrium is left anywhere; restore it.
        """
        try:
            return list(self._found(low, high))
        except LostError:
            return None

    def _found(self, low: Point, high: Point) -> Iterator[Critical]:
        before, after = low, high
        limit = self._limit(low, high)
        if limit is not None:
            before, after, critical = limit
            yield from self._bifurcations(low, before)
            yield critical
            low = after
        yield from self._bifurcations(low, high)

    def _probe(self, low: Point, high: Point, place: float) -> Point:
        """The state of the path at ``place`` between two points. Raises LostError."""
        guess = Curve(low, high).at(place)
        chord = Direction(high.values - low.values, high.parameter - low.parameter)
        plane = self._metric.plane(self._metric.unit(chord), guess.values, guess.parameter)
        correction = self._corrector.correct(guess.values, guess.parameter, plane, self._watch, thorough=True)
        if correction.reason is not None or correction.response is None:
            raise LostError(f"no equilibrium at {place}")
        tangent = self._metric.unit(Direction(correction.response, 1.0))
        if self._metric.inner(tangent, chord) < 0.0:
            tangent = tangent.scaled(-1.0)
        equilibrium = self._corrector.equilibrium
        values, parameter = equilibrium.values(), equilibrium.parameter
        missed = Direction(values - guess.values, parameter - guess.parameter)
        if self._metric.length(missed) > ASIDE * (high.place - low.place):
            raise LostError(f"another branch at {place}")
        return Point(values, parameter, place, tangent, equilibrium.unstable_modes(), equilibrium.save())

    def _probe_if_any(self, low: Point, high: Point, place: float) -> Point | None:
        try:
            return self._probe(low, high, place)
        except LostError:
            return None

    def _limit(self, low: Point, high: Point) -> tuple[Point, Point, Critical] | None:
        """Where the rate of the parameter changes its sign, with the points beside it."""
        if _rate(low) * _rate(high) >= 0.0:
            return None

        def aside(probe: Point) -> bool:
            return _rate(probe) * _rate(low) > 0.0

        def turning(first: Point, last: Point) -> float:
            return _turning(first, last) if first is low and last is high else _balance(first, last)

        before, after = self._closing_in(low, high, turning, aside)
        point = self._interpolated(before, after, _balance(before, after))
        mode = self._normalised(after.values - before.values)
        return before, after, Critical("limit", point.parameter, mode, (before.unstable, after.unstable), point)

    def _bifurcations(self, low: Point, high: Point) -> Iterator[Critical]:
        """Where eigenvalues change their sign, one after the other."""
        while low.unstable is not None and high.unstable is not None and low.unstable != high.unstable:
            critical, low = self._first_change(low, high)
            yield critical

    def _first_change(self, low: Point, high: Point) -> tuple[Critical, Point]:
        """The first place where the number of unstable modes changes, and a state behind it.

        That is the last one seen with as many: close to the point the other branch is felt.
        """
        count, values, modes = low.unstable, dict[float, float](), list[Array]()
        seen = [high]

        def aside(probe: Point) -> bool:
            seen.append(probe)
            try:
                values[probe.place], vectors = nearest_mode(self._corrector.equilibrium, modes[-1] if modes else None)
                modes.append(vectors)
            except LinearSolverError:  # so close to the singular matrix that nothing can be solved with it
                values[probe.place] = 0.0
            return probe.unstable == count

        def root(first: Point, last: Point) -> float:
            return _secant(values, first.place, last.place)

        before, after = self._closing_in(low, high, root, aside, blurred=True)
        if not modes:
            raise LostError("no mode")
        point = self._interpolated(before, after, root(before, after))
        mode = self._normalised(modes[-1][:, 0])
        unstable = (before.unstable, after.unstable)
        last = max((probe for probe in seen if probe.unstable == after.unstable), key=lambda probe: probe.place)
        return Critical("bifurcation", point.parameter, mode, unstable, point), last

    def _closing_in(
        self,
        low: Point,
        high: Point,
        expected: Callable[[Point, Point], float],
        aside: Callable[[Point], bool],
        *,
        blurred: bool = False,
    ) -> tuple[Point, Point]:
        """Two solved states close to either side of what is expected at a place that depends on such a pair.

        ``aside`` says whether a state is still on the side of ``low``. The critical state itself is not solved for:
        there the matrix is singular, and between states so close the cubic is as exact as they are. If it is
        ``blurred``, a wider bracket is taken where states between are lost; else LostError is raised.
        """
        whole = high.place - low.place
        for number in range(MOST_ROUNDS):
            place = expected(low, high)
            away = whole * BESIDE[min(number, 1)]
            for at in (place - away, place + away):
                if not low.place < at < high.place:
                    continue
                probe = self._probe_if_any(low, high, at) if blurred else self._probe(low, high, at)
                if probe is None and high.place - low.place > BLURRED * whole:
                    probe = self._probe_if_any(low, high, 0.5 * (low.place + high.place))
                if probe is None:
                    return low, high
                low, high = (probe, high) if aside(probe) else (low, probe)
            if high.place - low.place <= CLOSE * whole * BESIDE[1]:
                return low, high
        raise LostError("no bracket")

    def _interpolated(self, low: Point, high: Point, place: float) -> Point:
        """The state at ``place`` between two close ones."""
        at, equilibrium = Curve(low, high).at(place), self._corrector.equilibrium
        equilibrium.restore(low.saved)
        equilibrium.move(at.values, at.parameter, curved=True)
        return Point(at.values, at.parameter, place, high.tangent, None, equilibrium.save())

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
    sizes, axes = np.linalg.eigh((mass + mass.T) / 2)
    kept = sizes > 1e-12 * sizes.max()
    basis = axes[:, kept] / np.sqrt(sizes[kept])
    values, vectors = np.linalg.eigh(basis.T @ ((stiffness + stiffness.T) / 2) @ basis)
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


def _balance(low: Point, high: Point) -> float:
    """Where the line through the rates at two points is zero; they have different signs."""
    return low.place + (high.place - low.place) * _rate(low) / (_rate(low) - _rate(high))


def _secant(values: dict[float, float], low: float, high: float) -> float:
    """The root of the line through the values at the two places next to the bracket's middle, if it lies within the
    bracket; else the middle."""
    middle = 0.5 * (low + high)
    nearest = sorted(values, key=lambda place: abs(place - middle))[:2]
    if len(nearest) == 2:
        a, b = nearest
        if values[a] != values[b]:
            root = b - values[b] * (b - a) / (values[b] - values[a])
            if low < root < high:
                return root
    return middle
