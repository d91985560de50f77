"""Held tube: published numbers, radial quadrature, expansion in the thickness, the wrong formula."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from problems.exact import cylinder
from problems.exact.material import Law, mooney_rivlin, neo_hookean

RATIOS = (0.1, 0.05, 0.01)


def radial_quadrature(stretch: float, thickness_ratio: float, law: Law, axial: float) -> float:
    """Integral of (sigma_tt - sigma_rr) / r over the deformed wall, by adaptive quadrature."""
    constant = axial * stretch**2 - 1.0

    def integrand(reference: float) -> float:
        radius = math.sqrt((reference**2 + constant) / axial)
        radial = reference / (axial * radius)
        return law.stress_difference(radius / reference, radial) / radius * radial

    half = 0.5 * thickness_ratio
    return float(quad(integrand, 1.0 - half, 1.0 + half, epsabs=1e-13, epsrel=1e-13)[0])


def test_published_numbers() -> None:
    exact = [cylinder.thick_pressure(1.5, t) for t in RATIOS]
    membrane = [cylinder.membrane_pressure(1.5, t) for t in RATIOS]
    printed = [cylinder.printed_pressure(1.5, t) for t in RATIOS]
    assert exact == pytest.approx([0.0803443734081, 0.0401356294906, 0.00802478871465], rel=1e-11)
    assert membrane == pytest.approx([0.0802469135802, 0.0401234567901, 0.00802469135802], rel=1e-11)
    assert printed == pytest.approx([0.0540990428631, 0.0268984067867, 0.00535574506653], rel=1e-11)


@pytest.mark.parametrize("law", [neo_hookean(2.0), mooney_rivlin(0.4, 0.1)])
@pytest.mark.parametrize("axial", [0.8, 1.0, 1.3])
@pytest.mark.parametrize("stretch", [0.95, 1.2, 2.5])
def test_thick_tube_is_the_radial_integral(law: Law, axial: float, stretch: float) -> None:
    expected = radial_quadrature(stretch, 0.3, law, axial)
    assert cylinder.thick_pressure(stretch, 0.3, law, axial) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("law", [neo_hookean(), mooney_rivlin(0.4, 0.1)])
def test_membrane_is_the_second_order_limit(law: Law) -> None:
    def error(t: float) -> float:
        return cylinder.membrane_pressure(1.4, t, law, 1.2) / cylinder.thick_pressure(1.4, t, law, 1.2) - 1.0

    assert math.log2(error(0.1) / error(0.05)) == pytest.approx(2.0, abs=0.01)


def test_thickness_cubed_coefficient() -> None:
    x = 1.5
    expected = (x**2 - 1.0) * (x**2 + 3.0) * (x**4 - 2.0 * x**2 + 4.0) / (12.0 * x**8)
    t = 0.02
    found = (cylinder.thick_pressure(x, t) - cylinder.membrane_pressure(x, t)) / t**3
    assert found == pytest.approx(expected, rel=1e-3)
    left = [cylinder.thick_pressure(x, t) - cylinder.bending_pressure(x, t) for t in (0.2, 0.1)]
    assert math.log2(left[0] / left[1]) == pytest.approx(5.0, abs=0.02)


def test_no_limit_point_and_supremum() -> None:
    t = 0.2
    values = [cylinder.thick_pressure(1.0 + 0.05 * i, t) for i in range(1000)]
    assert all(a < b for a, b in zip(values, values[1:], strict=False))
    supremum = math.log((1.0 + 0.5 * t) / (1.0 - 0.5 * t))
    assert cylinder.thick_pressure(1e4, t) == pytest.approx(supremum, rel=1e-7)
    with pytest.raises(ValueError, match="no root"):
        cylinder.thick_stretch(1.001 * supremum, t)


@pytest.mark.parametrize("pressure", [-0.3, 0.0, 0.05])
@pytest.mark.parametrize("axial", [0.9, 1.2])
def test_inverses(pressure: float, axial: float) -> None:
    thick = cylinder.thick_stretch(pressure, 0.1, None, axial)
    assert cylinder.thick_pressure(thick, 0.1, None, axial) == pytest.approx(pressure, abs=1e-13)
    membrane = cylinder.membrane_stretch(pressure, 0.1, None, axial)
    assert cylinder.membrane_pressure(membrane, 0.1, None, axial) == pytest.approx(pressure, abs=1e-13)


@pytest.mark.parametrize("stretch", [0.9, 1.0, 1.6])
def test_slopes(stretch: float) -> None:
    law, step = mooney_rivlin(0.4, 0.1), 1e-5
    for curve, slope in (
        (cylinder.membrane_pressure, cylinder.membrane_slope),
        (cylinder.thick_pressure, cylinder.thick_slope),
    ):
        difference = (curve(stretch + step, 0.2, law) - curve(stretch - step, 0.2, law)) / (2.0 * step)
        assert slope(stretch, 0.2, law) == pytest.approx(difference, abs=1e-8)


def test_published_loads_depend_on_the_outer_pressure() -> None:
    """Impossible for a closed incompressible wall, and of the order of the thickness."""
    t = 0.05
    shift = cylinder.as_published_pressure(1.5, t, 1.0) - cylinder.as_published_pressure(1.5, t, 0.0)
    assert shift / t == pytest.approx((1.0 - 1.0 / 1.5) / 1.5, rel=0.02)
    printed = cylinder.printed_pressure(1.5, t, 1.0) - cylinder.printed_pressure(1.5, t, 0.0)
    assert printed == pytest.approx(-shift)
    # The printed formula is the weak form's with the elastic term divided by the stretch.
    assert cylinder.printed_pressure(1.5, t) == pytest.approx(cylinder.as_published_pressure(1.5, t) / 1.5)


def test_closed_bore_is_refused() -> None:
    with pytest.raises(ValueError, match="bore is closed"):
        cylinder.thick_pressure(0.1, 0.1)
