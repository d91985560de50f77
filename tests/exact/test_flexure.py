"""Rivlin's bent block: published numbers, equilibrium by quadrature, derivative of the energy, thin expansion."""

from __future__ import annotations

import math

import pytest

from problems.exact import flexure
from problems.exact.material import Gent, Law, Ogden, mooney_rivlin, neo_hookean

LAWS = [neo_hookean(2.0), mooney_rivlin(0.3, 0.2), Gent(1.0, 20.0), Ogden((1.2, -0.1), (2.0, -2.0))]


def test_published_numbers() -> None:
    assert flexure.mid_stretch(0.5) == pytest.approx(1.05737126344, abs=1e-11)
    assert flexure.moment(0.5) == pytest.approx(0.155610338631, abs=1e-12)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("curvature", [0.02, 0.5, 1.5])
def test_moment_is_the_derivative_of_the_energy(law: Law, curvature: float) -> None:
    step = 1e-4
    rate = (flexure.energy(curvature + step, law) - flexure.energy(curvature - step, law)) / (2.0 * step)
    assert flexure.moment(curvature, law) == pytest.approx(rate, abs=1e-7)
    assert flexure.moment_by_quadrature(curvature, law) == pytest.approx(flexure.moment(curvature, law), abs=1e-12)


@pytest.mark.parametrize("curvature", [0.1, 2.0])
def test_volume_and_stretches(curvature: float) -> None:
    """Radii r = s / c of the faces: the sector per undeformed length has the area T."""
    inner, outer = (s / curvature for s in flexure.face_stretches(curvature))
    assert 0.5 * curvature * (outer**2 - inner**2) == pytest.approx(1.0, abs=1e-12)
    middle = math.sqrt(0.5 * (inner**2 + outer**2))  # half the area on either side
    assert flexure.mid_radius(curvature) == pytest.approx(middle, abs=1e-12)


def test_thin_expansion() -> None:
    for t in (0.1, 0.05):
        assert 1.0 - flexure.moment(t) / flexure.thin_moment(t) == pytest.approx(0.3 * t**2, rel=0.6 * t**2)
        assert flexure.mid_stretch(t) - 1.0 == pytest.approx(0.25 * t**2, rel=t**2)
