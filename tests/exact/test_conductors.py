"""Capacitances and forces of conductors: published numbers, limits, and other ways to compute them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipk

from problems.exact import capacitance, charged_disc, conducting_spheres

FOUR_PI = 4.0 * math.pi
Array = np.ndarray


def by_rings(curve: Array, inside: Array) -> float:
    """Capacitance of a body of revolution by charged rings within it that hold its surface at one volt.

    Points (n, 2) as (rho, z). The method of fundamental solutions (Fairweather and Karageorghis, 1998).
    """
    rho, z = (x[:, None] for x in curve.T)
    across, dz = (rho + inside[:, 0]) ** 2 + (z - inside[:, 1]) ** 2, 4.0 * rho * inside[:, 0]
    matrix = ellipk(dz / across) / (2.0 * math.pi**2 * np.sqrt(across))
    charges = np.linalg.lstsq(matrix, np.ones(len(curve)), rcond=1e-14)[0]
    assert np.abs(matrix @ charges - 1.0).max() < 1e-9
    return float(charges.sum())


def test_published_values() -> None:
    """Kelvin (1869), Smythe: C / (4 pi eps length), ten digits of the closed forms."""
    assert capacitance.disc(1.0) / FOUR_PI == pytest.approx(0.6366197724, abs=1e-10)
    for degrees, value in [(10, 0.1108294872), (45, 0.475079079), (90, 0.8183098862), (170, 0.9997183761), (180, 1.0)]:
        assert capacitance.spherical_cap(1.0, math.radians(degrees)) / FOUR_PI == pytest.approx(value, abs=1e-10)
    for polar, value in [(1.1, 1.033116245), (2.0, 1.315190722), (10.0, 3.32413418), (0.5, 0.8269933431)]:
        assert capacitance.spheroid(1.0, polar) / FOUR_PI == pytest.approx(value, abs=1e-9)
    assert capacitance.spheroid(1.0, 0.1) / FOUR_PI == pytest.approx(0.6765727461, abs=1e-10)


def test_limits() -> None:
    assert capacitance.spheroid(0.7, 1e-12) == pytest.approx(capacitance.disc(0.7), rel=1e-11)
    assert capacitance.spheroid(1.0, 1.0 + 1e-9) == pytest.approx(capacitance.sphere(1.0), rel=1e-8)
    assert capacitance.spheroid(1.0, 1.0, 2.0) == capacitance.sphere(1.0, 2.0)
    # A small flat cap is a disc of its rim; a shell in a far larger one is alone.
    assert capacitance.spherical_cap(1.0, 1e-3) == pytest.approx(capacitance.disc(math.sin(1e-3)), rel=1e-5)
    assert capacitance.concentric_spheres(1.0, 1e9) == pytest.approx(capacitance.sphere(1.0), rel=1e-8)
    assert capacitance.coaxial_cylinders(1.0, 1.0001) == pytest.approx(2.0 * math.pi * 1.00005 / 1e-4, rel=1e-8)


def test_torus() -> None:
    """Thin: 4 pi^2 eps R / ln(8 R / r). Fat: rings inside the tube."""
    thin = capacitance.torus(1.0, 1e-4)
    assert thin == pytest.approx(4.0 * math.pi**2 / math.log(8e4), rel=1e-6)
    turn = np.linspace(0.0, 2.0 * math.pi, 240, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    for tube in (0.2, 0.5, 0.7):
        found = by_rings(np.array([1.0, 0.0]) + tube * circle, np.array([1.0, 0.0]) + 0.5 * tube * circle[::3])
        assert capacitance.torus(1.0, tube) == pytest.approx(found, rel=1e-7)
    with pytest.raises(ValueError, match="ring_radius"):
        capacitance.torus(1.0, 1.0)


def test_parallel_discs() -> None:
    """Far apart half the disc alone; near by the expansion of Kirchhoff (1877), with the next term by Shaw (1970)."""
    far = capacitance.parallel_discs(1.0, 1e4)
    assert far == pytest.approx(4.0, rel=1e-4)
    gap = 0.05
    logarithm = math.log(16.0 * math.pi / gap)
    near = math.pi / gap + logarithm - 1.0 + gap / (4.0 * math.pi) * (logarithm**2 - 2.0)
    assert capacitance.parallel_discs(1.0, gap) == pytest.approx(near, rel=5e-5)
    fine = capacitance.parallel_discs(1.0, gap, points=800)
    assert capacitance.parallel_discs(1.0, gap) == pytest.approx(fine, rel=1e-12)


@pytest.mark.parametrize(
    ("distance", "own", "mutual", "plane"),
    [
        (2.01, 2.136670826, -1.442786042, 3.579456869),
        (2.5, 1.253022738, -0.5253734613, 1.7783962),
        (4.0, 1.071821452, -0.2692383611, 1.341059813),
        (10.0, 1.010205155, -0.1010309289, 1.111236084),
    ],
)
def test_two_equal_spheres(distance: float, own: float, mutual: float, plane: float) -> None:
    """The series of Maxwell and Kelvin."""
    found = conducting_spheres.two_spheres(1.0, 1.0, distance, 2.0)
    assert found.c11 / (2.0 * FOUR_PI) == pytest.approx(own, abs=1e-9)
    assert found.c22 == found.c11
    assert found.c12 / (2.0 * FOUR_PI) == pytest.approx(mutual, abs=1e-9)
    assert conducting_spheres.sphere_and_plane(1.0, 0.5 * distance) / FOUR_PI == pytest.approx(plane, abs=1e-9)


def test_two_unequal_spheres_by_successive_images() -> None:
    """Image charges one after the other, as Kelvin did, until they are nothing."""
    a, b, c = 1.0, 0.6, 1.9
    charge, place, on_a, on_b = a, 0.0, a, 0.0
    for _ in range(60):
        charge, place = -charge * b / (c - place), c - b**2 / (c - place)
        on_b += charge
        charge, place = -charge * a / place, a**2 / place
        on_a += charge
    found = conducting_spheres.two_spheres(a, b, c)
    assert (found.c11, found.c12) == pytest.approx((FOUR_PI * on_a, FOUR_PI * on_b), rel=1e-13)
    swapped = conducting_spheres.two_spheres(b, a, c)
    assert (swapped.c22, swapped.c12) == pytest.approx((found.c11, found.c12), rel=1e-13)


def test_force_between_spheres() -> None:
    """Far apart Coulomb's; near by differences of the coefficients."""
    a, b, far = 1.0, 0.5, 200.0
    coulomb = FOUR_PI * a * b / far**2
    assert conducting_spheres.repulsion(a, b, far, (1.0, 1.0)) == pytest.approx(coulomb, rel=1e-2)
    voltages, c, step = np.array([1.0, -0.3]), 1.7, 1e-5

    def energy(distance: float) -> float:
        c11, c12, c22 = conducting_spheres.two_spheres(a, b, distance)
        return float(0.5 * voltages @ np.array([[c11, c12], [c12, c22]]) @ voltages)

    slope = (energy(c + step) - energy(c - step)) / (2.0 * step)
    assert conducting_spheres.repulsion(a, b, c, (1.0, -0.3)) == pytest.approx(slope, rel=1e-8)


def test_force_to_a_plane() -> None:
    """Derivative of C V^2 / 2 with the height."""
    step, height = 1e-5, 1.3
    ends = [conducting_spheres.sphere_and_plane(1.0, height + sign * step, 2.0) for sign in (1, -1)]
    slope = 0.5 * 3.0**2 * (ends[0] - ends[1]) / (2.0 * step)
    assert conducting_spheres.attraction_to_plane(1.0, height, 3.0, 2.0) == pytest.approx(-slope, rel=1e-8)
    with pytest.raises(ValueError, match="touch"):
        conducting_spheres.sphere_and_plane(1.0, 1.0)


def test_hemispheres() -> None:
    """Kelvin: integrals of the pressure over one half; the whole sphere feels Q E0."""
    radius, field, voltage, eps = 0.7, 2.0, 3.0, 0.5
    charge = FOUR_PI * eps * radius * voltage

    def along(angle: float, e0: float, q: float) -> float:
        pull = conducting_spheres.sphere_pressure(angle, radius, e0, q, eps)
        return pull * math.cos(angle) * 2.0 * math.pi * radius**2 * math.sin(angle)

    half = quad(along, 0.0, 0.5 * math.pi, args=(0.0, charge))[0]
    assert conducting_spheres.charged_hemispheres(voltage, eps) == pytest.approx(half, rel=1e-12)
    assert half == pytest.approx(charge**2 / (32.0 * math.pi * eps * radius**2), rel=1e-12)
    half = quad(along, 0.0, 0.5 * math.pi, args=(field, 0.0))[0]
    assert conducting_spheres.hemispheres_in_field(radius, field, eps) == pytest.approx(half, rel=1e-12)
    assert quad(along, 0.0, math.pi, args=(field, charge))[0] == pytest.approx(charge * field, rel=1e-12)


def test_charged_disc() -> None:
    radius, voltage, eps = 0.7, 3.0, 2.0

    def ring(t: float) -> float:  # rho = R sin t: the root at the rim is gone
        rho = radius * math.sin(t)
        weight = 2.0 * math.pi * rho * radius * math.cos(t)
        return charged_disc.charge_density(rho, radius, voltage, eps) * weight

    total = quad(ring, 0.0, 0.5 * math.pi)[0]
    assert total == pytest.approx(capacitance.disc(radius, eps) * voltage, rel=1e-10)
    # Gauss: half the density on each side is eps times the slope of the potential there.
    step = 1e-7
    drop = (voltage - charged_disc.potential(0.3, step, radius, voltage)) / step
    assert 2.0 * eps * drop == pytest.approx(charged_disc.charge_density(0.3, radius, voltage, eps), rel=1e-6)
    assert charged_disc.potential(0.2, 0.0, radius, voltage) == voltage
    far = charged_disc.potential(300.0, 400.0, radius, voltage)
    assert far == pytest.approx(total / (FOUR_PI * eps * 500.0), rel=1e-5)
    # The rim's pull, as of a crack: a density k s^(-1/2) of both sides near the rim pulls with pi k^2 / (4 eps).
    near = 1e-8
    strength = charged_disc.charge_density(radius - near, radius, voltage, eps) * math.sqrt(near)
    assert charged_disc.edge_force(radius, voltage, eps) == pytest.approx(math.pi * strength**2 / (4.0 * eps), rel=1e-6)
    assert charged_disc.radial_force(voltage, eps) == 4.0 * eps * voltage**2


def square_by_panels(count: int) -> float:
    """Of the unit square, over 4 pi eps: charge constant on panels, potential 1 at their centres.

    Panels shrink with the cube of the distance from the edges. A quarter, each panel with its three mirror images.
    """
    ends = 1.0 - np.linspace(1.0, 0.0, count + 1) ** 3
    middle = (ends[1:] + ends[:-1]) / 2.0
    x, y = (grid.ravel()[:, None] for grid in np.meshgrid(middle, middle))
    left, bottom = (grid.ravel() for grid in np.meshgrid(ends[:-1], ends[:-1]))
    right, top = (grid.ravel() for grid in np.meshgrid(ends[1:], ends[1:]))

    def primitive(a: Array, b: Array) -> Array:
        """Of 1/r in the plane."""
        return np.asarray(a * np.arcsinh(b / abs(a)) + b * np.arcsinh(a / abs(b)))

    potential = np.zeros((count**2, count**2))
    for across, up in ((1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)):
        for u, v, sign in ((right, top, 1.0), (left, top, -1.0), (right, bottom, -1.0), (left, bottom, 1.0)):
            potential += across * up * sign * primitive(across * u - x, up * v - y)
    charge = np.linalg.solve(potential, np.ones(count**2))
    return float(2.0 * charge @ ((right - left) * (top - bottom)))


def test_thesquare_by_panels() -> None:
    """The published value is that of panels in the limit of small ones."""
    published = capacitance.square(1.0) / (4.0 * np.pi)
    coarse, fine = (abs(square_by_panels(count) / published - 1.0) for count in (10, 20))
    assert fine < 1e-4
    assert fine < 0.3 * coarse
