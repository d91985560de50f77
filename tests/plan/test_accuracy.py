"""With a stated accuracy numbers decide: what is pinned, asked for or unknown is left as it is."""

from __future__ import annotations

from typing import Any

import pytest

from embedding import Scene, explain
from embedding.plan import Plan
from embedding.plan.allowance import SAFE, UNSTATED
from embedding.solving import run
from problems import charged_balloon

MU, RADIUS = 1e5, 0.02
SHELL: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": RADIUS},
    "thickness": 0.01 * RADIUS,
    "material": {"law": "neo-hookean", "shear_modulus": MU},
}
INFLATED = {"loads": {"pressure_bottom": 0.5 * MU * 0.01}}
WEAK = {"ambient": {"field": "electric"}, "faces": {"both": {"voltage": 1e3}}, **INFLATED}
"""A field that is not felt: 0.02 Pa beside 500."""
COARSE = 0.1


def scene(**rest: Any) -> Scene:
    return Scene.from_table({"shell": SHELL, "path": [{"steps": 2}], **rest})


def decided(plan: Plan, topic: str) -> Any:
    return next(decision for decision in plan.decisions if decision.topic == topic)


def test_without_an_accuracy_nothing_is_left_out() -> None:
    plan = explain(scene(**WEAK))
    assert (plan.extent, plan.coupling, plan.opened) == ("surroundings", "joint", ("t",))
    assert decided(plan, "interface").threshold == pytest.approx(SAFE * UNSTATED)
    assert decided(plan, "field felt").number < 1e-4


def test_a_field_that_is_not_felt_is_left_out() -> None:
    plan = explain(scene(**WEAK, accuracy=1e-3))
    assert plan.extent == "none"
    assert plan.sizes.radius == 0.0
    assert decided(plan, "ambient").number < decided(plan, "ambient").threshold == pytest.approx(SAFE * 1e-3)


@pytest.mark.parametrize("of", ["charge", "field_energy", "pressure_top"])
def test_what_is_asked_of_a_field_needs_it(of: str) -> None:
    assert explain(scene(**WEAK, accuracy={"relative": COARSE, "of": of})).extent == "surroundings"


@pytest.mark.parametrize(
    ("model", "topic", "choice"),
    [
        ({"theory": "bending"}, "shell theory", "bending"),
        ({"theory": "membrane"}, "shell theory", "membrane"),
        ({"interface": "opened", "surroundings": "meshed"}, "interface", "opened"),
        ({"interface": "closed", "surroundings": "meshed"}, "interface", "closed"),
        ({"surroundings": "meshed"}, "field", "all around the shell"),
        ({"coupling": "joint"}, "coupling", "joint"),
        ({"coupling": "once"}, "coupling", "once"),
        ({"far_field": "infinite", "surroundings": "meshed"}, "far field", "infinite map"),
        ({"far_field": "robin", "surroundings": "meshed"}, "far field", "second-order Robin"),
    ],
)
@pytest.mark.parametrize("accuracy", [COARSE, 1e-7])
def test_what_is_pinned_stays(model: dict[str, str], topic: str, choice: str, accuracy: float) -> None:
    found = decided(explain(scene(**WEAK, accuracy=accuracy, model=model)), topic)
    assert found.choice == choice
    assert "pinned by the scene" in found.reason


@pytest.mark.parametrize("pinned", ["interface=closed", "coupling=once", "far_field=infinite", "surroundings=meshed"])
def test_what_is_pinned_without_a_field_is_told(pinned: str) -> None:
    """It says nothing of a shell alone; with the field it does, but for open space where a ground ends it."""
    name, value = pinned.split("=")
    model = {name: value}
    found = decided(explain(scene(loads=WEAK["loads"], model=model)), "not used")
    assert found.choice == f"model.{name}" and "no field is modelled" in found.reason
    assert not [one for one in explain(scene(**WEAK, model=model)).decisions if one.topic == "not used"]
    ground = {**WEAK, "ambient": {**WEAK["ambient"], "outer": "grounded"}, "model": model}
    ended = [one.choice for one in explain(scene(**ground)).decisions if one.topic == "not used"]
    assert ended == (["model.far_field"] if name == "far_field" else [])


def test_a_path_that_is_followed_is_solved_jointly() -> None:
    """By arc length, as stages are without ``steps``: only the joint tangent knows where to go."""
    given = {**WEAK, "accuracy": COARSE, "model": {"surroundings": "meshed"}}
    assert explain(scene(**given)).coupling == "once"
    assert explain(scene(**given, path=[{}])).coupling == "joint"
    assert explain(scene(**given, path=[{"control": "arc-length"}])).coupling == "joint"


def test_compression_needs_bending() -> None:
    pressed = {"loads": {"pressure_top": 1.0}}
    assert not explain(scene(**pressed)).bending
    assert explain(scene(**pressed, accuracy=COARSE)).bending


def test_a_small_strain_shell_in_tension_is_a_membrane() -> None:
    """A steel balloon, blown up; without a stated accuracy, or with a load of unknown tension, it is bent as well."""
    steel = {**SHELL, "material": {"law": "st-venant-kirchhoff", "youngs_modulus": 2e11, "poisson_ratio": 0.3}}
    loads = {"pressure_bottom": 1e5}
    accuracy = {"relative": 1e-3, "of": "stretch"}
    assert explain(scene(shell=steel, loads=loads)).bending
    assert not explain(scene(shell=steel, loads=loads, accuracy=accuracy)).bending
    assert explain(scene(shell=steel, loads={**loads, "body_force": [0.0, 0.0, 1.0]}, accuracy=accuracy)).bending


@pytest.mark.parametrize(("load", "dimension"), [({}, "axisymmetric"), ({"body_force": [1.0, 0.0, 0.0]}, "3d")])
def test_symmetry_is_exact_at_any_accuracy(load: dict[str, Any], dimension: str) -> None:
    loads = {**INFLATED["loads"], **load}
    for accuracy in (COARSE, 1e-7):
        plan = explain(scene(loads=loads, accuracy=accuracy))
        assert plan.reduction.name == dimension
        assert decided(plan, "dimension").number is None


def test_homogeneous_scenes_are_told() -> None:
    def told(**rest: Any) -> bool:
        return "solution" in {decision.topic for decision in explain(scene(**rest)).decisions}

    assert told(**INFLATED)
    assert told(**WEAK)
    assert not told(loads={"pressure_bottom": 1.0, "body_force": [0.0, 0.0, 1.0]})
    assert not told(shell={**SHELL, "thickness": {"expression": "1 + x**2", "unit": "mm"}}, **INFLATED)


def test_numbers_are_printed() -> None:
    plan = explain(scene(**WEAK, accuracy=1e-3))
    line = next(line for line in plan.text().splitlines() if line.startswith("shell theory"))
    found = decided(plan, "shell theory")
    assert f"{found.number:.1e} <= {found.threshold:.1e}" in line
    assert f"[{found.measure}]" in line


@pytest.mark.parametrize("ratio", [0.1, 0.05])
def test_bending_makes_a_charged_balloon_worse(ratio: float) -> None:
    """Against the exact thick sphere: what its wall resists more and what the field on its face pulls more cancel, and
    the planner leaves the theory alone. Under pressure it does not."""
    thickness, *voltages = charged_balloon.at(ratio, 1.1)
    stated = charged_balloon.scene(thickness, *voltages, "path=[{steps=3}]")
    off = {}
    for theory in ("membrane", "bending"):
        solution = run(stated.with_overrides([f"model.theory={theory}"]))
        off[theory] = abs((solution["stretch"][-1] - 1) / (charged_balloon.reference(solution)[-1] - 1) - 1)
    assert off["membrane"] < 0.3 * off["bending"]
    for accuracy in (1e-2, 1e-4):
        assert not explain(stated.with_overrides([f"accuracy={accuracy}"])).bending
    blown = ["accuracy=1e-4", "path=[{steps=3, field=0.0}]", "loads.pressure_bottom=500 Pa"]
    assert explain(stated.with_overrides(blown)).bending
