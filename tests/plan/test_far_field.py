"""Where space ends: Robin's condition where everything lies well inside, else the infinite map."""

from __future__ import annotations

import math
from typing import Any

import pytest

from embedding import Scene
from embedding.plan import explain
from embedding.plan.far_field import reach_of

SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": 0.02},
    "thickness": 5e-4,
    "material": {"law": "neo-hookean", "shear_modulus": 1e6},
    "relative_permeability": 100.0,
}
IRON = {"relative_permeability": 10.0}


def scene(model: dict[str, Any] | None = None, **ambient: Any) -> Scene:
    field = {"field": "magnetic", "applied_field": [0.0, 0.0, 1.0], **ambient}
    return Scene.model_validate({"shell": SPHERE, "ambient": field, "model": model or {}})


def planned(**given: Any) -> tuple[float, bool, str]:
    plan = explain(scene(**given))
    chosen = {decision.topic: decision.choice for decision in plan.decisions}
    return plan.sizes.radius, plan.sizes.beyond, chosen["far field"]


def test_robin_where_it_is_good_to_four_digits() -> None:
    """0.02 (1 / 4)^5 is 2e-5; at 3 radii 8e-5; below, more than 1e-4."""
    assert planned() == (4.0, False, "second-order Robin")
    assert planned(radius=0.06)[2] == "second-order Robin"
    assert planned(radius=0.05) == (2.5, True, "infinite map")


def test_pinned() -> None:
    assert planned(model={"far_field": "infinite"}) == (3.0, True, "infinite map")
    assert planned(model={"far_field": "infinite"}, radius=0.04) == (2.0, True, "infinite map")
    assert planned(model={"far_field": "robin"}, radius=0.04) == (2.0, False, "second-order Robin")
    assert planned(model={"far_field": "infinite"}, outer="grounded") == (4.0, False, "grounded")


@pytest.mark.parametrize(
    ("body", "reach"),
    [
        ({"kind": "sphere", "centre": [0.0, 0.0, 0.06], "radius": 0.02, **IRON}, 4.0),
        (
            {"kind": "cylinder", "centre": [0.0, 0.0, 0.06], "radius": 0.03, "length": 0.04, **IRON},
            math.hypot(1.5, 4.0),
        ),
        ({"kind": "box", "centre": [0.0, 0.0, -0.06], "size": [0.04, 0.06, 0.04], **IRON}, math.hypot(1.0, 1.5, 4.0)),
        ({"kind": "half-space", "level": -0.03, "potential": 0.0}, 2.5),
    ],
)
def test_bodies_lie_inside(body: dict[str, Any], reach: float) -> None:
    """By their farthest point from the origin; over a half-space it is the shell's from the point below it."""
    with_body = scene(bodies=[body])
    assert with_body.ambient is not None
    assert reach_of(with_body, with_body.ambient) == pytest.approx(reach)
