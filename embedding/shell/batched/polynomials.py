"""Polynomials on the reference triangle, by their coefficients of monomials."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from ngsolve import ET, IntegrationRule

Array = npt.NDArray[np.float64]

GRADIENT = ((1, 0), (0, 1))
HESSIAN = ((2, 0), (1, 1), (0, 2))
"""Which derivatives make up a gradient and a Hessian."""


def exponents(degree: int) -> list[tuple[int, int]]:
    """Exponents of the monomials up to ``degree``."""
    return [(i, total - i) for total in range(degree + 1) for i in range(total + 1)]


def monomials(degree: int, points: Array, derivative: tuple[int, int] = (0, 0)) -> Array:
    """A ``derivative`` of all monomials up to ``degree`` at ``points`` (p, 2), shape (p, monomials)."""
    columns = []
    for powers in exponents(degree):
        column = np.ones(len(points))
        for axis, (power, times) in enumerate(zip(powers, derivative, strict=True)):
            for _ in range(times):
                column = column * power
                power -= 1
            column = column * points[:, axis] ** max(power, 0)
        columns.append(column)
    return np.stack(columns, axis=1)


def lattice(degree: int) -> Array:
    """Points (p, 2) that determine a polynomial of ``degree``."""
    if degree == 0:
        return np.array([[1 / 3, 1 / 3]])
    return np.array([(i / degree, j / degree) for i, j in exponents(degree)])


def through(degree: int, values: Array) -> Array:
    """Coefficients (monomials, ...) of the polynomials with ``values`` (p, ...) at the lattice of ``degree``."""
    return np.tensordot(np.linalg.inv(monomials(degree, lattice(degree))), values, axes=1)


def triangle_rule(degree: int) -> tuple[Array, Array]:
    """NGSolve's points (p, 2) and weights (p,) for ``degree``."""
    rule = IntegrationRule(ET.TRIG, degree)
    return np.array([point.point[:2] for point in rule]), np.array([point.weight for point in rule])


def segment_rule(degree: int) -> tuple[Array, Array]:
    """NGSolve's points (p,) and weights (p,) on the unit segment for ``degree``."""
    rule = IntegrationRule(ET.SEGM, degree)
    return np.array([point.point[0] for point in rule]), np.array([point.weight for point in rule])


def as_rule(points: Array) -> IntegrationRule:
    """``points`` (p, 2) as something to evaluate at."""
    return IntegrationRule([(float(a), float(b)) for a, b in points], [0.0] * len(points))
