"""The membrane energy, of the strain at the points or interpolated.

The strain of the coordinates E_ab = (x_a . x_b - X_a . X_b) / 2 is quadratic in the unknowns. What is seen of it, the
values at the points or the coefficients of its interpolation, is so with constants of the reference triangle alone:

    E_r = sum_ij T_rij (X_i + u_i / 2) . u_j,    dE_r / du_j = sum_i T_rij x_i,    d2E_r / du_i du_j = T_rij I.

The density depends on the invariants t = tr E and e = det E of the mixed components, see laws.py. The tangent has
strain and stress extrapolated over the last update, see shell/membrane.py.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from embedding.shell.batched.algebra import DETERMINANT, both, determinant, determinant_slope, dot, outer
from embedding.shell.batched.laws import Hooke, Rubber
from embedding.shell.batched.places import Block, Surface
from embedding.shell.batched.polynomials import (
    GRADIENT,
    Array,
    lattice,
    monomials,
    through,
    triangle_rule,
)
from embedding.shell.batched.reference import interpolation
from embedding.shell.membrane import LEAST


class Membrane:
    """The membrane integral of a block; ``cured`` says whether the strain is interpolated."""

    def __init__(self, block: Block, degree: int, law: Hooke | Rubber, thickness: Array, *, cured: bool) -> None:
        points, weights = triangle_rule(degree)
        self._law, self._places = law, block.places
        self._slopes = block.gradients(points)
        surface = Surface.of(block, points)
        self._weights = block.copies * weights[:, None] * surface.area * thickness
        self._inverse, self._square = surface.inverse, surface.area**2
        if cured:
            seen = _interpolated(block.order)
            self._values = monomials(block.order - 1, points)
        else:
            seen, self._values = _plain(block.order, degree), np.eye(len(points))
        self._strain = np.einsum("rvij,ia,jb->vrab", seen, block.shapes, block.shapes)
        self._matrix = self._strain.reshape(-1, block.shapes.shape[1])
        self._before: tuple[Array, Array] | None = None
        self._pairs = (self._values[:, :, None] * self._values[:, None, :]).reshape(len(points), -1)

    def residual(self, u: Array) -> Array:
        """First derivative (n, 3, e) at the displacement ``u``, in the elements' basis."""
        E = self._at_points(self._seen(self._places + 0.5 * u, u))
        return self._pulled(self._stress(E), self._slope(self._places + u))

    def matrix(self, u: Array, update: Array, guessed: bool, continued: bool) -> Array:
        """Second derivative (e, 3n, 3n) at ``u``, the strain extrapolated over the last ``update``, or that before it
        if the state is ``guessed``; the stress is linearised if the last matrix has led there (``continued``)."""
        E, slope = self._at_points(self._seen(self._places + 0.5 * u, u)), self._slope(self._places + u)
        present = E
        if np.any(update):
            half = self._places + u - 0.5 * update if guessed else 0.5 * update
            E = self._without(E, self._at_points(self._seen(half, update)))
        stress = self._stress(E)
        if continued and self._before is not None:
            was, led = self._before
            stress = self._stress(was) + np.einsum("rs...,s...->r...", self._stiffness(led), E - was)
        self._before = present, E
        seen, count, n = len(slope), u.shape[2], u.shape[0]
        nodes = self._values.shape[1]
        stiff = np.tensordot(self._pairs, self._stiffness(E), axes=(0, 2)).reshape(nodes, nodes, 3, 3, count)
        stiff = stiff.transpose(4, 2, 0, 3, 1).reshape(count, seen, seen)
        flat = slope.transpose(3, 0, 2, 1).reshape(count, seen, 3 * n)
        out = flat.swapaxes(1, 2) @ (stiff @ flat)
        turned = (self._coefficients(stress).reshape(seen, -1).T @ self._strain.reshape(seen, -1)).reshape(count, n, n)
        for i in range(3):
            out[:, i * n : (i + 1) * n, i * n : (i + 1) * n] += turned
        return np.asarray(out)

    def _slope(self, x: Array) -> Array:
        """dE_r / du (r, n, 3, e)."""
        return np.asarray(self._matrix @ x.reshape(len(x), -1)).reshape(-1, *x.shape)

    def _seen(self, half: Array, u: Array) -> Array:
        """sum T_rij half_i . u_j, shape (3, nodes, e)."""
        products = np.einsum("rjae,jae->re", self._slope(half), u)
        return np.asarray(products.reshape(3, -1, u.shape[2]))

    def _at_points(self, seen: Array) -> Array:
        return np.asarray(self._values @ seen)

    def _coefficients(self, stress: Array) -> Array:
        """Work of ``stress`` (3, p, e) on each of what is seen (3, nodes, e)."""
        return np.asarray(self._values.T @ stress)

    def _pulled(self, stress: Array, slope: Array) -> Array:
        work = self._coefficients(stress).reshape(len(slope), -1)
        return np.asarray(np.einsum("re,rjae->jae", work, slope))

    def _invariants(self, E: Array) -> tuple[Array, Array]:
        return dot(self._inverse, E), determinant(E) / self._square

    def _stress(self, E: Array) -> Array:
        """Derivative (3, p, e) of the energy in the components of the strain ``E``."""
        slopes = self._law.slopes(*self._invariants(E))
        area = determinant_slope(E) / self._square
        return np.asarray(self._weights * (slopes.t * self._inverse + slopes.e * area))

    def _stiffness(self, E: Array) -> Array:
        """Second derivative (3, 3, p, e)."""
        slopes = self._law.slopes(*self._invariants(E))
        trace, area = self._inverse, determinant_slope(E) / self._square
        out = slopes.tt * outer(trace, trace) + slopes.e * DETERMINANT / self._square
        if isinstance(self._law, Rubber):
            out = out + slopes.te * both(trace, area) + slopes.ee * outer(area, area)
        return np.asarray(self._weights * out)

    def _without(self, E: Array, grown: Array) -> Array:
        """The strain less what has ``grown``, where that leaves enough of the squared stretches."""
        (trace, area), (was, before) = (self._stretched(strain) for strain in (E - grown, E))
        return np.where((trace > LEAST * was) & (area > LEAST * before), E - grown, E)

    def _stretched(self, E: Array) -> tuple[Array, Array]:
        """I_C and J_s^2."""
        t, e = self._invariants(E)
        return 2 + 2 * t, 1 + 2 * t + 4 * e


@cache
def _products(order: int) -> Array:
    """Coefficients (monomials of degree 2 order - 2, 3, monomials, monomials) of E_ab = phi_i,a phi_j,b, symmetric."""
    degree = 2 * order - 2
    first, second = (monomials(order, lattice(degree), d) for d in GRADIENT)
    mixed = np.einsum("pi,pj->pij", first, second)
    values = [np.einsum("pi,pj->pij", first, first), 0.5 * (mixed + mixed.swapaxes(1, 2))]
    return through(degree, np.stack([*values, np.einsum("pi,pj->pij", second, second)], axis=1))


def _plain(order: int, degree: int) -> Array:
    """The strain at the points of the rule of ``degree``, shape (p, 3, monomials, monomials)."""
    return np.tensordot(monomials(2 * order - 2, triangle_rule(degree)[0]), _products(order), axes=1)


@cache
def _interpolated(order: int) -> Array:
    """Coefficients (monomials, 3, monomials, monomials) of the interpolated strain."""
    degree = 2 * order - 2
    table = interpolation(order - 1, degree)
    return np.asarray(np.einsum("rvmw,mwij->rvij", table, _products(order)))
