"""Pinched ring, critical loads and arches: published values, series, stability of discrete models."""

from __future__ import annotations

import math

import numpy as np
import pytest

from problems.exact import arch, buckling
from problems.exact.circular_arch import CircularArch


def test_pinched_ring() -> None:
    """0.149 and 0.137 (Timoshenko); Fourier series of the inextensible ring."""
    ring = buckling.pinched_ring(1.0, 1.0, 1.0)
    assert ring == pytest.approx((0.149, 0.137), abs=5e-4)
    even = np.arange(2, 4001, 2)
    terms = 4.0 / (math.pi * (even**2 - 1.0) ** 2)
    assert ring.along == pytest.approx(float(terms.sum()), abs=1e-9)
    assert ring.across == pytest.approx(-float((terms * np.cos(0.5 * math.pi * even)).sum()), abs=1e-9)


COLUMNS = [("pinned-pinned", 9.8696), ("clamped-pinned", 20.19), ("clamped-free", 2.467), ("clamped-clamped", 39.478)]


@pytest.mark.parametrize(("ends", "factor"), COLUMNS)
def test_columns(ends: buckling.Ends, factor: float) -> None:
    """Timoshenko and Gere's factors; lowest eigenvalue of a discrete strip, by polynomials."""
    assert buckling.column_force(2.0, 3.0, ends) == pytest.approx(factor * 0.75, rel=3e-4)
    nodes, weights = np.polynomial.legendre.leggauss(30)
    x, w = 0.5 * (1.0 + nodes), 0.5 * weights
    p = np.polynomial.Polynomial
    first = {"clamped-free": p([0, 0, 1]), "pinned-pinned": p([0, 1, -1])}
    first |= {"clamped-pinned": p([0, 0, 1, -1]), "clamped-clamped": p([0, 0, 1, -2, 1])}
    shapes = [first[ends] * p([-1, 2]) ** i for i in range(9)]
    slope, bend = (np.array([s.deriv(k)(x) for s in shapes]) for k in (1, 2))
    values = np.linalg.eigvals(np.linalg.solve((slope * w) @ slope.T, (bend * w) @ bend.T))
    assert buckling.COLUMNS[ends] == pytest.approx(float(min(values.real)), rel=1e-7)


def test_critical_pressures() -> None:
    assert buckling.ring_pressure(2.0, 8.0) == pytest.approx(3.0)
    # E/4 (T/R)^3 / (1 - nu^2): Bresse's and Bryan's long tube.
    stiffness = 1.0 / (12.0 * (1.0 - 0.09))
    assert buckling.ring_pressure(10.0, stiffness) == pytest.approx(0.25e-3 / (1.0 - 0.09))
    assert buckling.sphere_pressure(1.0, 0.01, 1.0, 0.3) == pytest.approx(1.2104e-4, rel=1e-3)  # 1.21 E (T/R)^2
    assert buckling.cylinder_stress(1.0, 0.01, 1.0, 0.3) == pytest.approx(0.605e-2, rel=1e-3)


@pytest.mark.parametrize("rise", [1.5, 2.2, 3.0, 5.0])
def test_shallow_arch_by_its_energy(rise: float) -> None:
    """Gradient and Hessian of the energy in (b1, b2) by differences at the critical points."""

    def energy(b1: float, b2: float, load: float) -> float:
        stretched = b1**2 + 4.0 * b2**2 - rise**2
        return 0.5 * (b1 - rise) ** 2 + 8.0 * b2**2 + 0.25 * stretched**2 + load * b1

    def hessian(b1: float, load: float) -> tuple[float, float, float]:
        h = 1e-3
        up, here, down = (energy(b1 + k * h, 0.0, load) for k in (1, 0, -1))
        side = energy(b1, h, load)
        return (up - down) / (2.0 * h), (up - 2.0 * here + down) / h**2, 2.0 * (side - here) / h**2

    limit = arch.limit_point(rise)
    assert limit is not None
    force, along, _ = hessian(*limit)
    assert (force, along) == pytest.approx((0.0, 0.0), abs=1e-4)
    branch = arch.bifurcation_point(rise)
    assert (branch is None) == (rise <= 2.0)
    if branch:
        force, _, across = hessian(*branch)
        assert (force, across) == pytest.approx((0.0, 0.0), abs=1e-4)
        assert (branch.rise > limit.rise) == (rise > math.sqrt(5.5))
        b2, load = arch.unsymmetric(0.5 * branch.rise, rise)
        gradient = [
            (energy(0.5 * branch.rise + h, b2, load) - energy(0.5 * branch.rise, b2, load)) for h in (1e-4, -1e-4)
        ]
        assert (gradient[0] - gradient[1]) / 2e-4 == pytest.approx(0.0, abs=1e-6)


def test_shallow_arch_without_snap() -> None:
    assert arch.limit_point(1.0) is None and arch.lower_limit_point(0.9) is None
    lower = arch.lower_limit_point(2.0)
    assert lower is not None and lower.load == pytest.approx(arch.load(lower.rise, 2.0))
    # The strip's own scales: rise 2 g b0, load P (L/pi)^4 / (2 g EI).
    g = 0.1 / math.sqrt(12.0)
    assert arch.scaled_load(1.0, 2.0, 0.1, 3.0) == pytest.approx(2.0 * g * 3.0 * (math.pi / 2.0) ** 4)


@pytest.mark.slow
def test_deep_arch() -> None:
    """8.97 EI / R^2, DaDeppo and Schmidt (1975), clamped-hinged with an opening of 215 degrees."""
    limit = CircularArch(math.radians(107.5)).limit()
    assert limit.load == pytest.approx(8.97, abs=5e-3)


def test_deep_arch_at_rest_is_linear_and_symmetric_with_equal_ends() -> None:
    """Small loads on a clamped semicircle: the crown falls by F R^3 / EI times the arch's elastic constant."""
    (state,) = CircularArch(0.5 * math.pi, "clamped-clamped").path(1e-5)
    # Castigliano for half the arch: unknown thrust and moment at the crown, F/2 in shear.
    t, w = np.polynomial.legendre.leggauss(20)
    f, w = 0.25 * math.pi * (1.0 + t), 0.25 * math.pi * w
    modes = np.array([np.ones_like(f), 1.0 - np.cos(f), 0.5 * np.sin(f)])
    flexibility = (modes * w) @ modes.T
    redundant = -np.linalg.solve(flexibility[:2, :2], flexibility[:2, 2])
    constant = 2.0 * float(flexibility[2, 2] + flexibility[2, :2] @ redundant)
    assert state.load == pytest.approx(1e-5 / constant, rel=1e-3)
    assert state.sideways == pytest.approx(0.0, abs=1e-10)
