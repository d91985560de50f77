"""Solved scenes, from the solver through the archive to the picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from embedding import (
    EdgeTraction,
    Loads,
    NeoHookean,
    Plate,
    Scene,
    Shell,
    Sphere,
    Stage,
    Support,
    open_archive,
    solve,
)
from embedding.view import can_render, history_plot, picture

MATERIAL = NeoHookean(shear_modulus="100 kPa")
PLATE = Scene(
    name="pulled_plate",
    shell=Shell(shape=Plate(length="50 mm", width="30 mm"), thickness="1 mm", material=MATERIAL),
    supports=(Support(where="x0", fix=("x", "y", "z")), Support(where="surface", fix=("z",))),
    loads=Loads(edge_tractions=(EdgeTraction(edge="x1", traction=(30.0, 0.0, 0.0)),)),
    path=(Stage(steps=2),),
)
BALLOON = Scene(
    name="inflated_balloon",
    shell=Shell(shape=Sphere(radius="20 mm"), thickness="1 mm", material=MATERIAL),
    path=(Stage(steps=2, volume_ratio=2.0),),
)


@pytest.mark.parametrize("scene", [pytest.param(PLATE, marks=pytest.mark.slow), BALLOON], ids=["plate", "balloon"])
def test_from_the_scene_to_the_picture(scene: Scene, tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    solution = solve(scene, archive=path)
    archive = open_archive(path)
    assert solution.archive == path
    assert archive.steps == solution.steps
    assert archive.scene_object() == scene
    assert archive.result.name == "CONVERGED"
    assert archive.error is not None and solution.error is not None
    assert archive.error.parts == solution.error.parts
    np.testing.assert_array_equal(archive.scalars["stretch"], solution["stretch"])
    stretch = archive.block("shell").field("stretch")
    assert 1 < np.mean(stretch) < archive.scalars["stretch_max"][-1] + 1e-6
    history_plot(path, tmp_path / "history.png")
    if can_render():
        picture(path, tmp_path / "picture.png")
