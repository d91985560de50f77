"""The planner's simplest shells against the exact solutions of membrane theory."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding.plan.response import BEYOND, FLAT_STRAIN, FLAT_TENSION, Form, answer, bending_share
from problems.exact import cylinder, sphere
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.hencky import hencky

THIN = 1e-3
"""T/R, which membrane theory is linear in."""


@pytest.mark.parametrize("stretch", [1.02, 1.1, 1.3])
def test_inflated_sphere(stretch: float) -> None:
    found = answer("sphere", sphere.membrane_pressure(stretch, THIN) / THIN, 0.0)
    slope = sphere.membrane_slope(stretch, 1.0)
    assert found.stretch == pytest.approx(stretch, rel=1e-9)
    assert found.response == pytest.approx(sphere.membrane_pressure(stretch, 1.0) / (stretch * slope), rel=1e-5)


@pytest.mark.parametrize("stretch", [1.02, 1.5])
def test_inflated_tube(stretch: float) -> None:
    found = answer("cylinder", cylinder.membrane_pressure(stretch, THIN) / THIN, 0.0)
    assert found.stretch == pytest.approx(stretch, rel=1e-9)


@pytest.mark.parametrize("voltage", [0.3, 1.0, 2.0])
def test_charged_sphere(voltage: float) -> None:
    balloon = ChargedBalloon(1.0, 1.0, theory="membrane")
    found = answer("sphere", 0.0, 0.5 * voltage**2)
    assert found.stretch == pytest.approx(balloon.stretch(voltage), rel=1e-9)


@pytest.mark.parametrize("stretch", [1.05, 1.2, 1.4])
@pytest.mark.parametrize(("form", "at_rest", "thick"), [("sphere", 3 / 4, sphere), ("cylinder", 1 / 3, cylinder)])
def test_what_bending_adds(form: Form, at_rest: float, thick: Any, stretch: float) -> None:
    """Most of what the exact thick wall has beyond the membrane at small stretches; that of a tube shears as well."""
    assert bending_share(form, 1.0) == at_rest
    assert bending_share(form, 1.001) == pytest.approx(at_rest, rel=0.02)
    exact = (thick.bending_pressure(stretch, THIN) / thick.membrane_pressure(stretch, THIN) - 1) / THIN**2
    assert 0.0 < bending_share(form, stretch) < 1.2 * abs(exact)


def test_at_the_limit_point() -> None:
    """A neo-Hookean sphere bears 2 (7^(-1/6) - 7^(-7/6)) mu T/R: its response grows without limit, and beyond it a
    guess takes its place."""
    limit = 2 * (7 ** (-1 / 6) - 7 ** (-7 / 6))
    assert limit == pytest.approx(sphere.limit_points(THIN, theory="membrane")[0].load / THIN)
    assert answer("sphere", limit * (1 - 1e-3), 0.0).response > 10 * answer("sphere", 0.5 * limit, 0.0).response
    assert answer("sphere", limit * (1 + 1e-3), 0.0) == BEYOND


@pytest.mark.parametrize("poisson_ratio", [0.3, 0.5])
def test_hencky(poisson_ratio: float) -> None:
    """Held along its rim, his membrane grows in area by half the mean square of its slope."""
    exact, x = hencky(poisson_ratio), np.linspace(0.0, 1.0, 401)
    slope = np.gradient(exact.profile(x), x)
    stretch, tension = np.trapezoid(slope**2 / 2 * 2 * x, x) / 2, exact.force
    assert stretch == pytest.approx(FLAT_STRAIN, rel=0.2)
    assert tension == pytest.approx(FLAT_TENSION, rel=0.05)
    small = answer("flat", 3e-6, 0.0)
    assert small.stretch - 1 == pytest.approx(FLAT_STRAIN * 1e-4, rel=1e-9)
    assert small.response == pytest.approx(2 / 3 * (small.stretch - 1), rel=1e-12)
