"""Membranes over a rigid electrode: the pull-in of thin gaps by extrapolation, the deflection on the way there."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from embedding import Solution
from problems import membrane_pull_in
from problems.exact import mems
from problems.membrane_pull_in import DISC, FINE, RATIOS, STRIP

SLOW = pytest.mark.slow
PUBLISHED = [pytest.param(STRIP, 1.400016, id="strip"), pytest.param(DISC, 0.789229, id="disc", marks=SLOW)]


@cache
def solved(name: str) -> tuple[tuple[Solution, ...], np.ndarray]:
    """At every ratio of gap and size, and what the middle did at the last."""
    probes = [membrane_pull_in.centre(name) for _ in RATIOS]
    solutions = tuple(
        membrane_pull_in.run(name, *membrane_pull_in.at(name, ratio), listeners=[probe])
        for ratio, probe in zip(RATIOS, probes, strict=True)
    )
    return solutions, np.array(probes[-1].values["centre"])


@pytest.mark.parametrize(("name", "published"), PUBLISHED)
def test_the_limit_of_a_thin_gap(name: str, published: float) -> None:
    """J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS. What the extrapolation from L/10, L/20 and L/40 leaves is
    of third order in the gap."""
    loads = [membrane_pull_in.pull_in(solution) for solution in solved(name)[0]]
    limit, _ = membrane_pull_in.extrapolated(RATIOS, loads)
    assert limit == pytest.approx(published, rel=5e-5)
    assert loads[-1] == pytest.approx(published, rel=1.5e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "published"), PUBLISHED)
def test_thinner_gaps(name: str, published: float) -> None:
    """An eighth of what L/10 to L/40 leave, and less; the logarithm of the fringes has its known coefficient, of which
    the next order in the gap leaves 15 per cent there and half of it or less here."""
    loads = [membrane_pull_in.pull_in(membrane_pull_in.run(name, *membrane_pull_in.at(name, r))) for r in FINE]
    limit, logarithm = membrane_pull_in.extrapolated(FINE, loads)
    assert limit == pytest.approx(published, rel=5e-6)
    assert logarithm == pytest.approx(mems.fringe(membrane_pull_in.known(name)), rel=0.08)


@pytest.mark.parametrize(("name", "body"), [(STRIP, "strip"), pytest.param(DISC, "disc", marks=SLOW)])
def test_the_middle_on_the_way(name: str, body: str) -> None:
    """Deflection of the middle at every load below nine tenths of the pull-in, at g = L/40."""
    solutions, middle = solved(name)
    solution = solutions[-1]
    voltage, height = solution["voltage"], membrane_pull_in.gap(solution.scene)
    scale = membrane_pull_in.pull_in(solution) / solution.critical_points[0].scalars["voltage"] ** 2
    below = (np.arange(len(voltage)) < solution.critical_points[0].before_step - 1) & (voltage > 0.0)
    loads = scale * voltage[below] ** 2
    low = loads < 0.9 * membrane_pull_in.known(name).load
    assert low.sum() >= 2
    exact = [mems.centre_at(float(load), body) for load in loads[low]]  # type: ignore[arg-type]
    assert middle[below][low] / height == pytest.approx(exact, rel=5e-3)


@pytest.mark.parametrize("name", [STRIP, pytest.param(DISC, marks=SLOW)])
def test_stable_before_and_unstable_beyond(name: str) -> None:
    (point,) = (p for p in solved(name)[0][-1].critical_points if p.kind == "limit")
    assert point.unstable == (0, 1)


@pytest.mark.parametrize(("name", "axis"), [(STRIP, "y"), (DISC, "z")])
def test_electrode_and_membrane_attract_each_other_alike(name: str, axis: str) -> None:
    """At half the voltage."""
    solution = membrane_pull_in.run(name, "path=[{steps = 2, field = 0.0}, {steps = 1, field = 0.5}]")
    on_shell, on_body = solution[f"force_{axis}"][-1], solution[f"force_body0_{axis}"][-1]
    assert on_shell < 0.0
    assert on_body == pytest.approx(-on_shell, rel=3e-4)
    if axis == "y":
        turn, back = solution["torque_z"][-1], solution["torque_body0_z"][-1]
        middle = membrane_pull_in.tension(solution.scene)[1] / 2.0
        assert turn == pytest.approx(middle * on_shell, rel=2e-4), "as if in the middle of the stretched strip"
        assert back == pytest.approx(-turn, rel=3e-4)
