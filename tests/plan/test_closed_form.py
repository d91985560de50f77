"""A shell that is stretched the same everywhere: its plan says by how much, before anything is solved."""

from __future__ import annotations

import re

import pytest

from embedding import Scene, solve
from embedding.plan import explain
from problems import charged_balloon, cylinder_inflation, grounded_balloon, permeable_sphere

pytestmark = pytest.mark.usefixtures("unestimated")


def told(scene: Scene) -> str:
    return next((one.reason for one in explain(scene).decisions if one.topic == "solution"), "")


THIN = ("shell.thickness=0.1 mm", "model.interface=closed", "path=[{steps=2}]")
CHARGED = charged_balloon.scene(*THIN, "faces.top.voltage=180 kV", "faces.bottom.voltage=180 kV")
INFLATED = cylinder_inflation.scene(*cylinder_inflation.at_thickness(0.001))


@pytest.mark.parametrize("scene", [CHARGED, INFLATED], ids=["charged", "inflated"])
def test_the_stretch_is_that_of_the_solve(scene: Scene) -> None:
    """The thin shell's, by one equation."""
    found = re.search(r"its stretch, ([0-9.]+) if it is thin", told(scene))
    assert found is not None
    assert float(found[1]) == pytest.approx(solve(scene)["stretch"][-1], rel=1e-4)


def test_where_it_is_not_known_nothing_is_told() -> None:
    """A grounded sphere around it makes the field stronger; a permeable shell is not pulled the same everywhere."""
    assert "if it is thin" not in told(grounded_balloon.scene())
    assert "one equation" in told(grounded_balloon.scene())
    assert told(permeable_sphere.scene()) == ""
