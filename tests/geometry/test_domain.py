"""Meshes and sides: the normal points to the top, areas and volumes are right, the near layer is what touches."""

from __future__ import annotations

import math

import numpy as np
import pytest
from ngsolve import VOL, InnerProduct, Integrate, ds, dx

from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from embedding.scene import Disc, InfiniteCylinder, Plate, Sphere

PLANES = ("x", "y", "z")
ALONE = {
    "plate": (Plate(length=2.0, width=1.0), Reduction("3d"), 0.5),
    "disc": (Disc(radius=3.0), Reduction("3d"), math.pi),
    "quarter disc": (Disc(radius=3.0), Reduction("3d", ("x", "y")), math.pi),
    "disc's radius": (Disc(radius=3.0), Reduction("axisymmetric"), math.pi),
    "sphere": (Sphere(radius=0.1), Reduction("3d"), 4 * math.pi),
    "octant": (Sphere(radius=0.1), Reduction("3d", PLANES), 4 * math.pi),
    "meridian": (Sphere(radius=0.1), Reduction("axisymmetric"), 4 * math.pi),
    "ring": (InfiniteCylinder(radius=5.0), Reduction("plane-strain"), 2 * math.pi),
    "quarter ring": (InfiniteCylinder(radius=5.0), Reduction("plane-strain", ("x", "y")), 2 * math.pi),
}
CLOSED = {name: ALONE[name] for name in ("sphere", "octant", "meridian", "ring", "quarter ring")}


def domain(name: str, radius: float = 0.0, order: int = 3) -> Domain:
    shape, reduction, _ = ALONE[name]
    return build(shape, reduction, MeshSizes(0.4, 1.5, radius, 0.3, order))


@pytest.mark.parametrize(("name", "radius"), [(name, 0.0) for name in ALONE] + [(name, 3.0) for name in CLOSED])
def test_the_area_is_that_of_the_whole_body(name: str, radius: float) -> None:
    assert domain(name, radius).shell_integral(1.0) == pytest.approx(ALONE[name][2], rel=2e-4)


@pytest.mark.parametrize("radius", [0.0, 3.0])
@pytest.mark.parametrize("name", CLOSED)
def test_the_normal_points_outwards_everywhere(name: str, radius: float) -> None:
    """Whatever the mesh's own normals do: x . N integrates to d times the enclosed volume (per length)."""
    made = domain(name, radius)
    flux = made.shell_integral(InnerProduct(made.reduction.position, made.normal))
    assert flux == pytest.approx(2 * math.pi if "ring" in name else 4 * math.pi, rel=5e-4)


@pytest.mark.parametrize("name", ["plate", "disc", "quarter disc", "disc's radius"])
def test_the_normal_of_a_flat_shell_points_up(name: str) -> None:
    made = domain(name)
    assert made.shell_integral(made.normal[made.mesh.dim - 1]) == pytest.approx(ALONE[name][2], rel=2e-4)


@pytest.mark.parametrize("name", CLOSED)
def test_both_sides_of_the_interface_are_meshed(name: str) -> None:
    made = domain(name, 3.0)
    ball, disc = 4 / 3 * math.pi, math.pi
    unit = disc if "ring" in name else ball
    power = 2 if "ring" in name else 3
    inside, outside = (
        Integrate(made.reduction.measure * dx(made.materials(side)), made.mesh) for side in ("inside", "outside")
    )
    assert inside == pytest.approx(unit, rel=1e-3)
    assert outside == pytest.approx(unit * (3**power - 1), rel=1e-3)
    assert Integrate(made.reduction.measure * ds("outer"), made.mesh) == pytest.approx(
        3 ** (power - 1) * ALONE[name][2], rel=1e-3
    )


def test_the_near_layer_is_what_touches_the_shell() -> None:
    made = domain("octant", 3.0)
    on_shell = {v.nr for e in made.shell.Elements() for v in e.vertices}
    for element in made.mesh.Elements(VOL):
        assert element.mat.endswith("_near") == any(v.nr in on_shell for v in element.vertices)


def test_sides_that_cannot_be_told_apart_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    made = domain("octant")
    monkeypatch.setattr(Domain, "_up", lambda self, positions: np.zeros_like(positions))
    with pytest.raises(RuntimeError, match="finer on the shell"):
        _ = Domain(made.mesh, made.reduction, made.shape, made.sizes).normal


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_geometry_converges_with_its_order(order: int) -> None:
    errors = [
        abs(build(*ALONE["octant"][:2], MeshSizes(size, size, 0.0, 0.3, order)).shell_integral(1.0) / 4 / math.pi - 1)
        for size in (0.5, 0.25)
    ]
    assert errors[1] < errors[0] / 2 ** (order + 0.5)
