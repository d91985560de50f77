"""Spherical balloon: published limit points, radial quadrature, expansion in the thickness."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from problems.exact import sphere
from problems.exact.material import Law, mooney_rivlin, neo_hookean

LAWS = [neo_hookean(2.0), mooney_rivlin(0.4, 0.1)]


def test_neo_hookean_limit_points() -> None:
    (membrane,) = sphere.limit_points(1.0, theory="membrane")
    assert membrane == pytest.approx((7.0 ** (1.0 / 6.0), 1.23946290240), abs=1e-11)
    expected = {
        0.1: (1.38257631232, 0.123909774798),
        0.05: (1.38295979619, 0.0619685737157),
        0.01: (1.38308244461, 0.0123945924349),
    }
    for ratio, point in expected.items():
        (found,) = sphere.limit_points(ratio)
        assert found == pytest.approx(point, abs=1e-11)


def test_mooney_rivlin_limit_points() -> None:
    """c2 / c1 = 0.1, scaled to shear modulus 1: a maximum, then a minimum."""
    law = mooney_rivlin(0.5 / 1.1, 0.05 / 1.1)
    maximum, minimum = sphere.limit_points(1.0, law, theory="membrane")
    assert maximum == pytest.approx((1.47606984746, 1.35510686880), abs=1e-11)
    assert minimum == pytest.approx((3.14262133321, 1.14874772529), abs=1e-11)
    thick = sphere.limit_points(0.02, law)
    assert [p.stretch for p in thick] == pytest.approx([maximum.stretch, minimum.stretch], abs=1e-3)


def test_stiff_mooney_rivlin_has_no_limit_point() -> None:
    law = mooney_rivlin(0.3, 0.2)
    assert sphere.limit_points(0.1, law) == ()
    assert sphere.thick_pressure(sphere.stretch_at(0.5, 0.1, law), 0.1, law) == pytest.approx(0.5, abs=1e-13)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("stretch", [0.97, 1.1, 2.0, 5.0])
def test_thick_sphere_is_the_radial_integral(law: Law, stretch: float) -> None:
    """Integral of 2 (sigma_tt - sigma_rr) / r over the deformed wall."""
    constant = stretch**3 - 1.0

    def integrand(reference: float) -> float:
        radius = math.cbrt(reference**3 + constant)
        radial = (reference / radius) ** 2
        return 2.0 * law.stress_difference(radius / reference, radial) / radius * radial

    expected = float(quad(integrand, 0.8, 1.2, epsabs=1e-13, epsrel=1e-13)[0])
    assert sphere.thick_pressure(stretch, 0.4, law) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("stretch", [0.9, 1.0, 1.6])
def test_slopes(law: Law, stretch: float) -> None:
    step = 1e-5
    for curve, slope in sphere.PRESSURES.values():
        difference = (curve(stretch + step, 0.2, law) - curve(stretch - step, 0.2, law)) / (2.0 * step)
        assert slope(stretch, 0.2, law) == pytest.approx(difference, rel=1e-7)


def test_thickness_cubed_coefficient() -> None:
    x, t = 1.5, 0.02
    expected = -(x**3 - 1.0) * (x**6 + 14.0 * x**3 - 35.0) / (6.0 * x**13)
    assert expected == pytest.approx(-0.0481, abs=1e-4)
    found = (sphere.thick_pressure(x, t) - sphere.membrane_pressure(x, t)) / t**3
    assert found == pytest.approx(expected, rel=2e-3)
    left = [sphere.thick_pressure(x, t) - sphere.bending_pressure(x, t) for t in (0.2, 0.1)]
    assert math.log2(left[0] / left[1]) == pytest.approx(5.0, abs=0.02)


@pytest.mark.parametrize("theory", ["membrane", "thick"])
@pytest.mark.parametrize("pressure", [-0.9, -0.01, 0.0, 0.01, 0.12])
def test_inverse(theory: sphere.Theory, pressure: float) -> None:
    stretch = sphere.stretch_at(pressure, 0.1, None, theory)
    assert stretch < 7.0 ** (1.0 / 6.0)
    assert sphere.PRESSURES[theory][0](stretch, 0.1, None) == pytest.approx(pressure, abs=1e-12)


def test_pressure_beyond_the_limit_is_refused() -> None:
    with pytest.raises(ValueError, match="exceeds the limit"):
        sphere.stretch_at(0.13, 0.1)
    with pytest.raises(ValueError, match="cavity is closed"):
        sphere.thick_pressure(0.1, 0.1)


def test_published_loads_depend_on_the_outer_pressure() -> None:
    t, stretch = 0.05, 1.2
    shift = sphere.as_published_pressure(stretch, t, 1.0) - sphere.as_published_pressure(stretch, t)
    assert shift / t == pytest.approx(2.0 * (1.0 - 1.0 / stretch) / stretch**2, rel=0.01)


def test_mid_stretch_inverts_the_face_stretches() -> None:
    inner, outer = sphere.face_stretches(1.7, 0.2)
    assert sphere.mid_stretch(inner, 0.2) == pytest.approx(1.7, abs=1e-14)
    assert math.prod((inner, outer)) > 1.0 and outer < 1.7 < inner
