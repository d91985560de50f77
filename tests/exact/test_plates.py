"""Linear plates, edge bending and cylinders over diaphragms: published values, and other routes to them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from problems.exact import plates
from problems.exact.diaphragm_cylinder import DiaphragmCylinder
from problems.exact.edge_bending import Tube
from problems.published import obstacle_course


def test_circular_plates_satisfy_the_plate_equation() -> None:
    """D (1/r) d/dr (r d/dr) of itself, twice, is q; edge conditions; by exact differences of polynomials in r."""
    r = np.polynomial.Polynomial([0.0, 1.0])

    def laplacian(w: np.polynomial.Polynomial) -> np.polynomial.Polynomial:
        return (r * w.deriv()).deriv() // r

    samples = np.linspace(0.0, 2.0, 5)
    for plate, clamped in (
        (lambda x: plates.clamped_circle(x, 3.0, 2.0, 7.0), True),
        (lambda x: plates.supported_circle(x, 3.0, 2.0, 7.0, 0.3), False),
    ):
        w = np.polynomial.Polynomial.fit(samples, [plate(x) for x in samples], 4, domain=[-1, 1], window=[-1, 1])
        assert 7.0 * laplacian(laplacian(w))(0.7) == pytest.approx(3.0, rel=1e-9)
        assert plate(2.0) == pytest.approx(0.0, abs=1e-15)
        edge = w.deriv()(2.0) if clamped else w.deriv(2)(2.0) + 0.3 * w.deriv()(2.0) / 2.0
        assert edge == pytest.approx(0.0, abs=1e-10)


def test_clamped_circle_moments() -> None:
    w = [plates.clamped_circle(1.0 + k * 1e-3, 1.0, 2.0, 1.0) for k in (-1, 0, 1)]
    second, first = (w[0] - 2.0 * w[1] + w[2]) / 1e-6, (w[2] - w[0]) / 2e-3
    expected = (-(second + 0.3 * first), -(first + 0.3 * second))
    assert plates.clamped_circle_moments(1.0, 1.0, 2.0, 0.3) == pytest.approx(expected, abs=1e-6)


def test_point_load_is_the_ring_load_by_reciprocity() -> None:
    """The mean deflection under a force at the centre is the centre's under that pressure."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    r = 0.5 * (1.0 + nodes)
    mean = float(weights @ [math.pi * x * plates.clamped_circle_point(x, 1.0, 1.0, 1.0) for x in r])
    assert mean == pytest.approx(plates.clamped_circle(0.0, 1.0, 1.0, 1.0), abs=1e-8)
    assert plates.clamped_circle_point(0.0, 1.0, 1.0, 1.0) == pytest.approx(1.0 / (16.0 * math.pi))


def test_rectangles() -> None:
    """0.00406 and 0.0116: Timoshenko and Woinowsky-Krieger, tables 8 and 23; more digits by Levy's single series."""
    square = plates.supported_rectangle(0.5, 0.5, 1.0, (1.0, 1.0), 1.0, 60)
    total = 0.0
    for m in range(1, 60, 2):
        half = 0.5 * m * math.pi
        shape = 1.0 - (half * math.tanh(half) + 2.0) / (2.0 * math.cosh(half))
        total += (-1.0) ** ((m - 1) // 2) / m**5 * shape
    assert square == pytest.approx(4.0 / math.pi**5 * total, rel=1e-7)
    assert square == pytest.approx(0.00406235, abs=5e-9)
    assert plates.supported_rectangle_point(1.0, (1.0, 1.0), 1.0) == pytest.approx(0.01160, abs=5e-6)
    long = plates.supported_rectangle(0.5, 5.0, 1.0, (1.0, 10.0), 1.0, 100)
    assert long == pytest.approx(plates.strip(1.0, 1.0, 1.0, clamped=False), rel=1e-4)


def test_clamped_square_by_ritz() -> None:
    """Even polynomials with the factor ((1 - x^2)(1 - y^2))^2 on the square of side 2."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    bubble = np.polynomial.Polynomial([1.0, 0.0, -2.0, 0.0, 1.0])
    shapes = [bubble * np.polynomial.Legendre.basis(2 * i).convert(kind=np.polynomial.Polynomial) for i in range(10)]
    f, d2 = np.array([p(nodes) for p in shapes]), np.array([p.deriv(2)(nodes) for p in shapes])
    mass, cross, stiff = (f * weights) @ f.T, (f * weights) @ d2.T, (d2 * weights) @ d2.T
    matrix = np.kron(stiff, mass) + np.kron(mass, stiff) + np.kron(cross.T, cross) + np.kron(cross, cross.T)
    load = np.kron(f @ weights, f @ weights)
    centre = np.array([p(0.0) for p in shapes])
    deflection = np.kron(centre, centre) @ np.linalg.solve(matrix, load)
    assert deflection / 16.0 == pytest.approx(plates.CLAMPED_SQUARE, abs=5e-9)


@pytest.mark.parametrize("x", [0.0, 0.03, 0.2])
def test_edge_bending_satisfies_its_equation(x: float) -> None:
    tube = Tube(1.0, 0.01, 1000.0, 0.3)

    def derivatives(w: object) -> np.ndarray:
        points = x + 0.02 * np.cos(np.pi * (np.arange(24) + 0.5) / 24)
        p = np.polynomial.Chebyshev.fit(points, [w(t) for t in points], 20)  # type: ignore[operator]
        return np.array([p(x), p.deriv(1)(x), p.deriv(2)(x), p.deriv(3)(x), p.deriv(4)(x)])

    foundation = tube.young * tube.thickness / tube.radius**2
    edge = derivatives(lambda t: tube.free_edge(t, 2.0, 0.1))
    full = derivatives(lambda t: tube.pressurised(t, 5.0))
    assert tube.stiffness * edge[4] + foundation * edge[0] == pytest.approx(0.0, abs=1e-5 * foundation * 0.1)
    assert tube.stiffness * full[4] + foundation * full[0] == pytest.approx(5.0, rel=1e-5)
    if x == 0.0:
        assert tube.stiffness * edge[2:4] == pytest.approx([0.1, 2.0], rel=1e-6)
        assert full[:2] == pytest.approx([0.0, 0.0], abs=1e-8)
        support = derivatives(lambda t: tube.pressurised(t, 5.0, "supported"))
        assert (support[0], tube.stiffness * support[2]) == pytest.approx((0.0, 0.0), abs=1e-8)
        b, d = tube.decay, tube.stiffness
        assert edge[0] == pytest.approx(2.0 / (2.0 * b**3 * d) + 0.1 / (2.0 * b**2 * d), rel=1e-9)


def test_pinched_cylinder_over_diaphragms() -> None:
    """164.24 F / (E T) is a truncated series; the whole one lies 0.18 per cent above."""
    case = obstacle_course.PINCHED_CYLINDER
    shell = DiaphragmCylinder(300.0, 600.0, 3.0, case.young, case.poisson_ratio)
    assert shell.pinched() == pytest.approx(case.reference, rel=2e-3)
    assert shell.pinched() == pytest.approx(case.thin, rel=1e-6)
    assert shell.pinched(terms=800) == pytest.approx(shell.pinched(), rel=2e-7)


def test_harmonics_of_the_cylinder_have_their_exact_limits() -> None:
    """Long waves: a ring, D (n^2 - 1)^2 / R^4, no stiffness of n = 1. n = 0: the tube of `edge_bending`."""
    shell = DiaphragmCylinder(1.0, 1e5, 1e-3, 1.0, 0.3)
    bending = shell.membrane * 1e-3**2 / 12.0
    ring = shell._radial_stiffness(1, np.array([1.0, 2.0, 3.0])) / bending
    assert ring == pytest.approx([0.0, 9.0, 64.0], rel=1e-6, abs=1e-4)
    short = DiaphragmCylinder(1.0, 0.1, 0.01, 1.0, 0.3)
    k = math.pi / 0.1
    bending = short.membrane * 0.01**2 / 12.0
    expected = short.young * 0.01 + bending * (k**4 + 2.0 * 0.3 * k**2 + 1.0)
    assert short._radial_stiffness(1, np.array([0.0]))[0] == pytest.approx(expected, rel=1e-12)


def test_scordelis_lo() -> None:
    """0.3006 is the converged Kirchhoff-Love value of the literature, 0.3024 the obstacle course's."""
    case = obstacle_course.SCORDELIS_LO
    roof = DiaphragmCylinder(25.0, 50.0, 0.25, case.young, case.poisson_ratio)
    found = roof.roof(math.radians(40.0), 90.0)
    assert found == pytest.approx(0.3006, abs=5e-5)
    assert found == pytest.approx(case.thin, abs=5e-7)
    assert found == pytest.approx(case.reference, rel=7e-3)
    assert roof.roof(math.radians(40.0), 90.0, terms=20, degree=60) == pytest.approx(found, rel=1e-6)
