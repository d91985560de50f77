"""Tube and cylinder beside a line current, and tube around one: images, tractions, energies."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from problems.exact.line_current import TubeBesideCurrent, saturating, squeeze
from problems.exact.permeable_cylinder import PermeableCylinder

TUBE = TubeBesideCurrent(0.8, 1.0, 10.0, 1.7, 2.0, 0.5)


def wire(x: float, y: float, place: float, current: float) -> tuple[float, float]:
    """Biot and Savart: H of a current along z at (place, 0)."""
    square = (x - place) ** 2 + y**2
    return -current * y / (2.0 * math.pi * square), current * (x - place) / (2.0 * math.pi * square)


def polar(field: tuple[float, float], angle: float) -> tuple[float, float]:
    c, s = math.cos(angle), math.sin(angle)
    return c * field[0] + s * field[1], c * field[1] - s * field[0]


def test_solid_cylinder_by_images() -> None:
    mu, b, c, current = 5.0, 0.9, 1.6, 2.0
    solid = TubeBesideCurrent(0.0, b, mu, c, current)
    k = (mu - 1.0) / (mu + 1.0)
    for radius, angle in ((0.9, 0.4), (1.2, 2.0)):
        x, y = radius * math.cos(angle), radius * math.sin(angle)
        parts = [wire(x, y, c, current), wire(x, y, b**2 / c, k * current), wire(x, y, 0.0, -k * current)]
        field = polar((sum(p[0] for p in parts), sum(p[1] for p in parts)), angle)
        assert solid.field_at(radius, angle) == pytest.approx(field, rel=1e-11)
    force = k * current**2 / (2.0 * math.pi) * (1.0 / (c - b**2 / c) - 1.0 / c)
    assert solid.force == pytest.approx(force, rel=1e-13)


def test_force_is_that_of_the_tractions() -> None:
    """Maxwell's stress over the outer face, the component towards the wire."""

    def towards(angle: float) -> float:
        normal, along = TUBE.field_at(1.0, angle)
        push = 0.5 * TUBE.permeability * (normal**2 - along**2)
        shear = TUBE.permeability * normal * along
        return push * math.cos(angle) - shear * math.sin(angle)

    force = 2.0 * quad(towards, 0.0, math.pi, epsabs=1e-13)[0]
    assert TUBE.force == pytest.approx(force, rel=1e-10)


def test_far_wire_is_a_uniform_field() -> None:
    """H0 = I / (2 pi c) across the line to the wire; the force that of the gradient on the moment."""
    far = TubeBesideCurrent(0.8, 1.0, 10.0, 1e4)
    h0 = 1.0 / (2.0 * math.pi * 1e4)
    uniform = PermeableCylinder(0.8, 1.0, 10.0, h0)
    angle = 0.7
    for radius in (0.5, 1.0):
        # The applied field points along -y: the polar angle from it is angle + pi/2.
        assert far.field_at(radius, angle) == pytest.approx(uniform.field_at(radius, angle + 0.5 * math.pi), rel=2e-3)
    assert far.force == pytest.approx(uniform.moment * h0 / 1e4, rel=1e-6)


def test_limits() -> None:
    assert TubeBesideCurrent(0.8, 1.0, 1.0, 1.7).force == 0.0
    thin = TubeBesideCurrent(1.0 - 1e-6, 1.0, 10.0, 1.7).force
    assert 0.0 < thin < 1e-4
    vacuum = TubeBesideCurrent(0.8, 1.0, 1.0, 1.7, 2.0)
    x, y = 0.5 * math.cos(0.4), 0.5 * math.sin(0.4)
    assert vacuum.field_at(2.5, 0.4) == pytest.approx(polar(wire(5.0 * x, 5.0 * y, 1.7, 2.0), 0.4), rel=1e-12)
    assert vacuum.field_at(0.5, 0.4) == pytest.approx(polar(wire(x, y, 1.7, 2.0), 0.4), rel=1e-12)
    with pytest.raises(ValueError, match="distance"):
        TubeBesideCurrent(0.8, 1.0, 2.0, 0.9)
    with pytest.raises(ValueError, match="within the wall"):
        TUBE.field_at(0.9, 0.0)


@pytest.mark.parametrize("saturation", [0.05, 100.0])
def test_tube_around_a_current(saturation: float) -> None:
    """The squeeze is the change of the co-energy of the magnetisation as the tube grows at constant area."""
    current, chi, mu0 = 3.0, 4.0, 0.5
    law = saturating(chi, saturation)

    def coenergy(field: float) -> float:  # integral of M over H; ln cosh without overflow
        x = chi * field / saturation
        return saturation**2 / chi * (x + math.log1p(math.exp(-2.0 * x)) - math.log(2.0))

    def ring(radius: float) -> float:
        return coenergy(current / (2.0 * math.pi * radius)) * 2.0 * math.pi * radius

    def energy(inner: float) -> float:
        outer = math.sqrt(inner**2 + 0.44)
        return -mu0 * quad(ring, inner, outer, epsrel=1e-13)[0]

    step = 1e-4
    slope = (energy(1.0 + step) - energy(1.0 - step)) / (2.0 * step)
    assert squeeze(1.0, 1.2, current, law, mu0) * 2.0 * math.pi == pytest.approx(slope, rel=1e-6)


def test_small_fields_are_linear() -> None:
    fields = [1e-3 / (2.0 * math.pi * r) for r in (1.0, 1.2)]
    linear = 0.5 * 4.0 * (fields[0] ** 2 - fields[1] ** 2)
    assert squeeze(1.0, 1.2, 1e-3, saturating(4.0, 1.0)) == pytest.approx(linear, rel=1e-6)
