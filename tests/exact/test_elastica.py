"""Cantilevers: published tables, shooting, energy minimisation, and the thin limit of Koiter's strip."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize

from problems.exact.elastica import end_force, end_moment, shape_under_force
from problems.exact.koiter_strip import KoiterStrip, koiter_strip


@pytest.mark.parametrize(
    ("load", "shortening", "deflection", "angle"),
    [
        (1.0, 0.05643, 0.30172, 0.46135),
        (2.0, 0.16064, 0.49346, 0.78175),
        (5.0, 0.38763, 0.71379, 1.21537),
        (10.0, 0.55500, 0.81061, 1.43029),
    ],
)
def test_published_table(load: float, shortening: float, deflection: float, angle: float) -> None:
    """K. Mattiasson, Int. J. Numer. Meth. Eng. 17 (1981) 145-153, table 1."""
    assert end_force(load) == pytest.approx((shortening, deflection, angle), abs=6e-6)


@pytest.mark.parametrize(
    ("load", "shortening", "deflection"),
    [(0.2, 0.002646548341, 0.06636448214), (2.0, 0.1606417208, 0.4934574804), (4.0, 0.3289412422, 0.6699641813)],
)
def test_published_digits(load: float, shortening: float, deflection: float) -> None:
    assert end_force(load)[:2] == pytest.approx((shortening, deflection), abs=1e-10)


@pytest.mark.parametrize("load", [0.01, 3.0, 40.0])
def test_force_by_shooting(load: float) -> None:
    """From the free end, where the curvature vanishes, back to the clamp."""

    def path(angle: float) -> np.ndarray:
        def rates(_: float, y: np.ndarray) -> list[float]:
            return [y[1], -load * math.cos(y[0]), math.cos(y[0]), math.sin(y[0])]

        end = solve_ivp(rates, (1.0, 0.0), [angle, 0.0, 0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-14)
        return np.asarray(end.y[:, -1])

    tip = end_force(load)
    angle = brentq(lambda a: path(a)[0], tip.angle - 1e-3, min(tip.angle + 1e-3, 0.5 * math.pi), xtol=1e-14)
    assert tip.angle == pytest.approx(angle, abs=1e-9)
    _, _, x, y = path(tip.angle)
    assert (1.0 - tip.shortening, tip.deflection) == pytest.approx((-x, -y), abs=1e-9)


def test_shape_has_unit_speed_and_the_force_is_the_derivative_of_the_energy() -> None:
    s = np.linspace(0.0, 1.0, 2001)
    x, y, angle = shape_under_force(4.0, s)
    assert np.hypot(np.diff(x), np.diff(y)) * 2000.0 == pytest.approx(np.ones(2000), abs=1e-6)
    assert (x[0], y[0], angle[0]) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)

    def energy(load: float) -> float:
        nodes, weights = np.polynomial.legendre.leggauss(40)
        points = 0.5 * (1.0 + nodes)
        angles = shape_under_force(load, points)[2]
        tip = math.sin(end_force(load).angle)
        return 0.5 * float(weights @ (load * (tip - np.sin(angles))))  # EI t'^2 / 2 = F (sin t_L - sin t)

    step = 1e-4
    rate = (energy(4.0 + step) - energy(4.0 - step)) / (
        end_force(4.0 + step).deflection - end_force(4.0 - step).deflection
    )
    assert rate == pytest.approx(4.0, rel=1e-6)


def test_end_moment_closes_the_circle() -> None:
    assert end_moment(2.0 * math.pi) == pytest.approx((1.0, 0.0, 2.0 * math.pi), abs=1e-15)
    assert end_moment(math.pi)[:2] == pytest.approx((1.0, 2.0 / math.pi), abs=1e-15)
    # Printed in Sze, Liu and Lo (2004), L = 12, a quarter of the full moment.
    assert 12.0 * np.array(end_moment(0.5 * math.pi)[:2]) == pytest.approx([4.361, 7.639], abs=6e-4)


@pytest.mark.parametrize("power", [0, 1])
def test_strip_tends_to_the_elastica(power: int) -> None:
    def error(thickness: float) -> float:
        found = koiter_strip(1.0, thickness, 12.0 / thickness**3, 0.0, power).bent(vertical=3.0)
        return found.y - end_force(3.0).deflection

    assert error(0.02) / error(0.01) == pytest.approx(4.0, rel=0.01)
    assert abs(error(0.01)) < 1e-4


@pytest.mark.parametrize("power", [0, 1])
def test_strip_minimises_its_energy(power: int) -> None:
    """Ritz with polynomials for the stretch and the angle, at a thickness where they matter."""
    strip = KoiterStrip(1.0, 200.0, 1.0, power)
    horizontal, vertical, moment = 1.0, 2.0, 0.5
    nodes, weights = np.polynomial.legendre.leggauss(30)
    s, w = 0.5 * (1.0 + nodes), 0.5 * weights

    def energy(c: np.ndarray) -> float:
        stretch = 1.0 + np.polynomial.polynomial.polyval(s, c[:8])
        angle_of = np.polynomial.Polynomial([0.0, *c[8:]])
        angle, turn = angle_of(s), angle_of.deriv()(s)
        work = stretch * (horizontal * np.cos(angle) + vertical * np.sin(angle))
        density = 25.0 * (stretch**2 - 1.0) ** 2 + 0.5 * (stretch**power * turn) ** 2 - work
        return float(w @ density) - moment * float(angle_of(1.0))

    found = minimize(energy, np.zeros(17), method="BFGS", options={"gtol": 1e-7, "maxiter": 2000})
    state = strip.bent(horizontal, vertical, moment)
    angle_of = np.polynomial.Polynomial([0.0, *found.x[8:]])
    stretch = 1.0 + np.polynomial.polynomial.polyval(s, found.x[:8])
    x, y = float(w @ (stretch * np.cos(angle_of(s)))), float(w @ (stretch * np.sin(angle_of(s))))
    assert (state.x, state.y, state.angle) == pytest.approx((x, y, float(angle_of(1.0))), abs=2e-6)


def test_strip_under_moment() -> None:
    """Uniform: m = D l^2 t' = M; Koiter's bending shortens the strip by (T t')^2 / 12 to first order."""
    found = koiter_strip(12.0, 0.1, 1.2e6).bent(moment=50.0 * math.pi / 3.0)
    turn = found.angle / 12.0
    assert turn * 100.0 * found.stretch**2 == pytest.approx(50.0 * math.pi / 3.0, rel=1e-9)
    assert 1.0 - found.stretch == pytest.approx((0.1 * turn) ** 2 / 12.0, rel=2e-3)
    circle = koiter_strip(12.0, 0.1, 1.2e6, 0.0, 0).bent(moment=50.0 * math.pi / 3.0)
    assert (circle.x, circle.y, circle.stretch) == pytest.approx((0.0, 0.0, 1.0), abs=1e-9)


def test_bad_load_is_refused() -> None:
    with pytest.raises(ValueError, match="must lie in"):
        end_force(-1.0)
