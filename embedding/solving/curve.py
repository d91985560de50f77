"""Points on an equilibrium path and the cubic through two of them: where the next point is expected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from embedding.solving.continuation import Array, Direction

SAMPLES = 32
"""Places between two points at which a scalar on the path is looked at."""


@dataclass(frozen=True)
class Point:
    """A converged state: its distance ``place`` along the path from where the path began, its unit tangent if known,
    and the number of negative eigenvalues of its tangent matrix if they say something."""

    values: Array
    parameter: float
    place: float
    tangent: Direction | None
    unstable: int | None
    saved: Any

    def turns_with(self, other: Point) -> bool:
        """Does the parameter go the same way at both points?"""
        if self.tangent is None or other.tangent is None:
            return True
        return self.tangent.parameter * other.tangent.parameter > 0.0


def basis(start: float, stop: float, at: float) -> tuple[float, float, float, float]:
    """Hermite's cubics at ``at``: weights of the value and slope at ``start``, then at ``stop``."""
    length = stop - start
    r = (at - start) / length
    return (
        (1 + 2 * r) * (1 - r) ** 2,
        length * r * (1 - r) ** 2,
        r * r * (3 - 2 * r),
        length * r * r * (r - 1),
    )


@dataclass(frozen=True)
class Curve:
    """The path near ``stop``: the cubic through two points and their tangents, or the tangent at ``stop`` alone.

    Evaluated between the points it interpolates, beyond them it predicts: with an error of fourth order in the length
    of the step, where the tangent alone is of second. A shell that turns without stretching needs that: a guess that
    stretches it is far off in energy.
    """

    start: Point | None
    stop: Point

    @property
    def order(self) -> int:
        """Order of the error of a prediction in the length of the step."""
        return 4 if self._cubic else 2

    @property
    def _cubic(self) -> bool:
        return self.start is not None and self.start.tangent is not None and self.start.place < self.stop.place

    def at(self, place: float) -> Direction:
        """Unknowns and parameter at ``place``."""
        tangent = self.stop.tangent
        if tangent is None:
            raise ValueError("no tangent at the end of the curve")
        start, stop = self.start, self.stop
        if self._cubic and start is not None and start.tangent is not None:
            a, b, c, d = basis(start.place, stop.place, place)
            first = start.tangent
            return Direction(
                a * start.values + b * first.values + c * stop.values + d * tangent.values,
                a * start.parameter + b * first.parameter + c * stop.parameter + d * tangent.parameter,
            )
        ahead = place - self.stop.place
        return Direction(
            self.stop.values + ahead * tangent.values, self.stop.parameter + ahead * tangent.parameter
        )

    def first_crossing(self, ends: tuple[float, float], values: tuple[float, float, float, float]) -> float | None:
        """The first place in ``ends`` where a scalar with ``values`` (value and slope at start, at stop) is zero.

        On a curve of the tangent alone the values at ``start`` are not looked at.
        """
        places = np.linspace(*ends, SAMPLES + 1)
        found = np.array([self._scalar(p, values) for p in places])
        changes = np.flatnonzero(np.sign(found[:-1]) * np.sign(found[1:]) <= 0)
        if not len(changes):
            return None
        low, high = float(places[changes[0]]), float(places[changes[0] + 1])
        sign = np.sign(self._scalar(low, values))
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if np.sign(self._scalar(middle, values)) == sign else (low, middle)
        return high

    def _scalar(self, place: float, values: tuple[float, float, float, float]) -> float:
        if self._cubic and self.start is not None:
            weights = basis(self.start.place, self.stop.place, place)
            return float(np.dot(weights, values))
        return values[2] + (place - self.stop.place) * values[3]
