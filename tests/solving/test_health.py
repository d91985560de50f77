"""Health checks: good where all is well, bad where a cause was planted, and true."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from embedding import Scene, Solution, load_scene, open_archive, solve
from embedding.cli import main
from embedding.coupling.linear import LinearSolverError
from embedding.plan import explain
from embedding.solving import health
from embedding.solving.energies import last_step
from embedding.solving.estimate.enriched import Enriched
from embedding.solving.problem import Problem
from problems import charged_balloon, circular_membrane, grounded_balloon, half_cylinder, slit_annulus


def named(solution: Solution, topic: str) -> health.Check:
    return next(one for one in solution.health if one.topic == topic)


def test_all_is_well_in_a_charged_balloon() -> None:
    solution = charged_balloon.run("path=[{steps=3}]")
    assert [one.topic for one in solution.health] == [
        "residual", "space", "elements", "limit point", "compression", "condition", "energies",
    ]  # fmt: skip
    assert all(one.good for one in solution.health)
    assert named(solution, "residual").unit == "N"
    assert named(solution, "space").value == solution["min_jacobian"][-1]


def test_near_a_limit_point_the_response_grows_without_end() -> None:
    """The pull-in voltage of a balloon in a grounded sphere: like the inverse root of the distance to it."""
    limit = grounded_balloon.exact(grounded_balloon.scene()).pull_in()
    assert limit is not None
    found = []
    for part in (0.9, 0.99, 0.998):
        voltage = grounded_balloon.at_voltage(part * limit.load)
        found.append(named(grounded_balloon.run(*voltage, "path=[{steps=8}]"), "limit point"))
    first, second, third = (one.value for one in found)
    assert second / first > 1.5 and third / second > 1.5
    assert found[0].good and not found[-1].good


def test_at_a_limit_point_itself_the_answer_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """There the tangent is singular, and nothing can be solved with it: the answer stands, without an end to its
    response."""

    def singular(*_: object) -> None:
        raise LinearSolverError("planted")

    monkeypatch.setattr(Enriched, "_responses", singular)
    monkeypatch.setattr(Enriched, "_condition", singular)
    solution = charged_balloon.run("path=[{steps=3}]")
    assert solution.result.ok and solution.error is not None
    assert "singular" in solution.error.method
    for topic in ("limit point", "condition"):
        assert named(solution, topic).value == math.inf and not named(solution, topic).good


def test_energies_balance_over_the_last_step() -> None:
    """A step that stores what it was not given is found."""
    solution = charged_balloon.run("path=[{steps=6}]")
    assert named(solution, "energies").value < 0.1
    problem = Problem(solution.scene, explain(solution.scene))
    last = solution.steps[-1]
    for factor, good in ((1.0, True), (1.2, False), (0.8, False)):
        energy = factor * last.scalars["elastic_energy"]
        planted = (*solution.steps[:-1], replace(last, scalars=last.scalars | {"elastic_energy": energy}))
        check = last_step(problem, planted)
        assert check is not None and check.good is good


def test_the_response_is_that_of_the_displacement() -> None:
    """|d ln u / d ln p| by two solves."""
    low, high = (solve(load_scene(circular_membrane.SCENE, (f"path=[{{mechanical={p}}}]",))) for p in (0.999, 1.001))
    slope = math.log(high["displacement"][-1] / low["displacement"][-1]) / math.log(1.001 / 0.999)
    middle = solve(load_scene(circular_membrane.SCENE, ("path=[{}]",)))
    assert named(middle, "limit point").value == pytest.approx(slope, rel=1e-3)


def test_flat_elements_are_found() -> None:
    """Long thin elements along the rim of a plate."""
    problem = Problem(scene := load_scene(slit_annulus.SCENE), explain(scene))
    assert health.quality(problem) > 0.5
    regular = np.array([[[0.0, 0.0], [1.0, 0.0], [0.5, math.sqrt(0.75)]]])
    thin = regular * [1.0, 0.01]
    corner = np.array([[[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]])
    assert health.quality_of(regular)[0] == pytest.approx(1.0)
    assert health.quality_of(corner)[0] == pytest.approx(1.0)
    assert health.quality_of(thin)[0] < 0.03


def test_a_bending_layer_that_elements_do_not_see() -> None:
    """At the clamp of a cylinder: sqrt(R T) falls to a tenth as the wall becomes a hundred times thinner."""

    def layer(*changes: str) -> health.Check:
        problem = Problem(stated := load_scene(half_cylinder.SCENE, changes), explain(stated))
        return next(one for one in health.of_bending(problem) if one.topic == "bending layer")

    thick, thin = layer(), layer("shell.thickness=0.03 m")
    assert thick.good and not thin.good
    assert thin.value == pytest.approx(10 * thick.value, rel=1e-9)


def test_info_tells_all_of_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    archive = tmp_path / "disc.vtkhdf"
    solution = solve(load_scene(circular_membrane.SCENE, ("path=[{}]",)), archive=archive)
    assert open_archive(archive).health == solution.health
    assert main(["info", str(archive)]) == 0
    told = capsys.readouterr().out
    assert all(f"health: {one.topic}" in told for one in solution.health)
    assert "good, " in told and "\x1b" not in told


@pytest.mark.parametrize("theory", ["membrane", "bending"])
@pytest.mark.parametrize("pressure, good", [(20.0, True), (100.0, False)])
def test_a_thin_sphere_pressed_from_outside(theory: str, pressure: float, good: bool) -> None:
    """It buckles at 75.7 Pa, 2 E T^2 / (R^2 (3 (1 - nu^2))^(1/2)) (R. Zoelly, 1915), in waves that no element here
    sees."""
    solution = solve(Scene.model_validate({
        "shell": {"shape": {"kind": "sphere", "radius": 0.02}, "thickness": 5e-6,
                  "material": {"law": "st-venant-kirchhoff", "youngs_modulus": 1e9, "poisson_ratio": 0.3}},
        "loads": {"pressure_top": pressure}, "path": [{"steps": 1}], "model": {"theory": theory},
    }))  # fmt: skip
    assert {check.topic: check.good for check in solution.health}["compression"] is good
