"""Hyperelastic laws: energies against numpy, the scaling of a scene's material, gradients and Hessians."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import CF, BilinearForm, GridFunction, Variation

from embedding import MooneyRivlin, NeoHookean
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import TraceSpace, plane_mask
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import Law
from tests.forms import BODIES, Taylor, body, close_to, random_directions, set_on_shell, smooth

LAWS = [Law(0.5, 0.0), Law(0.4, 0.1)]


class Stretched:
    """What a law asks of kinematics, for two principal stretches."""

    def __init__(self, first: float, second: float) -> None:
        self.surface_stretch_squared = (first * second) ** 2
        self.metric_trace = first**2 + second**2


def energy(law: Law, first: float, second: float) -> float:
    return float(law.energy(Stretched(first, second)))  # type: ignore[arg-type]


@pytest.mark.parametrize("law", LAWS)
def test_energy_of_principal_stretches(law: Law) -> None:
    for first, second in ((1.0, 1.0), (1.3, 0.9), (2.0, 1.7), (0.6, 3.0)):
        squares = np.array([first, second, 1 / (first * second)]) ** 2
        expected = law.c1 * (squares.sum() - 3) + law.c2 * ((1 / squares).sum() - 3)
        assert energy(law, first, second) == pytest.approx(expected, rel=1e-14, abs=1e-15)


@pytest.mark.parametrize("law", LAWS)
def test_rest_is_the_only_minimum_nearby(law: Law) -> None:
    """Zero and stationary at rest; for small strains W = mu (e_1^2 + e_2^2 + (e_1 + e_2)^2)."""
    mu, h = 2 * (law.c1 + law.c2), 1e-3

    def second_derivative(a: float, b: float) -> float:
        return (energy(law, 1 + a * h, 1 + b * h) + energy(law, 1 - a * h, 1 - b * h)) / h**2

    assert energy(law, 1.0, 1.0) == pytest.approx(0.0, abs=1e-15)
    assert energy(law, 1 + h, 1.0) - energy(law, 1 - h, 1.0) == pytest.approx(0.0, abs=20 * mu * h**3)
    assert second_derivative(1, 1) == pytest.approx(12 * mu, rel=1e-4)
    assert second_derivative(1, -1) == pytest.approx(4 * mu, rel=1e-4)


def test_a_material_in_units_of_a_stress() -> None:
    assert Law.of(NeoHookean(shear_modulus=2e5), 2e5) == Law(0.5, 0.0)
    assert Law.of(NeoHookean(shear_modulus=2e5), 1e5) == Law(1.0, 0.0)
    assert Law.of(MooneyRivlin(c1=3e4, c2=1e4), 8e4) == Law(0.375, 0.125)


def energy_form(domain: Domain, law: Law) -> tuple[BilinearForm, Any, Any]:
    space = TraceSpace(domain.mesh, domain.sizes.order)
    if domain.reduction.name == "axisymmetric":
        space.fix(0, plane_mask(space.scalar, 0))
    trial = space.space.TrialFunction()
    form = BilinearForm(space.space)
    density = law.energy(Kinematics(domain.reduction, domain.normal, trial))
    form += Variation(domain.reduction.measure * density * domain.surface())
    u = GridFunction(space.space)
    set_on_shell(u, smooth(domain), space.free, domain)
    return form, u, space.free


@pytest.mark.parametrize("law", LAWS, ids=["neo-hookean", "mooney-rivlin"])
@pytest.mark.parametrize("name", BODIES)
def test_gradient_and_hessian(name: str, law: Law) -> None:
    form, u, free = energy_form(body(name), law)
    taylor = Taylor(form, u.vec, random_directions(free, 0.01))
    assert close_to(taylor.gradient_orders(), 2)
    assert close_to(taylor.hessian_orders(), 3)
    assert close_to(taylor.tangent_orders(), 2)


@pytest.mark.parametrize("law", LAWS, ids=["neo-hookean", "mooney-rivlin"])
@pytest.mark.parametrize(
    ("part", "whole"),
    [
        ("quarter disc", "disc"),
        ("octant", "sphere"),
        ("quarter ring", "ring"),
        ("axisymmetric disc", "disc"),
        ("axisymmetric sphere", "sphere"),
    ],
)
def test_a_part_counts_for_the_whole(part: str, whole: str, law: Law) -> None:
    """Stretched to (1.3, 1.3, 0.8) times itself a mirrored part, or a meridian, has the energy of the whole body."""
    values = []
    for name in (part, whole):
        domain = body(name, size=0.3, order=4)
        form, u, free = energy_form(domain, law)
        place = domain.reduction.position
        across = (0.3,) if domain.reduction.name == "axisymmetric" else (0.3, 0.3)
        up = () if domain.reduction.name == "plane-strain" else (-0.2,)
        factors = (*across, *up)
        set_on_shell(u, CF(tuple(factor * place[i] for i, factor in enumerate(factors))), free, domain)
        values.append(form.Energy(u.vec))
    assert values[0] == pytest.approx(values[1], rel=1e-6)
    assert values[1] > 0.1
