"""Remanent shells, saturated shells, sheets magnetised along their normal."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from scipy.integrate import quad

from problems.exact import magnetised_shell, magnetised_strip
from problems.exact.permeable_cylinder import PermeableCylinder
from problems.exact.permeable_sphere import PermeableSphere
from problems.exact.three_regions import ThreeRegions

BODIES: list[ThreeRegions] = [
    PermeableSphere(0.8, 1.3, 3.0, 2.0, 1.5, 0.7),
    PermeableSphere(0.9, 1.1, 1.0, 0.0, 1.0, 1.0),
    PermeableCylinder(0.8, 1.3, 3.0, 2.0, 1.5, 0.7),
    PermeableCylinder(0.9, 1.1, 1.0, -0.5, 1.0, 1.0),
]


@pytest.mark.parametrize("kind", [magnetised_shell.magnetised_sphere, magnetised_shell.magnetised_tube])
def test_uniformly_magnetised(kind: object) -> None:
    """mu_r = 1: no field in the cavity, moment M times volume. mu_r > 1: a field of first order in T/R."""
    shell = kind(0.2)  # type: ignore[operator]
    assert shell.inner_field == pytest.approx(0.0, abs=1e-15)
    volume = 4.0 / 3.0 * math.pi * (1.1**3 - 0.9**3) if shell.dimension == 3 else math.pi * (1.1**2 - 0.9**2)
    assert shell.moment == pytest.approx(volume, rel=1e-13)
    thick, thin = (kind(ratio, 1.5).inner_field for ratio in (0.002, 0.001))  # type: ignore[operator]
    assert thin < 0.0 or thin > 0.0
    assert thick / thin == pytest.approx(2.0, rel=5e-3)


def test_solid_limit() -> None:
    """A vanishing cavity: H = -M/3 in a sphere, -M/2 in a cylinder (Jackson, sec. 5.10)."""
    sphere = PermeableSphere(1e-4, 1.0, 1.0, 0.0, 1.0, 1.0)
    assert sphere.coefficients.shell_uniform == pytest.approx(-1.0 / 3.0, abs=1e-11)
    tube = PermeableCylinder(1e-6, 1.0, 1.0, 0.0, 1.0, 1.0)
    assert tube.coefficients.shell_uniform == pytest.approx(-0.5, abs=1e-11)


@pytest.mark.parametrize("body", BODIES)
def test_interface_conditions(body: ThreeRegions) -> None:
    angle, offset = 0.7, 1e-9
    for face, sign in ((body.inner_radius, 1.0), (body.outer_radius, -1.0)):
        vacuum, inside = body.field_at(face, angle), body.field_at(face + sign * offset, angle)
        flux = body.permeability * body.relative_permeability * inside[0] + body.remanence * math.cos(angle)
        assert flux == pytest.approx(body.permeability * vacuum[0], abs=1e-7)
        assert inside[1] == pytest.approx(vacuum[1], abs=1e-7)


@pytest.mark.parametrize("body", BODIES)
def test_energy_falls_by_the_work_of_the_stresses(body: ThreeRegions) -> None:
    """Grow the outer face: sigma_nn = B_n H_n + w on both sides, w = -(mu H^2/2 + B_r . H) in the matter."""
    step, radius = 1e-5, body.outer_radius
    mu = body.permeability * body.relative_permeability

    def work(angle: float) -> float:
        normal, along = body.field_at(radius - 1e-12, angle)
        flux = mu * normal + body.remanence * math.cos(angle)
        remanent = body.remanence * (normal * math.cos(angle) - along * math.sin(angle))
        within = flux * normal - 0.5 * mu * (normal**2 + along**2) - remanent
        ring = 2.0 * math.pi * radius**2 * math.sin(angle) if body.dimension == 3 else 2.0 * radius
        return (-body.tractions(angle).p_t - within) * ring

    grown, shrunk = (replace(body, outer_radius=radius + sign * step).energy_change for sign in (1, -1))
    assert -(grown - shrunk) / (2.0 * step) == pytest.approx(quad(work, 0.0, math.pi)[0], rel=1e-6)


def test_saturated_sphere() -> None:
    """No field of its own in the cavity; the shell between the limits of small and of large fields."""
    shell = magnetised_shell.saturated_sphere(0.1, 0.3, 5.0)
    assert shell.inner_field == pytest.approx(5.0, abs=1e-13)
    assert shell.moment == pytest.approx(0.3 * 4.0 / 3.0 * math.pi * (1.05**3 - 0.95**3), rel=1e-12)


def test_normal_magnetisation() -> None:
    """A closed sheet: the field within times the thickness. An open one: a current around its rim."""
    assert magnetised_shell.potential_drop(0.02, 1.5, 3.0, 0.5) == pytest.approx(0.02)
    # The potential M T Omega / (4 pi) of the cap's solid angle, differentiated along the axis.
    strength, rim, step = 0.7, 0.6, 1e-5

    def potential(z: float) -> float:
        return 0.5 * strength * (1.0 - z / math.hypot(rim, z))

    slope = (potential(0.4 - step) - potential(0.4 + step)) / (2.0 * step)
    assert magnetised_shell.cap_field_on_axis(rim, 0.4, strength) == pytest.approx(slope, rel=1e-8)
    thin = magnetised_shell.disc_field_on_axis(rim, 1e-4, 0.4, strength / 1e-4)
    assert thin == pytest.approx(magnetised_shell.cap_field_on_axis(rim, 0.4, strength), rel=1e-6)
    assert magnetised_shell.disc_field_on_axis(1.0, 1e4, 0.0, 2.0) == pytest.approx(2.0, rel=1e-6)  # long magnet: B_r


def test_poles_at_the_ends_of_a_strip() -> None:
    """Ever narrower poles become two that attract each other, at the clamp and at the tip."""
    k = 0.5
    known = 3.0 * (1.0 - k / math.tan(k)) / k**2
    errors = [
        known - magnetised_strip.own_field(2.0 * math.pi * k**2, *magnetised_strip.fading(width))
        for width in (0.04, 0.02)
    ]
    assert 0.0 < errors[1] < 0.55 * errors[0] < 0.1 * (known - 1.0)
