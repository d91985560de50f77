"""Permeable shells in a uniform field: published numbers, interface conditions, energy."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from scipy.integrate import dblquad, quad

from problems.exact.permeable_cylinder import PermeableCylinder, permeable_cylinder
from problems.exact.permeable_sphere import PermeableSphere, permeable_sphere
from problems.exact.three_regions import ThreeRegions

BODIES: list[ThreeRegions] = [
    PermeableSphere(0.8, 1.3, 10.0, 2.0, 3.0),
    PermeableSphere(0.95, 1.05, 0.2),
    PermeableCylinder(0.8, 1.3, 10.0, 2.0, 3.0),
    PermeableCylinder(0.95, 1.05, 0.2),
]


def test_published_inner_fields() -> None:
    sphere = [permeable_sphere(t, 10.0).inner_field for t in (0.1, 0.05, 0.01)]
    assert sphere == pytest.approx([0.681727838876, 0.799504898811, 0.949488650510], abs=1e-12)
    tube = [permeable_cylinder(t, 10.0).inner_field for t in (0.1, 0.05, 0.01)]
    assert tube == pytest.approx([0.731343283582, 0.838403990025, 0.961447847505], abs=1e-12)


@pytest.mark.parametrize(
    ("mu", "wall", "sphere", "dipole", "tube"),
    [
        (2.0, 0.05, 0.9843999945, 0.03900001367, 0.9879592467),
        (10.0, 0.1, 0.6721333513, 0.3825110902, 0.722152013),
        (1e3, 0.01, 0.1318039093, 0.8694996885, 0.1676430484),
        (1e4, 0.2, 0.0009214657192, 0.999228411, 0.001110099676),
    ],
)
def test_published_shielding(mu: float, wall: float, sphere: float, dipole: float, tube: float) -> None:
    """J. D. Jackson, Classical Electrodynamics, eqs. 5.121 and 5.122, at the wall over the outer radius."""
    shell = PermeableSphere(1.0 - wall, 1.0, mu)
    assert (shell.inner_field, shell.coefficients.dipole) == pytest.approx((sphere, dipole), rel=1e-9)
    assert PermeableCylinder(1.0 - wall, 1.0, mu).inner_field == pytest.approx(tube, rel=1e-9)


def test_published_tractions() -> None:
    expected = (-0.660383808191, -0.547782059023, 0.0, 0.232376423150)
    assert tuple(permeable_sphere(0.1, 10.0).tractions(0.25 * math.pi)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("mu", [0.1, 2.0, 1e3, 1e6])
def test_closed_form_of_the_inner_field(mu: float) -> None:
    sphere, tube = permeable_sphere(0.1, mu), permeable_cylinder(0.1, mu)
    ratio = sphere.inner_radius / sphere.outer_radius
    shield = 9.0 * mu / ((2.0 * mu + 1.0) * (mu + 2.0) - 2.0 * ratio**3 * (mu - 1.0) ** 2)
    assert sphere.inner_field == pytest.approx(shield, rel=1e-9)
    shield = 4.0 * mu / ((mu + 1.0) ** 2 - ratio**2 * (mu - 1.0) ** 2)
    assert tube.inner_field == pytest.approx(shield, rel=1e-9)


@pytest.mark.parametrize("body", BODIES)
def test_interface_conditions(body: ThreeRegions) -> None:
    angle, offset = 0.7, 1e-9
    for face, sign in ((body.inner_radius, 1.0), (body.outer_radius, -1.0)):
        vacuum = body.field_at(face, angle)
        inside = body.field_at(face + sign * offset, angle)
        assert body.relative_permeability * inside[0] == pytest.approx(vacuum[0], rel=1e-7)
        assert inside[1] == pytest.approx(vacuum[1], rel=1e-7)
        assert body.potential(face + sign * offset, angle) == pytest.approx(
            body.potential(face, angle), rel=1e-7
        )


@pytest.mark.parametrize("body", BODIES)
def test_field_is_the_gradient_of_the_potential(body: ThreeRegions) -> None:
    angle, step = 0.7, 1e-5
    for radius in (0.5, 1.0, 2.0):
        radial = (body.potential(radius - step, angle) - body.potential(radius + step, angle)) / (2.0 * step)
        around = (body.potential(radius, angle - step) - body.potential(radius, angle + step)) / (2.0 * step)
        assert body.field_at(radius, angle) == pytest.approx((radial, around / radius), abs=1e-8)


@pytest.mark.parametrize("body", BODIES)
def test_energy_is_that_of_the_magnetisation(body: ThreeRegions) -> None:
    """-mu0/2 times the integral of M . H0 over the shell, with M = (mu_r - 1) H, by quadrature."""

    def density(radius: float, angle: float) -> float:
        radial, around = body.field_at(radius, angle)
        along = radial * math.cos(angle) - around * math.sin(angle)
        weight = 2.0 * math.pi * radius**2 * math.sin(angle) if body.dimension == 3 else 2.0 * radius
        return (body.relative_permeability - 1.0) * along * body.applied_field * weight

    total, _ = dblquad(
        lambda r, angle: density(r, angle), 0.0, math.pi, body.inner_radius, body.outer_radius, epsabs=1e-10
    )
    assert body.energy_change == pytest.approx(-0.5 * body.permeability * total, rel=1e-8)


@pytest.mark.parametrize("body", BODIES)
def test_energy_falls_by_the_work_of_the_tractions(body: ThreeRegions) -> None:
    """Grow the outer face: the work of both sides' Maxwell stress is minus the energy's change."""
    step = 1e-5
    mu = body.permeability * body.relative_permeability

    def pressure_of_solid(angle: float) -> float:
        normal, tangential = body.field_at(body.outer_radius - 1e-12, angle)
        return 0.5 * mu * (tangential**2 - normal**2)

    def work(angle: float) -> float:
        weight = (
            2.0 * math.pi * body.outer_radius**2 * math.sin(angle)
            if body.dimension == 3
            else 2.0 * body.outer_radius
        )
        return (pressure_of_solid(angle) - body.tractions(angle).p_t) * weight

    grown = replace(body, outer_radius=body.outer_radius + step).energy_change
    shrunk = replace(body, outer_radius=body.outer_radius - step).energy_change
    force = float(quad(work, 0.0, math.pi)[0])
    assert -(grown - shrunk) / (2.0 * step) == pytest.approx(force, rel=1e-6)


def test_limits() -> None:
    vacuum = permeable_sphere(0.1, 1.0)
    assert vacuum.energy_change == pytest.approx(0.0, abs=1e-14)
    angle = 0.4
    top = vacuum.tractions(angle)
    assert (top.p_t, top.tau_t) == pytest.approx((top.p_b, -top.tau_b), abs=1e-14)
    # An ideal body: field 3 H0 cos(theta) (2 in the plane) normal to the face, no field inside.
    ideal = permeable_sphere(0.1, 1e12).tractions(angle)
    assert tuple(ideal) == pytest.approx((-4.5 * math.cos(angle) ** 2, 0.0, 0.0, 0.0), abs=1e-9)
    ideal = permeable_cylinder(0.1, 1e12).tractions(angle)
    assert tuple(ideal) == pytest.approx((-2.0 * math.cos(angle) ** 2, 0.0, 0.0, 0.0), abs=1e-9)


def test_bad_radii_are_refused() -> None:
    with pytest.raises(ValueError, match="inner_radius"):
        PermeableSphere(1.0, 0.9, 2.0)
