"""A permeable disc that bends towards a magnet: balance of forces, joint and staggered."""

from __future__ import annotations

from functools import cache

import pytest

from embedding import Solution
from problems import permeable_disc
from problems.permeable_disc import FINE, imbalance


@cache
def default() -> Solution:
    return permeable_disc.run()


def test_disc_and_magnet_pull_at_each_other() -> None:
    solution = default()
    assert solution["force_z"][-1] > 0.02, "towards the magnet above"
    assert abs(imbalance(solution)) < 1e-2
    assert abs(imbalance(permeable_disc.run(*FINE))) < 1e-4


def test_bending_draws_it_nearer() -> None:
    """Force grows faster than the square of the magnet's strength, that of a disc that does not move."""
    solution = default()
    assert solution["force_z"][-1] > 1.3 * 4.0 * solution["force_z"][1]
    assert solution["min_jacobian"].min() > 0.5


def test_staggered_ends_in_the_same_state() -> None:
    """Apart by what the motion of the ambient makes of the discretisation error."""
    joint, staggered = default(), permeable_disc.run("model.coupling=staggered")
    for name in ("displacement", "force_z", "force_body0_z"):
        assert staggered[name][-1] == pytest.approx(joint[name][-1], rel=1e-4)
    assert 0.2 < staggered["contraction"][-1] < 1.0
