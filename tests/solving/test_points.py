"""Named points whose displacements are recorded at every step."""

from __future__ import annotations

import math

import pytest

from embedding import Scene, SceneError, load_scene, solve
from problems import cantilever_moment, charged_balloon

pytestmark = pytest.mark.usefixtures("unestimated")

POINTS = 'output.points={east=["20 mm", 0, 0], slanted=["12 mm", "16 mm", 0], top=[0, 0, "20 mm"]}'


@pytest.mark.parametrize(("reduction", "mesh"), [("axisymmetric", 1e-2), ("3d", 3e-2)])
def test_a_balloon_moves_outwards(reduction: str, mesh: float) -> None:
    """Every point of a sphere moves along its radius, the same way in every reduction, to the mesh's error."""
    changes = (f"model.reduction={reduction}", "discretisation.order=2", "path=[{steps = 3}]", POINTS)
    charged = charged_balloon.run(*changes)
    moved = 0.02 * (charged["stretch"] - 1.0)
    assert charged["u_east_x"] == pytest.approx(moved, rel=mesh)
    assert charged["u_slanted_x"] == pytest.approx(0.6 * moved, rel=mesh)
    assert charged["u_slanted_y"] == pytest.approx(0.8 * moved, rel=mesh)
    assert charged["u_top_z"] == pytest.approx(moved, rel=mesh)
    assert abs(charged["u_top_x"]).max() < 1e-12 * 0.02


def test_the_tip_of_a_rolled_strip_comes_back_to_the_clamp() -> None:
    stated = load_scene(cantilever_moment.SCENE)
    length = stated.shell.shape.size
    rolled = solve(stated.with_overrides([f"output.points={{tip=[{length}, 0, 0]}}"]))
    assert rolled["u_tip_x"][-1] == pytest.approx(-length, rel=1e-6)
    assert abs(rolled["u_tip_y"][-1]) < 1e-6 * length
    assert "u_tip_z" not in rolled.steps[-1].scalars


def test_a_point_off_the_shell_is_refused() -> None:
    away = charged_balloon.scene('output.points={tip=["21 mm", 0, 0]}')
    with pytest.raises(SceneError, match=r"output\.points\.tip: .* is not allowed: 0\.001 m away from the mid-surface"):
        solve(away)


def test_a_name_must_be_one() -> None:
    with pytest.raises(SceneError, match=r"output\.points"):
        charged_balloon.scene('output.points={"the tip"=[0, 0, 0.02]}')


def test_points_are_part_of_the_scene() -> None:
    stated = charged_balloon.scene(POINTS)
    assert Scene.from_toml(stated.to_toml()) == stated
    assert math.isclose(stated.output.points["slanted"][1], 0.016)
