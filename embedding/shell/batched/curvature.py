"""The curvature of the deformed surface as its moments see it, at points, with two derivatives.

With x_a the tangents of the deformed surface in the coordinates of the reference triangle and A = x_1 x x_2, moments
m^ab pair with x_ab . f(A), f(A) = A / |A|^2. With y = m^ab x_ab the derivatives in the tangents are

    d(y . f) = v . dA,                            v = (y - 2 (y . f) A) / |A|^2
    d2(y . f) = dA . H dA + v . d2A,              H = -2 (v f^T + f v^T + (y . f) I / |A|^2)

with dA = dx_1 x x_2 + x_1 x dx_2.
"""

from __future__ import annotations

import numpy as np

from embedding.shell.batched.algebra import IDENTITY, TWICE, both, cross, determinant_slope, dot, metric, outer, turning
from embedding.shell.batched.polynomials import Array


class Curved:
    """What both derivatives need at the points: ``slope`` (2, 3, p, e), ``hessian`` (3, 3, p, e), ``m`` (3, p, e)."""

    def __init__(self, slope: Array, hessian: Array, m: Array) -> None:
        self.first, self.second, self.hessian, self.m = slope[0], slope[1], hessian, m
        self.C = metric(self.first, self.second)
        self.area = cross(self.first, self.second)
        self.square = dot(self.area, self.area)
        self.director = self.area / self.square
        self.weighted = TWICE * m
        self.y = np.einsum("vpe,vape->ape", self.weighted, hessian)
        self.lever = dot(self.y, self.director)
        self.v = self.reflected(self.y)

    def reflected(self, y: Array) -> Array:
        """The derivative v of y . f in A."""
        return np.asarray((y - 2 * dot(y, self.director) * self.area) / self.square)

    def by_places(self, v: Array) -> Array:
        """The six components of v . dA in dx_1 and dx_2."""
        return np.concatenate([cross(self.second, v), cross(v, self.first)])

    @property
    def turned(self) -> Array:
        """Derivative (6, p, e) of y . f."""
        return self.by_places(self.v)

    @property
    def director_slope(self) -> Array:
        """Derivative (3, 6, p, e) of f."""
        by_A = np.concatenate([-turning(self.second), turning(self.first)], axis=1)
        return (by_A - 2 * outer(self.area, self.by_places(self.director))) / self.square

    def turned_twice(self) -> Array:
        """Second derivative (6, 6, p, e) of y . f."""
        out = both(self.turned, self.square * self.by_places(self.director))
        slope = determinant_slope(self.C)  # dA . dA by Lagrange's identity
        out[:3, :3] += self.lever * (slope[0] * IDENTITY - outer(self.second, self.second))
        out[3:, 3:] += self.lever * (slope[2] * IDENTITY - outer(self.first, self.first))
        across = self.lever * (outer(self.first, self.second) + 0.5 * slope[1] * IDENTITY)
        out[:3, 3:] += across
        out[3:, :3] += np.swapaxes(across, 0, 1)
        out *= -2 / self.square
        tangent = turning(self.v)
        out[:3, 3:] -= tangent
        out[3:, :3] += tangent
        return out


def stretching(stress: Array, first: Array, second: Array) -> Array:
    """stress : dC, its six components in dx_1 and dx_2."""
    return np.concatenate([2 * stress[0] * first + stress[1] * second, stress[1] * first + 2 * stress[2] * second])


def second_stretching(stress: Array) -> Array:
    """stress : d2C, shape (6, 6, p, e)."""
    out = np.zeros((6, 6, *stress.shape[1:]))
    out[:3, :3], out[3:, 3:] = 2 * stress[0] * IDENTITY, 2 * stress[2] * IDENTITY
    out[:3, 3:] = out[3:, :3] = stress[1] * IDENTITY
    return out
