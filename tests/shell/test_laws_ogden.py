"""Ogden's law at and near equal stretches: energy, stress and stiffness against closed forms in 60 digits."""

from __future__ import annotations

from decimal import Decimal, getcontext
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, BilinearForm, GridFunction, Variation, VectorH1

from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import OgdenLaw
from embedding.shell.laws.ogden import NEAR, even_binomials
from tests.forms import body

getcontext().prec = 60
LAWS = {
    "rubber": OgdenLaw((1.49, 0.00284, -0.0237), (1.3, 5.0, -2.0)),
    "steep": OgdenLaw((0.02, -0.02), (10.0, -10.0)),
    "whole powers": OgdenLaw((0.8, -0.2), (2.0, -2.0)),
}
MOVES = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 1, 1), (0, 0, 1, -1), (1, 1, 0, 0), (1, -1, 0.5, 0.2))
"""Increments (G_11, G_22, G_12, G_21) of the deformation gradient."""
EDGE = ((1 + NEAR**0.5) / (1 - NEAR**0.5)) ** 0.5
"""Ratio of stretches at which the series hands over to the root."""
RATIOS = (1.0, 1 + 1e-9, 1 + 1e-6, 1 + 1e-3, 1.05, EDGE - 1e-6, EDGE + 1e-6, 1.2, 2.0)


def closed_form(law: OgdenLaw, first: float, second: float, move: tuple[float, ...]) -> tuple[float, float, float]:
    """Energy and its first and second derivative along G, at F = diag(first, second).

    Ogden, Non-linear Elastic Deformations (1984), section 6.1: with W_i = dW/dl_i, dW = W_i G_ii and
    d2W = W_ij G_ii G_jj + (l_1 W_1 - l_2 W_2) / (l_1^2 - l_2^2) (G_12^2 + G_21^2)
        + 2 (l_2 W_1 - l_1 W_2) / (l_1^2 - l_2^2) G_12 G_21.
    """
    a, b = Decimal(first), Decimal(second)
    a = a * (1 + Decimal("1e-20")) if a == b else a  # error 1e-20, and 40 digits are left of the quotients
    g11, g22, g12, g21 = (Decimal(g) for g in move)
    energy = w1 = w2 = w11 = w22 = w12 = Decimal(0)
    for modulus, exponent in zip(law.moduli, law.exponents, strict=True):
        mu, alpha = Decimal(modulus), Decimal(exponent)
        p, q, t = a**alpha, b**alpha, (a * b) ** -alpha
        energy += mu / alpha * (p + q + t - 3)
        w1 += mu * (p - t) / a
        w2 += mu * (q - t) / b
        w11 += mu * ((alpha - 1) * p + (alpha + 1) * t) / a**2
        w22 += mu * ((alpha - 1) * q + (alpha + 1) * t) / b**2
        w12 += mu * alpha * t / (a * b)
    difference = a * a - b * b
    shear, turn = (a * w1 - b * w2) / difference, (b * w1 - a * w2) / difference
    slope = w1 * g11 + w2 * g22
    curvature = w11 * g11**2 + 2 * w12 * g11 * g22 + w22 * g22**2
    curvature += shear * (g12**2 + g21**2) + 2 * turn * g12 * g21
    return float(energy), float(slope), float(curvature)


class Sheet:
    """A unit area of plate in a state of uniform deformation."""

    def __init__(self, law: OgdenLaw) -> None:
        domain = body("plate", order=1)
        space = VectorH1(domain.mesh, order=1)
        self.form = BilinearForm(space)
        kinematics = Kinematics(domain.reduction, domain.normal, space.TrialFunction())
        self.form += Variation(law.energy(kinematics) * domain.surface()).Compile()
        self.area = domain.shell_integral(1.0)
        self.shell, self.place = domain.shell, domain.reduction.position
        self.u, self.move, self.out = GridFunction(space), GridFunction(space), GridFunction(space)

    def derivatives(self, first: float, second: float, move: tuple[float, ...]) -> tuple[float, float, float]:
        g11, g22, g12, g21 = move
        x, y = self.place[0], self.place[1]
        self.u.Set(CF(((first - 1) * x, (second - 1) * y, 0)), BND, definedon=self.shell)
        self.move.Set(CF((g11 * x + g12 * y, g21 * x + g22 * y, 0)), BND, definedon=self.shell)
        self.form.Apply(self.u.vec, self.out.vec)
        slope = self.out.vec.InnerProduct(self.move.vec)
        self.form.AssembleLinearization(self.u.vec)
        self.out.vec.data = self.form.mat * self.move.vec
        curvature = self.out.vec.InnerProduct(self.move.vec)
        energy = self.form.Energy(self.u.vec)
        return energy / self.area, slope / self.area, curvature / self.area


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_energy_stress_and_stiffness_near_equal_stretches(law: OgdenLaw) -> None:
    """Relative to the stiffness, as energy and stress vanish at rest. Rounding is 5e-15; without the series, 2e-10."""
    sheet = Sheet(law)
    for stretch in (0.8, 1.0, 1.3, 2.0):
        for ratio in RATIOS:
            pairs: Any = [
                (sheet.derivatives(stretch * ratio, stretch, move), closed_form(law, stretch * ratio, stretch, move))
                for move in MOVES
            ]
            found, exact = np.array([p[0] for p in pairs]), np.array([p[1] for p in pairs])
            stiffness = np.abs(exact[:, 2]).max()
            assert np.abs(found - exact).max() < 1e-12 * stiffness, (stretch, ratio)


@pytest.mark.parametrize("s", [-10.0, -1.0, -0.35, 0.65, 2.0, 2.5, 12.0])
def test_the_series(s: float) -> None:
    """(1 + r)^s + (1 - r)^s = 2 sum C(s, 2k) r^2k up to the largest r it is used at; whole powers end by themselves."""
    r = NEAR**0.5
    value = 2 * sum(c * NEAR**k for k, c in enumerate(even_binomials(s)))
    assert value == pytest.approx((1 + r) ** s + (1 - r) ** s, rel=1e-14)
    assert len(even_binomials(2.0)) == 3
