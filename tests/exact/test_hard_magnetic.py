"""Hard-magnetic cantilever: experiment, elastica, boundary value problem, buckling."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from problems.exact import elastica
from problems.exact.hard_magnetic_elastica import BUCKLING, load, shape, tip
from problems.published.hard_magnetic_beam import ZHAO


def test_experiment() -> None:
    """Within the scatter of the experiment; the elastica's own ten digits elsewhere."""
    fields, found = ZHAO.table["field"], ZHAO.table["deflection"]
    exact = [tip(ZHAO.load(1e-3 * field)).deflection for field in fields]
    assert np.abs(np.array(exact) - found).max() < 0.043
    known = {1.856335755: 0.342532452, 4.640839387: 0.597153196, 47.17514124: 0.8925871087}
    for field, deflection in known.items():
        assert tip(ZHAO.load(1e-3 * field)).deflection == pytest.approx(deflection, abs=1e-6)


@pytest.mark.parametrize("a", [0.01, 1.0, 10.0, 300.0])
def test_field_across_is_a_transverse_end_force(a: float) -> None:
    assert tuple(tip(a)) == pytest.approx(tuple(elastica.end_force(a)), abs=1e-9)
    s = np.linspace(0.0, 1.0, 7)
    for mine, other in zip(shape(a, s), elastica.shape_under_force(a, s), strict=True):
        assert mine == pytest.approx(other, abs=5e-8)  # both take an arcsine near 1: half the digits


@pytest.mark.parametrize(("a", "angle"), [(0.5, 0.3), (2.0, 1.2), (4.0, 2.0), (6.0, 3.0)])
def test_any_angle_by_collocation(a: float, angle: float) -> None:
    s = np.linspace(0.0, 1.0, 81)
    start = np.array([angle * s * (2.0 - s), angle * (2.0 - 2.0 * s)])
    found = solve_bvp(
        lambda s, y: np.vstack([y[1], a * np.sin(y[0] - angle)]), lambda p, q: np.array([p[0], q[1]]), s, start,
        tol=1e-9, max_nodes=20000,
    )  # fmt: skip
    assert shape(a, s, angle)[2] == pytest.approx(found.sol(s)[0], abs=1e-8)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    angles = found.sol(0.5 * (1.0 + nodes))[0]
    end = tip(a, angle)
    assert 1.0 - end.shortening == pytest.approx(float(0.5 * weights @ np.cos(angles)), abs=1e-8)
    assert end.deflection == pytest.approx(float(0.5 * weights @ np.sin(angles)), abs=1e-8)


def test_field_against_the_magnetisation_buckles() -> None:
    """Straight up to pi^2/4, then a pitchfork: t(L)^2 = 8 (a / a_c - 1) to first order, as of Euler's column."""
    assert tip(0.999 * BUCKLING, math.pi) == (0.0, 0.0, 0.0)
    assert tip(1.001 * BUCKLING, math.pi).angle == pytest.approx(math.sqrt(0.008), rel=1e-3)
    assert tip(5.0, 0.0) == (0.0, 0.0, 0.0)


def test_limits_and_refusals() -> None:
    """Small loads: deflection a sin(alpha) / 3, angle a sin(alpha) / 2."""
    small = tip(1e-4, 1.0)
    turn = 1e-4 * math.sin(1.0)
    assert (small.deflection, small.angle) == pytest.approx((turn / 3.0, turn / 2.0), rel=1e-4)
    assert load(2.0, 0.1, 3.0, 0.5, 0.25, 2.0) == pytest.approx(12 * 0.5 * 0.25 * 4.0 / (2.0 * 3.0 * 0.01))
    with pytest.raises(ValueError, match="field_angle"):
        tip(1.0, 4.0)
