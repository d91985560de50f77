"""Stress through the thickness against exact thick-walled spheres and tubes: second order in the thickness."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from ngsolve import BND, CF, GridFunction, VectorH1
from scipy.integrate import quad

from embedding.shell.charts import normal_chart
from embedding.shell.derivatives import Derivatives
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import KoiterLaw, Law, MooneyRivlinLaw, OgdenLaw, YeohLaw, piecewise
from embedding.shell.stresses import Stresses, normal_response
from embedding.shell.tables import Tables
from problems.exact import cylinder, sphere
from problems.exact.material import mooney_rivlin
from tests.forms import Array, body
from tests.shell.test_kinematics import at, points_of

STRETCH, TOP = 1.3, 0.3
RATIOS = (0.2, 0.1, 0.05)
C1, C2 = 0.45, 0.05
EXACT = mooney_rivlin(C1, C2)


class Exact(NamedTuple):
    """Principal Cauchy stresses: across the wall, around, and along the tube (of the sphere: around too)."""

    normal: float
    hoop: float
    other: float


def thick(shape: str, ratio: float, place: float) -> Exact:
    """Exact stresses of the particle that starts at radius 1 + ``place`` T, by quadrature of radial equilibrium."""
    power = 3 if shape == "sphere" else 2

    def stretch(radius: float) -> float:
        return float((1 + (STRETCH**power - 1) / radius**power) ** (1 / power))

    def thin(radius: float) -> float:
        return stretch(radius) ** (1 - power)

    def rate(radius: float) -> float:  # d sigma_rr / dR = (power - 1) (sigma_hoop - sigma_rr) / r  dr / dR
        difference = EXACT.stress_difference(stretch(radius), thin(radius))
        return (power - 1) * difference / (radius * stretch(radius)) * thin(radius)

    radius = 1 + place * ratio
    normal = -TOP - quad(rate, radius, 1 + ratio / 2, epsabs=1e-13)[0]
    hoop = normal + EXACT.stress_difference(stretch(radius), thin(radius))
    along = normal + EXACT.stress_difference(1.0, thin(radius)) if shape == "tube" else hoop
    return Exact(normal, hoop, along)


def inflated(shape: str, ratio: float, law: Law | None = None) -> tuple[Stresses, Derivatives, object]:
    """The shell at the exact stretch of its mid-surface, under the exact pressures."""
    domain = body("axisymmetric sphere" if shape == "sphere" else "ring", 0.2, 4)
    u = GridFunction(VectorH1(domain.mesh, order=4))
    u.Set((STRETCH - 1) * domain.reduction.position, BND, definedon=domain.shell)
    derivatives = Derivatives(domain, Kinematics(domain.reduction, domain.normal, u))
    law = MooneyRivlinLaw(C1, C2) if law is None else law
    tables = Tables(derivatives, normal_chart(derivatives), ratio, law)
    pressure = (sphere if shape == "sphere" else cylinder).thick_pressure(STRETCH, ratio, EXACT)
    return Stresses(tables, law, TOP, TOP + pressure), derivatives, points_of(domain)


def value(values: object, points: object) -> Array:
    return at(CF(values).Compile(), points)


def tensor(exact: Exact, derivatives: Derivatives, points: object) -> Array:
    n = value(derivatives.normal, points)
    e, f = (value(v, points) for v in derivatives.frame)
    return np.asarray(sum(s * np.einsum("ni,nj->nij", v, v) for s, v in zip(exact, (n, e, f), strict=True))).reshape(
        len(n), 9
    )


@pytest.mark.parametrize("place", [-0.5, -0.2, 0.0, 0.3, 0.5])
@pytest.mark.parametrize("shape", ["sphere", "tube"])
def test_second_order_in_the_thickness(shape: str, place: float) -> None:
    """sigma_nn, the whole tensor and the mean pressure; twice as thin is four times as right."""
    errors = []
    for ratio in RATIOS:
        stresses, derivatives, points = inflated(shape, ratio)
        exact = thick(shape, ratio, place)
        found = value(stresses.cauchy(place), points)
        normal = value(stresses.normal(place), points)
        mean = value(stresses.hydrostatic(place), points)
        errors.append(
            (
                np.abs(found - tensor(exact, derivatives, points)).max(),
                np.abs(normal - exact.normal).max(),
                np.abs(mean + sum(exact) / 3).max(),
            )
        )
    for i, kind in enumerate(("stress", "normal", "mean")):
        a, b, c = (row[i] for row in errors)
        if abs(place) == 0.5 and kind == "normal":
            assert max(a, b, c) < 1e-12  # the pressures themselves
            continue
        assert a < 0.3 * RATIOS[0] ** 2, kind
        assert math.log2(a / b) > 1.9, kind
        assert math.log2(b / c) > 1.9, kind


@pytest.mark.parametrize("shape", ["sphere", "tube"])
def test_pressure_at_the_mid_surface(shape: str) -> None:
    """p_0 = mu lambda^2 + pbar for neo-Hooke, and sigma_nn = - pbar + O(T^2) as in the exact solid."""
    stresses, _, points = inflated(shape, 0.1, MooneyRivlinLaw(0.5))
    thin = STRETCH ** (-2 if shape == "sphere" else -1)
    mean = (stresses.pressure_top + stresses.pressure_bottom) / 2
    assert np.abs(value(stresses.pressure(0.0), points) - (thin**2 + mean)).max() < 1e-6  # the mesh
    found = {ratio: inflated(shape, ratio)[0] for ratio in RATIOS}
    gaps = [thick(shape, r, 0.0).normal + (s.pressure_top + s.pressure_bottom) / 2 for r, s in found.items()]
    assert all(abs(gap) < 0.3 * ratio**2 for gap, ratio in zip(gaps, RATIOS, strict=True))


@pytest.mark.parametrize(
    "law",
    [
        MooneyRivlinLaw(C1, C2),
        YeohLaw(0.5, -0.02, 0.01),
        OgdenLaw((1.2, -0.3), (1.8, -2.0)),
        piecewise(CF(1.0), MooneyRivlinLaw(0.3, 0.1), MooneyRivlinLaw(0.5)),
    ],
    ids=["mooney-rivlin", "yeoh", "ogden", "piecewise"],
)
def test_pressure_belongs_to_the_law(law: Law) -> None:
    """In plane stress sigma_i = l_i dW/dl_i - p: the law's stresses plus p are l_i dW/dl_i, by differences of W."""
    major, minor = 1.4, 1.1
    mesh_free = law.inside if hasattr(law, "inside") else law

    def energy(a: float, b: float, c: float) -> float:
        if isinstance(mesh_free, OgdenLaw):
            return sum(
                m / s * (a**s + b**s + c**s - 3) for m, s in zip(mesh_free.moduli, mesh_free.exponents, strict=True)
            )
        x = a * a + b * b + c * c - 3
        if isinstance(mesh_free, YeohLaw):
            return mesh_free.of_excess(x)
        return mesh_free.c1 * x + mesh_free.c2 * ((a * b) ** 2 + (b * c) ** 2 + (c * a) ** 2 - 3)

    h, stretches = 1e-4, (major, minor, 1 / (major * minor))
    slopes = []
    for i in range(3):
        up, down = ([s + (sign * h if j == i else 0.0) for j, s in enumerate(stretches)] for sign in (1, -1))
        slopes.append(stretches[i] * (energy(*up) - energy(*down)) / (2 * h))
    domain = body("ring")
    found = value(normal_response(law, CF(major), CF(minor)), points_of(domain))
    assert np.abs(found - slopes[2]).max() < 1e-6  # h^2 times third derivatives
    assert mesh_free.principal_stresses(major, minor) == pytest.approx(
        (slopes[0] - slopes[2], slopes[1] - slopes[2]), abs=1e-6
    )


def test_equal_stretches_and_rest() -> None:
    """The tensor is smooth where the principal stretches meet, and vanishes at rest."""
    stresses, derivatives, points = inflated("sphere", 0.1)
    derivatives.kinematics.u.vec[:] = 0.0
    at_rest = Stresses(stresses.tables, stresses.law, 0.0, 0.0)
    assert np.abs(value(at_rest.cauchy(0.0), points)).max() < 1e-6


def test_small_strains() -> None:
    """A law of small strains: the pressures add nu / (1 - nu) sigma_nn in the layer; it has no pressure of its own."""
    law = KoiterLaw(1.0, 0.3)
    stresses, derivatives, points = inflated("tube", 0.1, law)
    derivatives.kinematics.u.vec[:] = 0.0
    found = value(Stresses(stresses.tables, law, 0.2, 0.2).cauchy(0.0), points)
    share = 0.3 / 0.7
    exact = tensor(Exact(-0.2, -0.2 * share, -0.2 * share), derivatives, points)
    assert np.abs(found - exact).max() < 1e-9
    with pytest.raises(ValueError, match="incompressible"):
        stresses.pressure(0.0)
