"""Clamped shallow spherical cap under pressure: axisymmetric snap-through by Marguerre's equations.

Radius R of the sphere, a of the rim, thickness T, Hooke's law; w points inwards, psi = r N_r, and the pressure p acts
inwards:

    D r [(r w')' / r]' = p r^2 / 2 + psi (w' + r / R),    r [(r psi)' / r]' = - E T (w'^2 / 2 + r w' / R),

clamped: w' = 0 and r psi' = nu psi on the rim (K. Marguerre, Proc. 5th Int. Congr. Appl. Mech. (1938) 93-101; B.
Budiansky, in The Theory of Thin Elastic Shells, North-Holland (1960) 64-94). Exact in the limit of a small rise
H = a^2 / 2R, with deflections of that size. With x = r/a, w' = g a/R, psi = f E T a^3 / R^2, P the pressure over the
classical one of the whole sphere, 2 E T^2 / (R^2 s), s^2 = 3 (1 - nu^2), and L y = x y'' + y' - y/x:

    L g = 2 lambda^2 P x^2 + lambda^4 f (g + x),    L f = - (g^2 / 2 + x g),    lambda^2 = 2 s a^2 / (R T) = 4 s H / T.

Solved by Chebyshev collocation at a given inward displacement of the apex, in rises - 2 int g dx.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev
from scipy.optimize import minimize_scalar

Array = npt.NDArray[np.float64]
LARGEST_STEP = 0.05  # of the apex between two solutions, in rises


class Turning(NamedTuple):
    """A limit point: displacement of the apex over the rise, and pressure over the classical one."""

    displacement: float
    pressure: float


@dataclass(frozen=True)
class ShallowCap:
    """A cap of the rise parameter lambda; `degree` is that of the polynomials."""

    rise_parameter: float
    poisson_ratio: float = 0.3
    degree: int = 30

    def pressure(self, displacement: float) -> float:
        """Pressure over the classical one at an inward displacement of the apex, in rises."""
        state = np.zeros(2 * self.degree + 3)
        steps = math.ceil(abs(displacement) / LARGEST_STEP)
        for target in np.linspace(0.0, displacement, steps + 1)[1:]:
            state = self._solve(state, float(target))
        return float(state[-1])

    def limit_points(self, largest_displacement: float = 2.0) -> tuple[Turning, ...]:
        """Extrema of the pressure while the apex moves inwards, first maximum first."""
        places = np.arange(0.0, largest_displacement + LARGEST_STEP, LARGEST_STEP)
        pressures, state = [0.0], np.zeros(2 * self.degree + 3)
        for place in places[1:]:
            state = self._solve(state, float(place))
            pressures.append(float(state[-1]))
        rising = np.diff(pressures) > 0.0
        found = []
        for i in np.flatnonzero(rising[1:] != rising[:-1]):
            sign = -1.0 if rising[i] else 1.0
            ends = (float(places[i]), float(places[i + 2]))
            best = minimize_scalar(lambda x, s=sign: s * self.pressure(float(x)), bounds=ends, method="bounded")
            found.append(Turning(float(best.x), sign * float(best.fun)))
        return tuple(found)

    @cached_property
    def _collocation(self) -> tuple[Array, Array, Array, Array]:
        """Nodes in [0, 1], first derivative and L at the nodes, weights of the integral."""
        n = self.degree
        nodes = 0.5 * (1.0 - np.cos(np.pi * np.arange(n + 1) / n))
        basis = np.eye(n + 1)
        values = chebyshev.chebvander(2.0 * nodes - 1.0, n)
        first = np.stack([2.0 * chebyshev.chebval(2.0 * nodes - 1.0, chebyshev.chebder(c)) for c in basis], axis=1)
        second = np.stack([4.0 * chebyshev.chebval(2.0 * nodes - 1.0, chebyshev.chebder(c, 2)) for c in basis], axis=1)
        integrals = np.array([0.5 * np.diff(chebyshev.chebval([-1.0, 1.0], chebyshev.chebint(c)))[0] for c in basis])
        inverse = np.linalg.inv(values)
        d1, d2 = first @ inverse, second @ inverse
        operator = nodes[:, None] * d2 + d1
        operator[1:] -= np.diag(1.0 / nodes[1:], k=1)[:-1]
        return nodes, d1, operator, integrals @ inverse

    def _solve(self, state: Array, displacement: float) -> Array:
        """Newton's method for g and f at the nodes and P; RuntimeError if it does not converge."""
        x, d1, operator, weights = self._collocation
        m, lam = self.degree + 1, self.rise_parameter
        matrix = np.zeros((2 * m + 1, 2 * m + 1))
        for _ in range(30):
            g, f, load = state[:m], state[m:-1], state[-1]
            residual = np.concatenate(
                [
                    operator @ g - 2.0 * lam**2 * load * x**2 - lam**4 * f * (g + x),
                    operator @ f + 0.5 * g**2 + x * g,
                    [-2.0 * weights @ g - displacement],
                ]
            )
            matrix[:m, :m], matrix[:m, m:-1] = operator - lam**4 * np.diag(f), -(lam**4) * np.diag(g + x)
            matrix[:m, -1], matrix[-1, :m] = -2.0 * lam**2 * x**2, -2.0 * weights
            matrix[m:-1, :m], matrix[m:-1, m:-1] = np.diag(g + x), operator
            for row, start in ((0, 0), (m, m)):  # nothing at the apex
                residual[row], matrix[row] = state[start], np.eye(2 * m + 1)[start]
            residual[m - 1], matrix[m - 1] = g[-1], np.eye(2 * m + 1)[m - 1]
            residual[-2], matrix[-2] = d1[-1] @ f - self.poisson_ratio * f[-1], 0.0
            matrix[-2, m:-1] = d1[-1]
            matrix[-2, -2] -= self.poisson_ratio
            step = np.linalg.solve(matrix, -residual)
            state = state + step
            if float(np.abs(step).max()) < 1e-8:
                return state
        raise RuntimeError(f"no solution at the displacement {displacement:.6g}")
