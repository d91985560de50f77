"""What the plan chooses, with its reasons, before anything is meshed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from embedding import Scene, explain

SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": 0.02},
    "thickness": 1e-3,
    "material": {"law": "neo-hookean", "shear_modulus": 1e5},
}
CHARGED = {"ambient": {"field": "electric"}, "faces": {"top": {"voltage": 1e3}, "bottom": {"voltage": 1e3}}}
PERMEABLE = {**SPHERE, "relative_permeability": 10.0}


def chosen(**changes: Any) -> dict[str, str]:
    return {decision.topic: decision.choice for decision in plan(**changes).decisions}


def plan(**changes: Any) -> Any:
    return explain(Scene.from_table({"shell": SPHERE, **changes}))


def test_what_shares_an_axis_is_axisymmetric() -> None:
    assert chosen()["dimension"] == "axisymmetric"
    assert chosen(loads={"body_force": [0.0, 0.0, 1.0]})["dimension"] == "axisymmetric"


@pytest.mark.parametrize(
    ("loads", "dimension"),
    [
        ({"body_force": [1.0, 0.0, 0.0]}, "3d, 1/4"),
        ({"body_force": [1.0, 1.0, 0.0]}, "3d, 1/2"),
        ({"pressure_top": {"expression": "x"}}, "3d, 1/4"),
        ({"pressure_top": {"expression": "x**2 + y"}}, "3d, 1/4"),
        ({"pressure_top": {"expression": "x**2"}}, "3d, 1/8"),
    ],
)
def test_loads_decide_the_mirror_planes(loads: dict[str, Any], dimension: str) -> None:
    assert chosen(loads=loads)["dimension"] == dimension


def test_a_support_of_one_direction_is_not_axisymmetric() -> None:
    disc = {**SPHERE, "shape": {"kind": "disc", "radius": 0.1}}
    held = [{"where": "rim", "fix": ["x"]}]
    assert chosen(shell=disc, supports=held)["dimension"].startswith("3d")


def test_an_applied_field_mirrors_the_potential_oddly() -> None:
    ambient = {"field": "magnetic", "applied_field": [4e4, 0.0, 0.0]}
    made = plan(shell=PERMEABLE, ambient=ambient)
    assert made.reduction.planes == ("x", "y", "z")
    assert made.odd_planes == ("x",)
    oblique = plan(shell=PERMEABLE, ambient={**ambient, "applied_field": [4e4, 0.0, 1e4]})
    assert oblique.reduction.planes == ("y",)
    assert oblique.odd_planes == ()


def test_no_field_no_ambient() -> None:
    assert chosen()["ambient"] == "none"
    assert plan().sizes.radius == 0.0
    assert plan(**CHARGED).sizes.radius == 4.0


def test_a_conductor_is_opened_where_it_is_felt() -> None:
    assert plan(**CHARGED).opened == ("t",)
    assert plan(**CHARGED, model={"interface": "opened"}).opened == ("t", "b")
    assert plan(**CHARGED, model={"interface": "closed"}).opened == ()
    assert plan(shell=PERMEABLE, ambient={"field": "magnetic", "applied_field": [0.0, 0.0, 1.0]}).opened == ("t", "b")


def test_stated_sizes_are_kept() -> None:
    sizes = plan(**CHARGED, discretisation={"shell_size": 0.005, "ambient_size": 0.04, "order": 2}).sizes
    assert (sizes.shell, sizes.far, sizes.order, sizes.potential_order) == (0.25, 2.0, 2, 3)


def test_every_decision_has_a_reason() -> None:
    made = plan(**CHARGED)
    assert all(decision.reason for decision in made.decisions)
    assert made.text().count("\n") == len(made.decisions) - 1


TUBE = {**SPHERE, "shape": {"kind": "cylinder", "radius": 0.02, "length": 0.1}}
"""A cylinder, whose ends are each other's mirror images."""


@pytest.mark.parametrize(
    ("held", "dimension"),
    [
        (("end0", "end1"), "3d, 1/8"),
        (("end0",), "3d, 1/4"),
        ((), "3d, 1/8"),
    ],
)
def test_what_is_held_on_one_end_is_not_mirrored(held: tuple[str, ...], dimension: str) -> None:
    supports = [{"where": end, "fix": ["x", "y", "z"]} for end in held]
    made = chosen(shell=TUBE, supports=supports, loads={"pressure_bottom": {"expression": "1 + x**2"}})
    assert made["dimension"] == dimension


def test_sectors_are_mirrored_if_they_lie_evenly() -> None:
    for start, dimension in ((-20, "3d, 1/4"), (0, "3d, 1/2")):
        panel = TUBE["shape"] | {"start": f"{start} deg", "angle": "40 deg"}
        assert chosen(shell={**TUBE, "shape": panel})["dimension"] == dimension


def test_cross_sections_are_treated_per_length() -> None:
    for shape in ({"kind": "strip", "length": 0.1}, {"kind": "arch", "radius": 0.1, "half_angle": 0.5}):
        assert chosen(shell={**SPHERE, "shape": shape})["dimension"] == "plane-strain"


def test_narrow_shapes_get_small_elements() -> None:
    ring = {"kind": "annulus", "inner_radius": 0.09, "outer_radius": 0.1}
    sizes = plan(shell={**SPHERE, "shape": ring}, discretisation={"edge_size": {"inner": "1 mm"}}).sizes
    assert sizes.shell == pytest.approx(0.2 * 0.2)  # a curve's default, 0.2 x size, times twice the width
    assert sizes.edges == (("inner", pytest.approx(0.01)),)


@pytest.mark.parametrize(
    ("interface", "faces", "topic", "size"),
    [
        ("closed", CHARGED["faces"], "mesh at sharp edges", 0.05 * 0.2),
        ("auto", CHARGED["faces"], "mesh at sharp edges", 3 * 1e-3 / 0.02),
        ("closed", {}, None, None),
    ],
)
def test_small_elements_at_the_sharp_edges_of_a_conductor(
    interface: str, faces: dict[str, Any], topic: str | None, size: float | None
) -> None:
    """Where opened faces leave room for them; not around what is no conductor."""
    can = {**PERMEABLE, "shape": {"kind": "cylinder", "radius": 0.02, "length": 0.05, "ends": "capped"}}
    field = {"ambient": {"field": "electric" if faces else "magnetic"}, "faces": faces}
    if not faces:
        field["ambient"]["applied_field"] = [0.0, 0.0, 1e3]
    made = plan(shell=can if not faces else {**SPHERE, "shape": can["shape"]}, model={"interface": interface}, **field)
    assert made.sizes.edges == (() if size is None else tuple((e, pytest.approx(size)) for e in ("end0", "end1")))
    assert topic is None or topic in {decision.topic for decision in made.decisions}


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_the_number_of_an_order_is_what_it_leaves_of_an_arc(order: int) -> None:
    size = 0.4  # the angle of an element
    decision = next(one for one in plan(discretisation={"order": order, "shell_size": 0.02 * size}).decisions
                    if one.topic == "order")  # fmt: skip
    angles = np.linspace(-0.5 * size, 0.5 * size, 2001)
    nodes = 0.5 * size * np.cos((2 * np.arange(order + 1) + 1) * math.pi / (2 * order + 2))
    left = [f(angles) - np.polynomial.Polynomial.fit(nodes, f(nodes), order)(angles) for f in (np.cos, np.sin)]
    assert decision.number is not None
    assert 0.5 * decision.number < np.hypot(*left).max() < 1.01 * decision.number
