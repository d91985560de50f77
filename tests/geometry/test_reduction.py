"""Reductions: how vectors, points and components of the mesh stand in space."""

from __future__ import annotations

import numpy as np
import pytest

from embedding.geometry.reduction import Reduction

SOLID, MERIDIAN, SECTION = Reduction("3d"), Reduction("axisymmetric"), Reduction("plane-strain")


def test_points_in_space() -> None:
    flat = np.array([[1.0, 2.0], [3.0, -4.0]])
    assert MERIDIAN.embed(flat).tolist() == [[1.0, 0.0, 2.0], [3.0, 0.0, -4.0]]
    assert SECTION.embed(flat).tolist() == [[1.0, 2.0, 0.0], [3.0, -4.0, 0.0]]
    solid = np.array([[1.0, 2.0, 3.0]])
    assert SOLID.embed(solid) is solid


def test_vectors_on_the_mesh() -> None:
    vector = (1.0, 2.0, 3.0)
    assert SOLID.project(vector) == vector
    assert MERIDIAN.project(vector) == (0.0, 3.0)
    assert SECTION.project(vector) == (1.0, 2.0)


def test_components_of_a_direction() -> None:
    assert [SOLID.components(axis) for axis in "xyz"] == [(0,), (1,), (2,)]
    assert [MERIDIAN.components(axis) for axis in "xyz"] == [(0,), (0,), (1,)]
    assert [SECTION.components(axis) for axis in "xyz"] == [(0,), (1,), ()]
    assert [r.axes for r in (SOLID, MERIDIAN, SECTION)] == [("x", "y", "z"), ("r", "z"), ("x", "y")]


@pytest.mark.parametrize(("planes", "copies"), [((), 1), (("z",), 2), (("x", "y"), 4), (("x", "y", "z"), 8)])
def test_mirror_copies(planes: tuple[str, ...], copies: int) -> None:
    assert Reduction("3d", planes).copies == copies


def test_rigid_motions_are_as_many_as_the_mesh_can_show() -> None:
    assert [len(r.rigid_motions()) for r in (SOLID, MERIDIAN, SECTION)] == [6, 1, 3]
