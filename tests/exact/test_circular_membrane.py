"""Clamped circular membrane: published numbers, first variation of the energy, small-strain limit, inverses."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from problems.exact import circular_membrane as membrane
from problems.exact.hencky import hencky
from problems.exact.material import Gent, Law, mooney_rivlin, neo_hookean


@pytest.mark.parametrize(
    ("apex", "pressure", "deflection"),
    [
        (1.25, 1.17145201132, 0.58780437791),
        (1.5, 1.64358184076, 0.79878921307),
        (2.0, 1.86955474833, 1.08306716139),
    ],
)
def test_published_states(apex: float, pressure: float, deflection: float) -> None:
    found = membrane.state(apex)
    assert found.pressure == pytest.approx(pressure, abs=2e-11)
    assert found.deflection == pytest.approx(deflection, abs=2e-11)


def test_published_limit_and_rising_branch() -> None:
    limit = membrane.limit_state()
    assert limit is not None
    assert limit.pressure == pytest.approx(1.8791734688, abs=1e-10)
    assert (limit.apex_stretch, limit.deflection) == pytest.approx((2.19594, 1.17390), abs=1e-5)
    for pressure, deflection in ((0.5, 0.3742994187), (1.0, 0.5312142682), (1.5, 0.7190609262)):
        assert membrane.at_pressure(pressure).deflection == pytest.approx(deflection, abs=1e-10)


STIFF = pytest.param(Gent(1.0, 30.0), marks=pytest.mark.slow)


@pytest.mark.parametrize("law", [neo_hookean(2.0), mooney_rivlin(0.4, 0.1), STIFF])
def test_pressure_is_the_derivative_of_the_energy(law: Law) -> None:
    """dE = p dV along the path, E the integral of W over the disc: no use of the equilibrium equations."""

    def energy(apex: float) -> float:
        found = membrane.state(apex, law)

        def density(radius: float) -> float:
            meridional, hoop = found.stretches(radius)
            return 2.0 * math.pi * radius * law.energy(float(meridional[0]), float(hoop[0]))

        nodes, weights = np.polynomial.legendre.leggauss(24)
        total = sum(w * density(0.5 * (1.0 + x)) for x, w in zip(nodes, weights, strict=True))
        return 0.5 * float(total) / law.shear_modulus

    step = 1e-3
    high, low = membrane.state(1.6 + step, law), membrane.state(1.6 - step, law)
    work = (energy(1.6 + step) - energy(1.6 - step)) / (high.volume - low.volume)
    assert membrane.state(1.6, law).pressure == pytest.approx(work, rel=1e-6)


@pytest.mark.slow
def test_stiffer_laws_raise_or_remove_the_limit() -> None:
    soft = membrane.limit_state(mooney_rivlin(0.48, 0.02))
    assert soft is not None and soft.pressure > 1.8791734688
    assert membrane.limit_state(mooney_rivlin(0.4, 0.1), largest_stretch=5.0) is None


def test_small_strain_limit_is_hencky() -> None:
    """w/A = C (P/3)^(1/3) with E = 3 mu; the finite strain enters in proportion to the strain."""
    errors = []
    for strain in (2e-3, 1e-3):
        found = membrane.state(1.0 + strain)
        scaled = (found.pressure / 3.0) ** (1.0 / 3.0)
        errors.append(found.deflection / scaled - hencky(0.5).deflection)
        assert strain / scaled**2 == pytest.approx(hencky(0.5).strain, rel=5.0 * strain)
    assert abs(errors[1]) < 2e-3
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.01)


def test_inverses() -> None:
    found = membrane.state(2.5)
    assert membrane.at_deflection(found.deflection).apex_stretch == pytest.approx(2.5, abs=1e-10)
    assert membrane.at_volume(found.volume).pressure == pytest.approx(found.pressure, abs=1e-10)


def test_profile() -> None:
    found = membrane.state(2.0)
    radius, height = found.profile(np.linspace(0.0, 1.0, 5))
    assert (radius[0], height[0]) == pytest.approx((0.0, found.deflection), abs=1e-11)
    assert (radius[-1], height[-1]) == pytest.approx((1.0, 0.0), abs=1e-10)

    def ring(r: float) -> float:
        """Volume below the ring of particles at r: pi r^2 times the height lost, by parts 2 pi r z dr."""
        step = 1e-5
        (inner, outer), _ = found.profile([r - step, r + step])
        (here,), (z,) = found.profile(r)
        return 2.0 * math.pi * here * z * (outer - inner) / (2.0 * step)

    volume, _ = quad(ring, 2e-5, 1.0 - 2e-5, epsabs=1e-7, epsrel=1e-7)
    assert found.volume == pytest.approx(volume, abs=1e-6)


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match="must exceed 1"):
        membrane.state(1.0)
    with pytest.raises(ValueError, match="exceeds the limit"):
        membrane.at_pressure(1.9)
    with pytest.raises(ValueError, match="must be positive"):
        membrane.at_pressure(0.0)
