"""A clamped shallow cap: limit pressures against Marguerre's equations."""

from __future__ import annotations

import pytest

from problems import cap_snap_through
from tests.problems.measures import orders


@pytest.mark.parametrize("parameter", [4.0, 5.0, 5.5])
def test_both_limit_points(parameter: float) -> None:
    path = cap_snap_through.run(*cap_snap_through.with_rise(parameter))
    known = [point.pressure for point in cap_snap_through.reference(parameter)]
    assert cap_snap_through.limit_pressures(path) == pytest.approx(known, rel=5e-4)
    assert path.solution.iterations <= 150


def test_a_flatter_cap_is_closer() -> None:
    """The distance from the equations of shallow caps falls with (H/a)^2, proportional to T/R at a given rise."""
    gaps, factors = [], (8.0, 4.0, 2.0)
    for factor in factors:
        path = cap_snap_through.run(*cap_snap_through.thicker(factor))
        gaps.append(abs(cap_snap_through.limit_pressures(path)[0] - cap_snap_through.reference()[0].pressure))
    assert orders(factors, gaps) == pytest.approx([1.0, 1.0], abs=0.1)


def test_limit_points_of_the_scene_file() -> None:
    path = cap_snap_through.run()
    assert cap_snap_through.limit_pressures(path) == pytest.approx([0.61599, 0.28399], abs=1e-4)
