"""Virtual work of pressures on the true faces of an axisymmetric shell, by numpy on Chebyshev points.

The shell's mid-surface is a meridian curve r(s) with reference R(s); its faces are x = r +- (T/2) lambda n. The work of
a face pressure p on the virtual motion dx of its face is p n da . dx, with dx = d/de x(r + e v): nothing of the shell
theory's load is used.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.forms import Array

Curve = Callable[[Array, Array], tuple[Array, Array]]
Pressure = Callable[[Array, Array], Array]
POINTS = 80


def _chebyshev(length: float) -> tuple[Array, Array, Array]:
    """Points on [0, length], the derivative's matrix, and the weights that integrate the interpolant exactly."""
    angles = np.pi * np.arange(POINTS) / (POINTS - 1)
    x = 0.5 * length * (1 - np.cos(angles))
    ends = np.where((np.arange(POINTS) % (POINTS - 1)) == 0, 2.0, 1.0) * (-1.0) ** np.arange(POINTS)
    difference = x[:, None] - x[None, :] + np.eye(POINTS)
    derivative = np.outer(ends, 1 / ends) / difference
    derivative -= np.diag(derivative.sum(axis=1))
    nodes, gauss = np.polynomial.legendre.leggauss(POINTS)
    powers = np.polynomial.chebyshev.chebvander(2 * x / length - 1, POINTS - 1)
    moments = 0.5 * length * gauss @ np.polynomial.chebyshev.chebvander(nodes, POINTS - 1)
    weights: Array = np.asarray(np.linalg.solve(powers.T, moments), dtype=np.float64)
    return x, derivative, weights


@dataclass(frozen=True)
class Meridian:
    """A reference meridian: ``sphere`` from pole to pole, or the radius of the unit disc."""

    sphere: bool

    def reference(self, s: Array) -> tuple[Array, Array]:
        """Distance from the axis and height."""
        return (np.sin(s), np.cos(s)) if self.sphere else (s, 0 * s)

    def virtual_work(self, thickness: float, motion: Curve, virtual: Curve, top: Pressure, bottom: Pressure) -> float:
        """Internal minus external virtual work of the pressures on both faces, for given displacements."""
        s, d, weights = _chebyshev(np.pi if self.sphere else 1.0)
        r, z = self.reference(s)
        moved, varied = motion(r, z), virtual(r, z)

        def face(offset: float, e: float) -> tuple[Array, Array, Array]:
            a, b = r + moved[0] + e * varied[0], z + moved[1] + e * varied[1]
            slopes = np.array([-(d @ b), d @ a])  # towards the top: outwards on the sphere, +z on the disc
            length = np.hypot(*slopes)
            near_axis = r < 1e-9
            hoop = np.where(near_axis, length, a / np.where(near_axis, 1.0, r))
            director = slopes / (length * length * hoop)
            x, y = a + offset * thickness * director[0], b + offset * thickness * director[1]
            return x, y, 2 * np.pi * x * np.array([-(d @ y), d @ x])

        total, step = 0.0, 1e-5
        for offset, pressure, sign in ((0.5, top, 1.0), (-0.5, bottom, -1.0)):
            ahead, behind, here = face(offset, step), face(offset, -step), face(offset, 0.0)
            work = sum(here[2][i] * (ahead[i] - behind[i]) / (2 * step) for i in range(2))
            total += sign * float(weights @ (pressure(r, z) * work))
        return total
