"""Plate under traction and squeezed, against published numbers and the derivative of the energy."""

from __future__ import annotations

import pytest

from problems.exact import plate
from problems.exact.material import Law, mooney_rivlin, neo_hookean

LAWS = [neo_hookean(), neo_hookean(2.5), mooney_rivlin(0.4, 0.1)]


def energy(law: Law, a: float, b: float) -> float:
    """Strain energy at in-plane stretches a and b, from the two invariants."""
    c = 1.0 / (a * b)
    return law.c1 * (a**2 + b**2 + c**2 - 3.0) + law.c2 * (a**-2 + b**-2 + c**-2 - 3.0)


def test_published_numbers() -> None:
    assert plate.traction(1.5) == pytest.approx(1.05555555556, abs=1e-11)
    assert plate.squeeze(1.5) == pytest.approx(2.05246913580, abs=1e-11)
    assert plate.squeeze_stretch(1.0) == pytest.approx(1.21060779441, abs=1e-11)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("stretch", [0.6, 1.0, 1.7, 4.0])
def test_loads_are_derivatives_of_the_energy(law: Law, stretch: float) -> None:
    step = 1e-5
    along = (
        energy(law, stretch + step, (stretch + step) ** -0.5)
        - energy(law, stretch - step, (stretch - step) ** -0.5)
    ) / (2.0 * step)
    assert plate.traction(stretch, law) == pytest.approx(along, abs=1e-7)
    # The faces close at the rate of the thickness stretch: dW = -p d(thickness) * area = 2 p dl / l.
    both = (energy(law, stretch + step, stretch + step) - energy(law, stretch - step, stretch - step)) / (
        2.0 * step
    )
    assert plate.squeeze(stretch, law) == pytest.approx(0.5 * stretch * both, abs=1e-6)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("load", [-0.7, 0.0, 0.01, 3.0])
def test_inverses(law: Law, load: float) -> None:
    assert plate.traction(plate.traction_stretch(load, law), law) == pytest.approx(load, abs=1e-12)
    assert plate.squeeze(plate.squeeze_stretch(load, law), law) == pytest.approx(load, abs=1e-12)


def test_small_strain_modulus() -> None:
    law = mooney_rivlin(0.3, 0.2)
    strain = 1e-6
    assert plate.traction(1.0 + strain, law) / strain == pytest.approx(3.0 * law.shear_modulus, rel=1e-5)
    assert plate.squeeze(1.0 + strain, law) / strain == pytest.approx(6.0 * law.shear_modulus, rel=1e-5)
