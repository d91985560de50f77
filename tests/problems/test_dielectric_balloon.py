"""Dielectric balloon: the thin wall's equation to the discretisation, the thick wall at second order."""

from __future__ import annotations

import pytest

from embedding import Result
from problems import dielectric_balloon
from tests.problems.measures import orders


def test_thick_wall_is_approached_at_second_order() -> None:
    ratios = (0.1, 0.05, 0.025)
    found = [dielectric_balloon.run(*dielectric_balloon.at(ratio)) for ratio in ratios]
    assert min(orders(ratios, [dielectric_balloon.error(solution) for solution in found])) > 1.95


@pytest.mark.parametrize(("order", "tolerance"), [(3, 1e-6), (4, 2e-8)])
def test_thin_wall_is_met_to_the_discretisation(order: int, tolerance: float) -> None:
    """The equation of Zhu, Cai and Suo; the error is that of the meridian's elements, whatever the thickness."""
    solution = dielectric_balloon.run(f"discretisation.order={order}")
    assert dielectric_balloon.error(solution, "membrane") < tolerance


def test_pull_in_is_found_and_named() -> None:
    limit = dielectric_balloon.exact(dielectric_balloon.scene(), "membrane").pull_in(600.0)
    assert limit is not None
    beyond = f"faces.bottom.voltage={1.02 * limit.load!r}"
    solution = dielectric_balloon.run(beyond, "solver.min_step=1e-3", throw=False)
    assert solution.result is Result.PULL_IN
    reached = dielectric_balloon.voltage(solution.scene) * solution.steps[-1].factor_field
    assert reached == pytest.approx(limit.load, rel=1e-3) and reached < limit.load
