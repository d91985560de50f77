"""Two bars that meet in an apex which is pressed down: limit points, bifurcations and branches in closed form.

Half span 1, height 2, bars with the Green strain e = (l^2 - L^2) / (2 L^2) and energy k L e^2 / 2. With the apex at
height z and u to the side:

* symmetric path u = 0: force k z (h^2 - z^2) / L^3, limit points at z = +- h / sqrt(3);
* the side stiffness vanishes at z^2 = h^2 - 2: bifurcations, before the first limit point since h^2 > 3;
* the branch between them is the circle u^2 + z^2 = h^2 - 2.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding.coupling.linear import LinearSolverError
from embedding.solving.continuation import Array, Linearised

HEIGHT = 2.0
LENGTH = np.sqrt(1.0 + HEIGHT**2)
LIMIT, SIDEWAYS = HEIGHT / np.sqrt(3.0), np.sqrt(HEIGHT**2 - 2.0)


def force(z: float) -> float:
    """Force on the symmetric path at height ``z``, for k = 1."""
    return z * (HEIGHT**2 - z * z) / float(LENGTH) ** 3


class Truss:
    """The unknowns are u to the side and v downwards; the force is the parameter times ``full``."""

    def __init__(self, full: float = 1.0) -> None:
        self.full, self.t, self.x = full, 0.0, np.zeros(2)
        self.matrix = np.eye(2)

    @property
    def parameter(self) -> float:
        return self.t

    def values(self) -> Array:
        return self.x.copy()

    def move(self, values: Array, parameter: float, *, curved: bool = False) -> bool:
        self.x, self.t = values.copy(), parameter
        return True

    def linearise(self) -> Linearised:
        u, v = self.x
        z, size = HEIGHT - v, float(LENGTH)
        residual, self.matrix = np.zeros(2), np.zeros((2, 2))
        for side in (1.0, -1.0):
            strain = ((1.0 + side * u) ** 2 + z * z - size**2) / (2 * size**2)
            slope = np.array([side * (1.0 + side * u), -z]) / size**2
            residual += size * strain * slope
            self.matrix += size * (np.outer(slope, slope) + strain * np.eye(2) / size**2)
        load = np.array([0.0, -self.full])
        residual += self.t * load
        return Linearised(residual, load, -self.solve(residual), -self.solve(load))

    lagging = False

    def turned_over(self, values: Array) -> bool:
        return False

    def solve(self, right_side: Array) -> Array:
        try:
            return np.linalg.solve(self.matrix, right_side)
        except np.linalg.LinAlgError as error:
            raise LinearSolverError(str(error)) from error

    def gradient(self, direction: Array) -> Array:
        return direction.copy()

    def decrement(self, residual: Array, step: Array) -> float:
        return float(np.sqrt(abs(residual @ step)))

    def unstable_modes(self) -> int | None:
        return int((np.linalg.eigvalsh(self.matrix) < 0).sum())

    def save(self) -> Any:
        return self.x.copy(), self.t

    def restore(self, saved: Any) -> None:
        values, self.t = saved
        self.x = values.copy()
