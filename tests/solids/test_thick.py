"""The referees themselves: exact thick sphere and ring, invariance, convergence."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from problems.exact import cylinder, sphere
from tests.solids import MidSurface, constant, referee_load
from tests.solids.thick import thick_ring, thick_sphere

Solid = Callable[..., MidSurface]


@pytest.mark.parametrize("thickness_ratio", [0.4, 0.1, 0.02])
@pytest.mark.parametrize("outside", [0.0, 0.3])
def test_uniform_pressure_is_the_exact_solution(thickness_ratio: float, outside: float) -> None:
    elements = (3 if thickness_ratio > 0.2 else 1, 8)
    inside = outside + sphere.thick_pressure(1.25, thickness_ratio)
    found = thick_sphere(thickness_ratio, constant(outside), constant(inside), elements=elements)
    assert np.hypot(found.r, found.z) == pytest.approx(1.25, abs=1e-8)
    inside = outside + cylinder.thick_pressure(1.4, thickness_ratio)
    found = thick_ring(thickness_ratio, constant(outside), constant(inside), elements=elements)
    assert np.hypot(found.r, found.z) == pytest.approx(1.4, abs=1e-8)


@pytest.mark.parametrize("solid", [thick_sphere, thick_ring])
def test_uniform_mean_pressure_changes_nothing(solid: Solid) -> None:
    p_top, p_bottom = referee_load(0.1, net=0.4, mean=0.1)
    plain = solid(0.1, p_top, p_bottom)
    pressed = solid(0.1, lambda c: p_top(c) + 0.7, lambda c: p_bottom(c) + 0.7)
    assert plain.distance(pressed) < 1e-9


@pytest.mark.parametrize("solid", [thick_sphere, thick_ring])
def test_converges_under_varying_pressure(solid: Solid) -> None:
    load = referee_load(0.1, net=0.4, mean=0.1)
    fine = solid(0.1, *load, order=6, elements=(2, 12))
    errors = [solid(0.1, *load, order=order).distance(fine) for order in (2, 3, 4, 5)]
    assert errors[-1] < 1e-8
    assert all(b < 0.2 * a for a, b in zip(errors, errors[1:], strict=False))


def test_refused() -> None:
    with pytest.raises(ValueError, match="p_top must be even"):
        thick_sphere(0.1, lambda c: 0.1 * c, constant(0.0))
    with pytest.raises(RuntimeError, match="load step"):
        thick_sphere(0.1, constant(0.0), constant(0.2))  # above the limit point
