"""Membranes over a rigid electrode: the pull-in of thin gaps by extrapolation, the deflection on the way there."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from embedding import Solution
from problems import membrane_pull_in
from problems.exact import mems
from problems.membrane_pull_in import DISC, RATIOS, STRIP


@cache
def solved(name: str) -> tuple[tuple[Solution, ...], np.ndarray]:
    """At every ratio of gap and size, and what the middle did at the last."""
    probes = [membrane_pull_in.centre(name) for _ in RATIOS]
    solutions = tuple(
        membrane_pull_in.run(name, *membrane_pull_in.at(name, ratio), listeners=[probe])
        for ratio, probe in zip(RATIOS, probes, strict=True)
    )
    return solutions, np.array(probes[-1].values["centre"])


@pytest.mark.parametrize(("name", "published"), [(STRIP, 1.400016), (DISC, 0.789229)])
def test_the_limit_of_a_thin_gap(name: str, published: float) -> None:
    """J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS. Order 2 up to a logarithm. The extrapolation from L/20
    leaves a tenth of the correction there, 7e-4: the mesh's errors of 1e-4 in the loads come out of it trebled."""
    loads = [membrane_pull_in.pull_in(solution) for solution in solved(name)[0]]
    limit, order = membrane_pull_in.extrapolated(loads)
    assert 1.7 < order < 2.0
    assert limit == pytest.approx(published, rel=7e-4)
    assert loads[-1] == pytest.approx(published, rel=6e-3)


@pytest.mark.parametrize(("name", "body"), [(STRIP, "strip"), (DISC, "disc")])
def test_the_middle_on_the_way(name: str, body: str) -> None:
    """Deflection of the middle at every load below nine tenths of the pull-in, at g = L/20."""
    solutions, middle = solved(name)
    solution = solutions[-1]
    voltage, height = solution["voltage"], membrane_pull_in.gap(solution.scene)
    scale = membrane_pull_in.pull_in(solution) / solution.critical_points[0].scalars["voltage"] ** 2
    below = (np.arange(len(voltage)) < solution.critical_points[0].before_step - 1) & (voltage > 0.0)
    loads = scale * voltage[below] ** 2
    low = loads < 0.9 * membrane_pull_in.known(name).load
    assert low.sum() >= 2
    exact = [mems.centre_at(float(load), body) for load in loads[low]]  # type: ignore[arg-type]
    assert middle[below][low] / height == pytest.approx(exact, rel=0.02)


@pytest.mark.parametrize("name", [STRIP, DISC])
def test_stable_before_and_unstable_beyond(name: str) -> None:
    (point,) = (p for p in solved(name)[0][-1].critical_points if p.kind == "limit")
    assert point.unstable == (0, 1)


@pytest.mark.parametrize(("name", "axis", "edges"), [(STRIP, "y", ("x0", "x1")), (DISC, "z", ("rim",))])
def test_electrode_and_membrane_attract_each_other_alike(name: str, axis: str, edges: tuple[str, ...]) -> None:
    """At half the voltage, with smaller elements at the rims: with those of the scene to 2e-3."""
    finer = f"discretisation.edge_size={{{', '.join(f'{edge} = 5e-4' for edge in edges)}}}"
    solution = membrane_pull_in.run(name, finer, "path=[{steps = 2, field = 0.0}, {steps = 1, field = 0.5}]")
    on_shell, on_body = solution[f"force_{axis}"][-1], solution[f"force_body0_{axis}"][-1]
    assert on_shell < 0.0
    assert on_body == pytest.approx(-on_shell, rel=3e-4)
    if axis == "y":
        turn, back = solution["torque_z"][-1], solution["torque_body0_z"][-1]
        assert turn == pytest.approx(0.05 * on_shell, rel=1e-3), "as if in the middle of the strip"
        assert back == pytest.approx(-turn, rel=3e-4)
