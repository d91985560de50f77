"""A rigid plate on a spring over an electrode: pull-in at a third of the gap, by extrapolation; the force before it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from embedding import Solution
from problems import plate_pull_in
from problems.plate_pull_in import FINE, RATIOS, Charged


@cache
def solved(ratio: float) -> tuple[Solution, Charged]:
    return plate_pull_in.run(*plate_pull_in.at(ratio))


@pytest.mark.slow
def test_the_limit_of_a_thin_gap() -> None:
    """H. C. Nathanson et al. (1967). What gaps of 0.16, 0.08 and 0.04 of the radius leave is of third order."""
    limit = plate_pull_in.extrapolated(RATIOS, [solved(ratio)[1].pull_in for ratio in RATIOS])
    assert limit.load == pytest.approx(4.0 / 27.0, rel=5e-4)
    assert limit.centre == pytest.approx(1.0 / 3.0, rel=5e-4)


@pytest.mark.slow
def test_thinner_gaps() -> None:
    """There the field at the electrode's edge, 1e-4 on this mesh, is all that is left."""
    limit = plate_pull_in.extrapolated(FINE, [solved(ratio)[1].pull_in for ratio in FINE])
    assert limit.load == pytest.approx(4.0 / 27.0, rel=1.5e-4)
    assert limit.centre == pytest.approx(1.0 / 3.0, rel=1.5e-4)


@pytest.mark.slow
def test_the_force_of_the_field_and_of_the_spring() -> None:
    """That of plates a gap apart, with the fringes of the electrode's edge to first order; k x."""
    ratio = RATIOS[-1]
    charged = solved(ratio)[1]
    fringes = 1.0 + 4.0 / np.pi * ratio * (1.0 - charged.deflection)
    assert charged.force == pytest.approx(fringes, rel=ratio**2 * 2.0)
    assert charged.spring == pytest.approx(charged.spring[0], rel=1e-3)


@pytest.mark.slow
def test_stable_before_and_unstable_beyond() -> None:
    (point,) = (p for p in solved(RATIOS[-1])[0].critical_points if p.kind == "limit")
    assert point.unstable == (0, 1)
