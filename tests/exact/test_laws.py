"""The laws of the exact solutions: stresses against energies, and thick balloons of laws without a closed form."""

from __future__ import annotations

import math

import pytest

from problems.exact import plate, sphere
from problems.exact.material import Gent, Law, MooneyRivlin, Ogden, Yeoh

LAWS = [
    MooneyRivlin(0.4, 0.1),
    Yeoh(0.5, -0.02, 0.003),
    Gent(1.0, 20.0),
    Ogden((1.2, 0.01, -0.2), (1.3, 5.0, -2.0)),
]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("stretch", [0.8, 1.5])
def test_stresses_are_derivatives_of_the_energy(law: Law, stretch: float) -> None:
    step = 1e-6

    def slope(second: float) -> float:
        return (law.energy(stretch + step, second) - law.energy(stretch - step, second)) / (2 * step)

    assert plate.traction(stretch, law) == pytest.approx(slope(stretch**-0.5), rel=1e-8)
    assert plate.pure_shear_traction(stretch, law) == pytest.approx(slope(1.0), rel=1e-8)
    assert plate.equibiaxial_traction(stretch, law) == pytest.approx(slope(stretch), rel=1e-8)
    assert plate.squeeze(stretch, law) == pytest.approx(stretch * slope(stretch), rel=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_shear_moduli(law: Law) -> None:
    assert law.stress_difference(1 + 1e-6, 1 - 1e-6) == pytest.approx(4e-6 * law.shear_modulus, rel=1e-5)


def test_ogden_holds_mooney_and_rivlin() -> None:
    """Through the quadrature of `sphere`, against the closed form."""
    general, plain = Ogden((0.8, -0.2), (2.0, -2.0)), MooneyRivlin(0.4, 0.1)
    for stretch in (0.9, 1.0, 1.0 + 1e-7, 1.3, 3.0):
        for curves in sphere.PRESSURES.values():
            for curve in curves:
                assert curve(stretch, 0.2, general) == pytest.approx(curve(stretch, 0.2, plain), rel=1e-9, abs=1e-12)


def test_published_limit_points() -> None:
    """Gent with Jm = 97.2 per modulus; Ogden's rubber at R = 10 m, T = 0.1 m in Pa (Holzapfel 2000, example 6.3)."""
    maximum, minimum = sphere.limit_points(1.0, Gent(1.0, 97.2), "membrane")
    assert maximum == pytest.approx((1.39767326520, 1.25408146704), abs=1e-10)
    assert minimum == pytest.approx((4.08502297851, 0.712018906253), abs=1e-10)
    rubber = Ogden((0.63e6, 1200.0, -10e3), (1.3, 5.0, -2.0))
    maximum, minimum = sphere.limit_points(0.01, rubber, "membrane")
    # Published from the extreme load itself, hence to the root of rounding in the stretch.
    assert maximum == pytest.approx((1.374050289994588, 5494.123081698992), rel=1e-8)
    assert minimum == pytest.approx((4.3202827261645265, 2355.5287124964584), rel=1e-8)


def test_gent_locks() -> None:
    """No stress reaches I1 - 3 = Jm, and a root is found right below it."""
    law = Gent(1.0, 20.0)
    assert law.stress_difference(5.0, 5.0**-0.5) == math.inf
    assert law.stress_difference(5.0**-0.5, 5.0) == -math.inf
    stretch = plate.traction_stretch(1e6, law)
    assert stretch**2 + 2 / stretch - 3 == pytest.approx(20.0, rel=1e-4)
