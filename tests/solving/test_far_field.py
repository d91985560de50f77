"""A permeable balloon in a uniform field, with both far fields at different radii."""

from __future__ import annotations

import pytest

from embedding import load_scene, solve
from problems import permeable_sphere

pytestmark = pytest.mark.usefixtures("unestimated")

MESH_NOISE = 1e-5
"""Meshes of different ambients differ beside the shell too: seen 4e-6 of the stretch."""


def stretch(far_field: str, radius: int) -> float:
    """The largest, after few steps on a fine mesh; ``radius`` in multiples of the sphere's, 20 mm."""
    path = "path=[{steps = 2, field = 0.0}, {steps = 2}]"
    space = (f"model.far_field={far_field}", f"ambient.radius={20 * radius} mm", "discretisation.shell_size=2 mm")
    return solve(load_scene(permeable_sphere.SCENE, (path, *space))).steps[-1].scalars["stretch_max"]


@pytest.mark.slow
def test_the_map_does_not_feel_the_radius_and_robin_does() -> None:
    """The long balloon has a part of degree 3, which Robin's condition misses; it falls with the seventh power."""
    near, far = stretch("infinite", 2), stretch("infinite", 4)
    assert near == pytest.approx(far, abs=MESH_NOISE)
    assert stretch("robin", 2) - far > 10 * MESH_NOISE
    assert stretch("robin", 4) == pytest.approx(far, abs=2 * MESH_NOISE)
