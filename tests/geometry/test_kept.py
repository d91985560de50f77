"""A mesh that is asked for again: the same to the last bit, and one of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from ngsolve import CF, ET, VOL, IntegrationRule, Mesh, x, y

from embedding import Sphere
from embedding.geometry import kept, meshing
from embedding.geometry.domain import build
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes

SIZES = MeshSizes(shell=0.4, far=2.0, radius=3.0, grading=0.4, order=2)
ROUND = Reduction("axisymmetric")


def places(mesh: Mesh) -> object:
    return np.asarray(CF((x, y))(mesh.MapToAllElements(IntegrationRule(ET.TRIG, 4), VOL)))


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept, "_kept", type(kept._kept)())


def test_the_same_again() -> None:
    first, again = (build(Sphere(radius=0.02), ROUND, SIZES) for _ in range(2))
    assert len(kept._kept) == 1
    assert first.mesh is not again.mesh
    np.testing.assert_array_equal(places(first.mesh), places(again.mesh))
    assert first.mesh.GetMaterials() == again.mesh.GetMaterials()
    assert first.mesh.GetBoundaries() == again.mesh.GetBoundaries()


def test_each_is_curved_alone() -> None:
    first, again = (kept.mesh(Sphere(radius=0.02), ROUND, SIZES).mesh for _ in range(2))
    straight = places(again)
    first.Curve(3)
    np.testing.assert_array_equal(places(again), straight)
    np.testing.assert_array_equal(places(kept.mesh(Sphere(radius=0.02), ROUND, SIZES).mesh), straight)
    again.Curve(3)
    np.testing.assert_array_equal(places(again), places(first))


def test_another_order_is_on_the_same_elements() -> None:
    build(Sphere(radius=0.02), ROUND, SIZES)
    again = build(Sphere(radius=0.02), ROUND, replace(SIZES, order=3))
    assert len(kept._kept) == 1
    kept._kept.clear()
    alone = build(Sphere(radius=0.02), ROUND, replace(SIZES, order=3))
    np.testing.assert_array_equal(places(again.mesh), places(alone.mesh))


def test_only_the_last_few_and_none_that_is_large(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = [replace(SIZES, far=2.0 + 0.1 * number) for number in range(kept.MOST + 2)]
    for sizes in asked:
        kept.mesh(Sphere(radius=0.02), ROUND, sizes)
    assert [sizes for _, _, sizes in kept._kept] == [replace(sizes, order=1) for sizes in asked[2:]]
    monkeypatch.setattr(kept, "LARGEST", 10)
    kept.mesh(Sphere(radius=0.02), ROUND, asked[0])
    assert [sizes.far for _, _, sizes in kept._kept] == [sizes.far for sizes in asked[2:]]


def test_what_was_refused_is_refused_again(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: object) -> meshing.Meshed:
        raise meshing.NoMeshError("none")

    monkeypatch.setattr(meshing, "mesh", none)
    for _ in range(2):
        with pytest.raises(meshing.NoMeshError):
            kept.mesh(Sphere(radius=0.02), ROUND, SIZES)
