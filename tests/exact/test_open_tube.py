"""Open tube with traction-free ends: published numbers, force by quadrature, second-order shell theory."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from problems.exact import open_tube
from problems.exact.material import Law, mooney_rivlin, neo_hookean


def test_published_numbers() -> None:
    assert open_tube.exact_stretches(0.32, 0.30, 0.05) == pytest.approx(
        (1.12584343758, 1.02785287441), abs=1e-11
    )
    assert open_tube.membrane_stretches(0.32, 0.30, 0.05) == pytest.approx(
        (1.12597148741, 1.02788434775), abs=1e-11
    )


@pytest.mark.parametrize("law", [neo_hookean(), mooney_rivlin(0.35, 0.15)])
@pytest.mark.parametrize(("hoop", "axial"), [(1.2, 1.05), (0.9, 1.3), (1.6, 0.8)])
def test_ends_carry_no_force(law: Law, hoop: float, axial: float) -> None:
    """Radial stress by quadrature from the outside in, then the axial stress over the section."""
    t = 0.3
    inner_pressure, outer_pressure = open_tube.exact_pressures(hoop, axial, t, law)
    constant = axial * hoop**2 - 1.0

    def radius(reference: float) -> float:
        return math.sqrt((reference**2 + constant) / axial)

    def drop(reference: float) -> float:
        radial = reference / (axial * radius(reference))
        return law.stress_difference(radius(reference) / reference, radial) / radius(reference) * radial

    def axial_stress(reference: float) -> float:
        radial_stress = -outer_pressure - float(quad(drop, reference, 1.0 + 0.5 * t)[0])
        radial = reference / (axial * radius(reference))
        return (radial_stress + law.stress_difference(axial, radial)) * reference / axial

    force = float(quad(axial_stress, 1.0 - 0.5 * t, 1.0 + 0.5 * t, epsabs=1e-12)[0])
    assert force == pytest.approx(0.0, abs=1e-12)
    assert inner_pressure - outer_pressure == pytest.approx(
        float(quad(drop, 1.0 - 0.5 * t, 1.0 + 0.5 * t)[0]), abs=1e-12
    )


def test_shell_theory_is_second_order() -> None:
    def error(t: float) -> float:
        exact = open_tube.exact_stretches(0.30 + 0.4 * t, 0.30, t)
        shell = open_tube.membrane_stretches(0.30 + 0.4 * t, 0.30, t)
        return max(abs(a - b) for a, b in zip(exact, shell, strict=True))

    assert math.log2(error(0.1) / error(0.05)) == pytest.approx(2.0, abs=0.1)
    assert math.log2(error(0.05) / error(0.025)) == pytest.approx(2.0, abs=0.05)


def test_equal_pressures_give_homogeneous_lengthening() -> None:
    """Hoop and radial stretch agree; axial minus lateral stress is the pressure, in both theories."""
    for stretches in (open_tube.exact_stretches, open_tube.membrane_stretches):
        hoop, axial = stretches(0.5, 0.5, 0.2)
        assert hoop == pytest.approx(axial**-0.5, abs=1e-11)
        assert axial**2 - 1.0 / axial == pytest.approx(0.5, abs=1e-11)


def test_unreachable_load_is_refused() -> None:
    with pytest.raises(ValueError, match="no equilibrium"):
        open_tube.exact_stretches(5.0, 0.0, 0.05)
