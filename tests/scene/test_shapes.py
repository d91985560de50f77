"""Shapes as they are stated: names of edges, what fits them, sizes, and what is refused."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

import math
from typing import Any

import pytest

from embedding import (
    Annulus,
    Arch,
    Cap,
    Cone,
    Cylinder,
    Disc,
    Discretisation,
    Ellipsoid,
    Hemisphere,
    InfiniteCylinder,
    Plate,
    Scene,
    Sphere,
    Strip,
    Torus,
    TSection,
)
from embedding.scene import Surface
from tests.scene.samples import MATERIAL, refusals

QUARTER = math.pi / 2
ALL: tuple[Surface, ...] = (
    Plate(length=2, width=1),
    Disc(radius=2),
    Annulus(inner_radius=1, outer_radius=2),
    Annulus(inner_radius=1, outer_radius=2, slit=True),
    Annulus(inner_radius=1, outer_radius=2, start=-0.3, angle=0.6),
    Sphere(radius=2),
    Cylinder(radius=2, length=3),
    Cylinder(radius=2, length=3, ends="capped"),
    Cylinder(radius=2, length=3, start=-0.3, angle=0.6, half=True),
    Cap(radius=2, half_angle=0.3),
    Hemisphere(radius=2),
    Hemisphere(radius=2, hole_half_angle=0.3, angle="90 deg"),
    Cone(radius=1, top_radius=2, height=3),
    Torus(radius=2, tube_radius=1),
    Ellipsoid(semi_axes=(1, 2, 3)),
    TSection(length=2),
    InfiniteCylinder(radius=2),
    Strip(length=2),
    Arch(radius=2, half_angle=0.5),
    Plate(length=2, width=1, centred=True),
)


def on(shape: Surface, point: tuple[float, float, float]) -> float:
    """How far a point is off the shape."""
    x, y, z = point
    r, away = math.hypot(x, y), math.hypot(x, y, z)
    match shape:
        case Sphere() | Cap() | Hemisphere():
            return abs(away - 2)
        case Cylinder():
            return min(abs(r - 2), abs(abs(z) - 1.5) + (0 if shape.closed else 9))
        case InfiniteCylinder() | Arch():
            return abs(r - 2) + abs(z)
        case Cone():
            return abs(r - 1 - z / 3)
        case Torus():
            return abs(math.hypot(r - 2, z) - 1)
        case Ellipsoid():
            return abs(x * x + y * y / 4 + z * z / 9 - 1)
        case TSection():
            return min(abs(x), abs(z - 2))
        case Strip():
            return abs(y) + abs(z)
    return abs(z)


@pytest.mark.parametrize("shape", ALL, ids=lambda shape: str(shape)[:60])
def test_sample_points_lie_on_the_shape(shape: Surface) -> None:
    points = shape.sample_points()
    assert len(points) >= 4
    assert max(on(shape, point) for point in points) < 1e-12
    assert max(math.hypot(*point) for point in points) > 0.4 * shape.size


@pytest.mark.parametrize("shape", ALL, ids=lambda shape: str(shape)[:60])
def test_mirror_images(shape: Surface) -> None:
    """Mirroring twice changes nothing, and every image is an edge of the shape."""
    for axis in shape.mirrors:
        for edge in shape.edges:
            image = shape.mirror_image(edge, axis)
            assert image in shape.edges
            assert shape.mirror_image(image, axis) == edge


@pytest.mark.parametrize("shape", ALL, ids=lambda shape: str(shape)[:60])
def test_a_shape_survives_toml(shape: Surface) -> None:
    scene = Scene(shell={"shape": shape, "thickness": 1e-3, "material": MATERIAL})  # type: ignore[arg-type]
    assert Scene.from_toml(scene.to_toml()) == scene


@pytest.mark.parametrize(
    ("shape", "edges", "reductions", "mirrors", "size", "radius"),
    [
        (ALL[2], ("inner", "outer"), ("3d", "axisymmetric"), ("x", "y"), 2, None),
        (ALL[3], ("inner", "outer", "lip0", "lip1"), ("3d",), (), 2, None),
        (ALL[4], ("inner", "outer", "side0", "side1"), ("3d",), ("y",), 2, None),
        (ALL[6], ("end0", "end1"), ("3d", "axisymmetric"), ("x", "y", "z"), 2, 2),
        (ALL[8], ("end0", "end1", "side0", "side1"), ("3d",), ("y",), 1.5, 2),
        (ALL[9], ("rim",), ("3d", "axisymmetric"), ("x", "y"), 2 * math.sin(0.3), 2),
        (ALL[11], ("rim", "hole", "side0", "side1"), ("3d",), (), 2, 2),
        (ALL[12], ("end0", "end1"), ("3d", "axisymmetric"), ("x", "y"), 2, math.sqrt(10) / 3),
        (ALL[13], (), ("3d", "axisymmetric"), ("x", "y", "z"), 2, 1),
        (ALL[14], (), ("3d",), ("x", "y", "z"), 3, 1 / 3),
        (ALL[15], ("bottom", "left", "right", "front", "back", "junction"), ("3d",), (), 2, None),
        (ALL[17], ("x0", "x1"), ("plane-strain",), (), 2, None),
        (ALL[19], ("x0", "x1", "y0", "y1"), ("3d",), ("x", "y"), 2, None),
        (ALL[18], ("end0", "end1"), ("plane-strain",), (), 2 * math.sin(0.5), 2),
    ],
)  # fmt: skip
def test_what_a_shape_tells(
    shape: Surface,
    edges: tuple[str, ...],
    reductions: tuple[str, ...],
    mirrors: tuple[str, ...],
    size: float,
    radius: Any,
) -> None:
    assert (shape.edges, shape.reductions, shape.mirrors) == (edges, reductions, mirrors)
    assert shape.size == pytest.approx(size)
    assert shape.curvature_radius == (radius if radius is None else pytest.approx(radius))
    assert shape.narrowest <= 2 * shape.size


def test_closed_shapes() -> None:
    closed = [shape.kind for shape in ALL if shape.closed]
    assert closed == ["sphere", "cylinder", "torus", "ellipsoid", "infinite-cylinder"]
    assert [shape.kind for shape in ALL if not shape.surroundable] == ["annulus", "t-section"]  # the slit one
    assert Ellipsoid(semi_axes=(1, 1, 2)).reductions == ("3d", "axisymmetric")


def test_angles_have_units() -> None:
    assert Cylinder(radius=1, length=1, angle="90 deg").angle == QUARTER
    assert Cylinder(radius=1, length=1, angle=QUARTER) == Cylinder(radius=1, length=1, angle="90 deg")
    assert Cap(radius=1, half_angle="0.5 rad").half_angle == 0.5


@pytest.mark.parametrize(
    ("build", "line"),
    [
        (lambda: Annulus(inner_radius=2, outer_radius=1), "inner_radius: 2.0 m is not allowed: must be less than outer_radius = 1.0 m"),
        (lambda: Annulus(inner_radius=1, outer_radius=2, slit=True, angle=1), "slit: true is not allowed: a sector is open already: leave out slit or angle"),
        (lambda: Cylinder(radius=1, length=1, start=1), 'start: 1.0 is not allowed: a sector needs an angle, such as angle = "90 deg"'),
        (lambda: Cylinder(radius=1, length=1, angle="360 deg"), "angle: 360 deg is not allowed: must be greater than 0 and at most 6.2769"),
        (lambda: Cylinder(radius=1, length=1, angle="3 m"), 'angle: 3 m is not allowed: "m" is a unit of length: must be an angle greater than 0 and at most 6.2769, such as "90 deg"'),
        (lambda: Cylinder(radius=1, length=1, ends="shut"), 'ends: "shut" is not allowed: must be "open" or "capped"'),
        (lambda: Cylinder(radius=1, length=1, ends="capped", half=True), "ends: capped is not allowed: only the whole cylinder can be capped"),
        (lambda: Cap(radius=1, half_angle=4), "half_angle: 4 rad is not allowed: must be greater than 0 and at most 3.13845"),
        (lambda: Hemisphere(radius=1, hole_half_angle="90 deg"), "hole_half_angle: 90 deg is not allowed: must be greater than 0 and at most 1.56923"),
        (lambda: Torus(radius=1, tube_radius=1), "tube_radius: 1.0 m is not allowed: must be less than radius = 1.0 m"),
        (lambda: Ellipsoid(semi_axes=(1, 2)), "semi_axes: [1, 2] is not allowed: must be a list of 3 components [x, y, z]"),
        (lambda: Discretisation(edge_size=3), 'edge_size: 3 is not allowed: must be a table of edges and sizes, such as { rim = "0.2 mm" }'),
        (lambda: Discretisation(edge_size={"rim": 0}), "edge_size.rim: 0 m is not allowed: must be greater than 0"),
    ],
)  # fmt: skip
def test_a_refusal(build: Any, line: str) -> None:
    assert refusals(build) == [line]


def test_refusals_between_parts() -> None:
    def scene(shape: Surface, **parts: Any) -> Any:
        return lambda: Scene(shell={"shape": shape, "thickness": 0.1, "material": MATERIAL}, **parts)  # type: ignore[arg-type]

    torus, strip = Torus(radius=1, tube_radius=0.04), Strip(length=1)
    assert refusals(scene(torus)) == [
        "shell.thickness: 0.1 m is not allowed: half of it must be less than shell.shape.tube_radius = 0.04 m, "
        "or the inner face crosses the centre of curvature"
    ]
    assert refusals(scene(strip, discretisation={"edge_size": {"rim": 1e-3}})) == [
        'discretisation.edge_size.rim: unknown edge: a shape of kind "strip" has "x0" or "x1"'
    ]
    assert refusals(scene(strip, path=[{"volume_ratio": 2}])) == [
        'path.0.volume_ratio: not allowed for a shape of kind "strip": only closed shells enclose a volume'
    ]


def test_a_table_of_sizes_cannot_be_changed() -> None:
    stated = Discretisation(edge_size={"rim": "1 mm"})
    assert stated.edge_size == {"rim": 1e-3}
    with pytest.raises(TypeError):
        stated.edge_size["rim"] = 1.0
    assert hash(stated) == hash(Discretisation(edge_size={"rim": 1e-3}))
