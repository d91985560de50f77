"""The dual bending energy J W_b* of moments, J the reference area, with its derivatives.

``m`` are the contravariant components of the moment times J^2, C the covariant ones of the Cauchy-Green tensor, G the
reference metric. By Cayley and Hamilton tr(m C m C) = (m : C)^2 - 2 det m det C, so that

    small strains    6 / (E T^3 J^3) [(m : G)^2 - 2 (1 + nu) det m det G]
    incompressible   3 / (T^3 J^5) rho (2/3 (m : C)^2 - 2 det m det C),        rho = det C / mu_b

Source: stiffness.py.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from embedding.shell.batched.algebra import (
    DETERMINANT,
    IDENTITY,
    TWICE,
    both,
    determinant,
    determinant_slope,
    dot,
    outer,
)
from embedding.shell.batched.laws import Hooke, Rubber
from embedding.shell.batched.places import Surface
from embedding.shell.batched.polynomials import Array


class Slopes(NamedTuple):
    """Derivatives in the three components of C and of m."""

    C: Any
    m: Any


class Bends(NamedTuple):
    """Second derivatives (3, 3, p, e)."""

    CC: Any
    mC: Any
    mm: Any


class HookeDual:
    """That of small strains: quadratic in the moment, and independent of C."""

    def __init__(self, law: Hooke, thickness: Array, surface: Surface) -> None:
        lowered = TWICE * surface.metric
        form = 2 * outer(lowered, lowered) - 2 * (1 + law.poisson) * surface.area**2 * DETERMINANT
        self._stiff = 6 / (law.youngs * thickness**3 * surface.area**3) * form

    def slopes(self, m: Array, C: Array) -> Slopes:
        """First derivatives at the moment ``m`` and the metric ``C``, both (3, p, e)."""
        return Slopes(np.zeros((3, 1, 1)), (self._stiff * m).sum(axis=1))

    def bends(self, m: Array, C: Array) -> Bends:
        """Second derivatives."""
        nothing = np.zeros((3, 3, 1, 1))
        return Bends(nothing, nothing, self._stiff)


class RubberDual:
    """That of an incompressible law."""

    def __init__(self, law: Rubber, thickness: Array, surface: Surface) -> None:
        self._law, self._surface = law, surface
        self._scale = 3 / (thickness**3 * surface.area**5)

    def slopes(self, m: Array, C: Array) -> Slopes:
        """First derivatives at the moment ``m`` and the metric ``C``, both (3, p, e)."""
        rho, rho_C, _ = self._softness(C)
        square, of_C, of_m = _square(m, C)
        return Slopes(self._scale * (rho_C * square + rho * of_C), self._scale * rho * of_m)

    def bends(self, m: Array, C: Array) -> Bends:
        """Second derivatives."""
        rho, rho_C, rho_CC = self._softness(C)
        square, of_C, of_m = _square(m, C)
        pairing = dot(TWICE * m, C)
        by_C, by_m = TWICE * m, TWICE * C
        square_CC = 4 / 3 * outer(by_C, by_C) - 2 * determinant(m) * DETERMINANT
        square_mm = 4 / 3 * outer(by_m, by_m) - 2 * determinant(C) * DETERMINANT
        square_mC = 4 / 3 * (outer(by_m, by_C) + pairing * TWICE * IDENTITY)
        square_mC = square_mC - 2 * outer(determinant_slope(m), determinant_slope(C))
        return Bends(
            self._scale * (rho_CC * square + both(rho_C, of_C) + rho * square_CC),
            self._scale * (outer(of_m, rho_C) + rho * square_mC),
            self._scale * rho * square_mm,
        )

    def _softness(self, C: Array) -> tuple[Array, Array, Array]:
        """rho = det C / mu_b and its derivatives in C."""
        surface = self._surface
        det, slope, square = determinant(C), determinant_slope(C), surface.area**2
        inverse = square / det
        x = dot(surface.inverse, C) + inverse - 3
        mu, mu_x, mu_xx = self._law.bending_modulus(x)
        if isinstance(mu, float):
            return det / mu, slope / mu, DETERMINANT / mu
        soft, soft_x, soft_xx = 1 / mu, -mu_x / mu**2, 2 * mu_x**2 / mu**3 - mu_xx / mu**2
        x_C = surface.inverse - slope * inverse / det
        x_CC = (2 * outer(slope, slope) / det - DETERMINANT) * (inverse / det)
        return (
            det * soft,
            soft * slope + det * soft_x * x_C,
            soft * DETERMINANT + soft_x * both(slope, x_C) + det * (soft_xx * outer(x_C, x_C) + soft_x * x_CC),
        )


def _square(m: Array, C: Array) -> tuple[Array, Array, Array]:
    """2/3 (m : C)^2 - 2 det m det C with its derivatives in C and m."""
    pairing, det_m, det_C = dot(TWICE * m, C), determinant(m), determinant(C)
    return (
        2 / 3 * pairing**2 - 2 * det_m * det_C,
        4 / 3 * pairing * TWICE * m - 2 * det_m * determinant_slope(C),
        4 / 3 * pairing * TWICE * C - 2 * det_C * determinant_slope(m),
    )


def dual_of(law: Hooke | Rubber, thickness: Array, surface: Surface) -> HookeDual | RubberDual:
    """The dual energy of ``law`` at points of ``surface`` of a shell with the ``thickness`` (p, e) there."""
    return HookeDual(law, thickness, surface) if isinstance(law, Hooke) else RubberDual(law, thickness, surface)
