"""Dielectric balloon: the thin wall's equation to the discretisation, the thick wall at second order."""

from __future__ import annotations

import math

import pytest

from embedding import Result
from embedding.scene.scales import EPSILON_0
from problems import dielectric_balloon
from tests.problems.measures import orders


def test_thick_wall_is_approached_at_second_order() -> None:
    ratios = (0.1, 0.05, 0.025)
    path = "path=[{steps = 2, field = 0.0}, {steps = 3}]"
    found = [dielectric_balloon.run(*dielectric_balloon.at(ratio), path) for ratio in ratios]
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


def at_pole(growth: str) -> str:
    """The end of a stage, where the pole has moved this far."""
    return f"until={{where=['0 mm', '0 mm', '20 mm'], axis='z', value='{growth}'}}"


@pytest.mark.parametrize(("order", "tolerance"), [(3, 1e-6), (4, 1e-8)])
def test_pull_in_is_a_limit_point(order: int, tolerance: float) -> None:
    """At p R / (2 mu T) = 0.2: l = 1.28924066670, V = 0.561681678090 T (mu/eps)^(1/2). Errors of a load at its maximum
    are squares of those of the place."""
    path = f"path=[{{steps=2, field=0.0}}, {{{at_pole('6.5 mm')}}}]"
    solution = dielectric_balloon.run(f"discretisation.order={order}", "faces.bottom.voltage=20000", path)
    limit = solution.critical_points[0]
    assert (limit.kind, limit.unstable) == ("limit", (0, 1))
    assert limit.scalars["stretch"] == pytest.approx(1.28924066670, abs=1e-5)
    unit = 1e-3 * math.sqrt(30e3 / (3.0 * EPSILON_0))
    assert 20e3 * limit.factor_field == pytest.approx(0.561681678090 * unit, rel=tolerance)


@pytest.mark.parametrize(("order", "tolerance"), [(3, 5e-6), (4, 1e-8)])
def test_largest_pressure_at_a_voltage(order: int, tolerance: float) -> None:
    """At V = 0.3 T (mu/eps)^(1/2): l = 1.34858204502, p R / (2 mu T) = 0.496876920694."""
    voltage = 0.3e-3 * math.sqrt(30e3 / (3.0 * EPSILON_0))
    path = f"path=[{{steps=2, mechanical=0.0}}, {{{at_pole('8 mm')}}}]"
    loads = ("loads.pressure_bottom=1800", f"faces.bottom.voltage={voltage!r}")
    solution = dielectric_balloon.run(f"discretisation.order={order}", *loads, path)
    limit = solution.critical_points[0]
    assert (limit.kind, limit.unstable) == ("limit", (0, 1))
    assert limit.scalars["stretch"] == pytest.approx(1.34858204502, abs=1e-4)
    found = 1800.0 * limit.factor_mechanical * 0.02 / (2.0 * 30e3 * 1e-3)
    assert found == pytest.approx(0.496876920694, rel=tolerance)
