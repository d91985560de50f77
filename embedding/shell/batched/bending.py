"""Moments and curvature inside the elements.

In the coordinates of the reference triangle, with x = X + u, A = x_1 x x_2, J = |X_1 x X_2|, the sign s of the element
and the moment's components m^ab times J^2, the integrand of surface.py over the triangle is

    s m^ab x_ab . A / |A|^2  -  m^ab B_a^c C_cb / J  -  J W_b*,        C_ab = x_a . x_b,

for Hess(u) . d - (N . d) Grad N has the components lambda b_ab: what the Christoffel symbols add is tangential.
"""

from __future__ import annotations

import numpy as np

from embedding.shell.batched.algebra import TWICE, dot, metric_slope
from embedding.shell.batched.curvature import Curved, second_stretching, stretching
from embedding.shell.batched.duals import dual_of
from embedding.shell.batched.laws import Hooke, Rubber
from embedding.shell.batched.matrices import Matrices, columns, gathered, pair_columns, pairs
from embedding.shell.batched.places import Block, Surface, derivatives
from embedding.shell.batched.polynomials import Array, monomials, triangle_rule


class Bending:
    """The two interior integrals of a block, whose moments have the basis ``moments`` (monomials, 3, nm)."""

    def __init__(self, block: Block, moments: Array, degree: int, law: Hooke | Rubber, thickness: Array) -> None:
        points, weights = triangle_rule(degree)
        self._slopes, self._hessians = block.gradients(points), block.hessians(points)
        self._moments = np.einsum("pk,kvq->vpq", monomials(block.order - 1, points), moments)
        surface = Surface.of(block, points)
        self._weights = block.copies * weights[:, None]
        self._lever = self._weights * block.sign
        self._dual = dual_of(law, thickness, surface)
        self._rest = -self._weights / surface.area * _mixed(surface)
        u, m = self._slopes, self._moments
        self._uu = np.concatenate([pairs(u, u), pairs(self._hessians, u)], axis=1)
        self._mu = np.concatenate([pairs(m, u), pairs(_flat(m), _flat(self._hessians))], axis=1)
        self._mm = pairs(m, m)

    def residual(self, x: Array, m: Array) -> tuple[Array, Array]:
        """First derivatives (n, 3, e) and (nm, e) at places ``x`` and moments ``m``, in the elements' bases."""
        at = self._curved(x, m)
        dual = self._dual.slopes(at.m, at.C)
        stress = (self._rest * at.m[:, None]).sum(axis=0) - self._weights * dual.C
        pull = self._lever * at.turned + stretching(stress, at.first, at.second)
        bent = self._lever * at.weighted[:, None] * at.director
        seen = self._lever * TWICE * np.stack([dot(x_ab, at.director) for x_ab in at.hessian])
        seen = seen + (self._rest * at.C).sum(axis=1) - self._weights * dual.m
        force = gathered(self._slopes, pull) + gathered(self._hessians, bent)
        return force, _flat(self._moments)[0].T @ seen.reshape(-1, m.shape[1])

    def matrices(self, x: Array, m: Array) -> Matrices:
        """Second derivatives at places ``x`` and moments ``m``."""
        at = self._curved(x, m)
        slopes, bends = self._dual.slopes(at.m, at.C), self._dual.bends(at.m, at.C)
        by_C = metric_slope(at.first, at.second)
        n, nm, count = self._slopes.shape[2], *m.shape
        return Matrices(
            (self._uu @ self._between_places(at, slopes.C, bends.CC, by_C)).reshape(n, n, 3, 3, count),
            (self._mu @ self._on_moments(at, bends.mC, by_C)).reshape(nm, n, 3, count),
            (self._mm @ self._between_moments(bends.mm, count)).reshape(nm, nm, count),
        )

    def _curved(self, x: Array, m: Array) -> Curved:
        values = (_flat(self._moments)[0] @ m).reshape(3, -1, m.shape[1])
        return Curved(derivatives(self._slopes, x), derivatives(self._hessians, x), values)

    def _between_places(self, at: Curved, dual_C: Array, dual_CC: Array, by_C: Array) -> Array:
        """What stands between two gradients, and, through y, between a second derivative and a gradient."""
        stress = (self._rest * at.m[:, None]).sum(axis=0) - self._weights * dual_C
        half = 0.5 * (self._lever * at.turned_twice() + second_stretching(stress))
        if np.any(dual_CC):
            stiff = np.einsum("vwpe,wkpe->vkpe", -0.5 * self._weights * dual_CC, by_C)
            half += np.einsum("vjpe,vkpe->jkpe", by_C, stiff)
        bent = at.weighted[:, None, None] * (self._lever * at.director_slope)
        return np.concatenate([pair_columns(half), pair_columns(bent.reshape(9, *bent.shape[2:]))])

    def _on_moments(self, at: Curved, dual_mC: Array, by_C: Array) -> Array:
        """What stands between a moment and a gradient, and between a moment and a second derivative."""
        seen = np.einsum("vwpe,wkpe->vkpe", self._rest - self._weights * dual_mC, by_C)
        for i, x_ab in enumerate(at.hessian):
            seen[i] += self._lever * TWICE[i] * at.by_places(at.reflected(x_ab))
        return np.concatenate([columns(seen), columns(TWICE[:, None] * (self._lever * at.director))])

    def _between_moments(self, dual_mm: Array, count: int) -> Array:
        return np.broadcast_to(-self._weights * dual_mm, (3, 3, len(self._weights), count)).reshape(-1, count)


def _flat(table: Array) -> Array:
    """A table (d, p, n) as one of a single kind at d p points."""
    return table.reshape(1, -1, table.shape[2])


def _mixed(surface: Surface) -> Array:
    """The matrix (3, 3, p, e) of m^ab B_a^c C_cb in the components of m and C."""
    inverse, bend = surface.inverse, surface.curvature
    half = 0.5 * inverse[1]
    a, b = bend[0] * inverse[0] + bend[1] * half, bend[0] * half + bend[1] * inverse[2]
    c, d = bend[1] * inverse[0] + bend[2] * half, bend[1] * half + bend[2] * inverse[2]
    zero = np.zeros_like(a)
    return np.stack([np.stack([a, b, zero]), np.stack([c, a + d, b]), np.stack([zero, c, d])])
