"""Bodies beside the shell: holes and solids of the right volume, in space and in the reductions; what is refused."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from ngsolve import CF, Integrate

from embedding import Disc, InfiniteCylinder, SceneError, Sphere
from embedding.geometry.bodies import Body
from embedding.geometry.domain import Domain, MeshSizes, Shape, build
from embedding.geometry.reduction import Name, Reduction

PI = math.pi
RADIUS = 4.0
BALL = {"3d": 4 / 3 * PI * RADIUS**3, "axisymmetric": 4 / 3 * PI * RADIUS**3, "plane-strain": PI * RADIUS**2}
SHAPES: dict[str, Shape] = {
    "3d": Disc(radius=1.0), "axisymmetric": Disc(radius=1.0), "plane-strain": InfiniteCylinder(radius=1.0)
}  # fmt: skip
BODIES = {
    "sphere": Body("sphere", centre=(0.0, -2.3, -2.2), radius=0.6),
    "cylinder": Body("cylinder", centre=(0.0, -2.3, 2.0), radius=0.5, length=0.8),
    "box": Body("box", centre=(0.0, -2.2, -1.8), size=(1.0, 0.8, 1.2)),
    "half-space": Body("half-space", level=-2.0),
}
WAYS: list[tuple[Name, tuple[str, ...]]] = [
    ("3d", ("x",)),
    ("3d", ("x", "y")),
    ("axisymmetric", ()),
    ("plane-strain", ()),
]
KINDS = [
    (kind, reduction, planes)
    for kind in BODIES
    for reduction, planes in WAYS
    if not (kind == "box" and reduction == "axisymmetric")  # not a body of revolution
] + [("sphere", "3d", ())]  # fmt: skip


VOLUME: dict[str, Callable[[Body], float]] = {
    "sphere": lambda b: 4 / 3 * PI * b.radius**3,
    "cylinder": lambda b: PI * b.radius**2 * b.length,
    "box": lambda b: math.prod(b.size),
    "half-space": lambda b: BALL["3d"] / 2,
}
SECTION: dict[str, Callable[[Body], float]] = {
    "sphere": lambda b: PI * b.radius**2,
    "cylinder": lambda b: PI * b.radius**2,
    "box": lambda b: b.size[0] * b.size[1],
    "half-space": lambda b: BALL["plane-strain"] / 2,
}
SURFACE: dict[str, Callable[[Body], float]] = {
    "sphere": lambda b: 4 * PI * b.radius**2,
    "cylinder": lambda b: 2 * PI * b.radius * (b.radius + b.length),
    "box": lambda b: 2 * (b.size[0] * b.size[1] + b.size[1] * b.size[2] + b.size[2] * b.size[0]),
    "half-space": lambda b: PI * RADIUS**2,
}
OUTLINE: dict[str, Callable[[Body], float]] = {
    "sphere": lambda b: 2 * PI * b.radius,
    "cylinder": lambda b: 2 * PI * b.radius,
    "box": lambda b: 2 * (b.size[0] + b.size[1]),
    "half-space": lambda b: 2 * RADIUS,
}


def placed(kind: str, planes: tuple[str, ...], reduction: str, **changes: float | bool) -> Body:
    """The body of this kind, on the axis or on the mirror plane y where the scene has one."""
    body = BODIES[kind]
    on_axis = reduction == "axisymmetric" or "y" in planes
    keys = {name: getattr(body, name) for name in ("radius", "length", "size", "level")}
    centre = (0.0, 0.0, body.centre[2]) if on_axis else body.centre
    return Body(body.kind, centre=centre, **(keys | changes))  # type: ignore[arg-type]


def made(
    reduction: Name, planes: tuple[str, ...], *bodies: Body, shape: Shape | None = None, **sizes: object
) -> Domain:
    wanted = MeshSizes(0.4, 1.0, RADIUS, 0.6, 3, bodies=bodies, **sizes)
    return build(shape or SHAPES[reduction], Reduction(reduction, planes), wanted)


def volume(domain: Domain, materials: str) -> float:
    return float(Integrate(domain.reduction.measure, domain.mesh, definedon=domain.mesh.Materials(materials)))


@pytest.mark.parametrize("solid", [False, True])
@pytest.mark.parametrize(("kind", "reduction", "planes"), KINDS)
def test_volumes_and_surfaces(kind: str, reduction: Name, planes: tuple[str, ...], solid: bool) -> None:
    """A conductor is a hole, another body a material of its own; both have a boundary. Over a half-space space ends
    around a point of its surface."""
    body = placed(kind, planes, reduction, solid=solid)
    domain = made(reduction, planes, body)
    flat = reduction == "plane-strain"
    inside, surface = (SECTION, OUTLINE) if flat else (VOLUME, SURFACE)
    around = volume(domain, "outside.*|inside.*")
    assert around == pytest.approx(BALL[reduction] - inside[kind](body), rel=1e-3)
    assert ("magnet0" in domain.mesh.GetMaterials()) == solid
    if solid:
        assert volume(domain, "magnet0") == pytest.approx(inside[kind](body), rel=2e-3)
    area = Integrate(domain.reduction.measure, domain.mesh, definedon=domain.mesh.Boundaries("body0"))
    assert area == pytest.approx(surface[kind](body), rel=2e-3)
    assert domain.shell_integral(1.0) == pytest.approx(2 * PI if flat else PI, rel=1e-3)
    assert domain.unfolded


@pytest.mark.parametrize("kind", [None, "half-space", "sphere"])
@pytest.mark.parametrize(("reduction", "planes"), WAYS)
def test_the_region_beyond(reduction: Name, planes: tuple[str, ...], kind: str | None) -> None:
    """Between the outer boundary and infinity; a half-space takes half of it, another body nothing."""
    bodies = () if kind is None else (placed(kind, planes, reduction),)
    domain = made(reduction, planes, *bodies, beyond=True)
    flat, far = reduction == "plane-strain", 1.5 * RADIUS
    part = 0.5 if kind == "half-space" else 1.0
    whole = (1.5 ** (2 if flat else 3) - 1) * BALL[reduction]
    assert volume(domain, "beyond") == pytest.approx(part * whole, rel=1e-3)
    for name, radius in (("outer", RADIUS), ("infinity", far)):
        area = Integrate(domain.reduction.measure, domain.mesh, definedon=domain.mesh.Boundaries(name))
        assert area == pytest.approx(part * (2 * PI * radius if flat else 4 * PI * radius**2), rel=1e-3)


def test_bodies_are_numbered() -> None:
    """In the order in which they are given, holes and solids alike."""
    hole, level = Body("sphere", (0.0, -1.9, 0.5), radius=0.6), BODIES["half-space"]
    solid = Body("box", (0.0, 2.0, 0.2), size=(1.0, 0.8, 1.2), solid=True)
    domain = made("3d", ("x",), hole, solid, level)
    assert {"body0", "body1", "body2"} <= set(domain.mesh.GetBoundaries())
    assert volume(domain, "magnet1") == pytest.approx(0.96, rel=1e-9)
    assert {"magnet0", "magnet2"}.isdisjoint(domain.mesh.GetMaterials())


@pytest.mark.parametrize("gap", [0.3, 0.1])
@pytest.mark.parametrize(("reduction", "planes"), [("3d", ("x", "y")), ("axisymmetric", ())])
def test_elements_are_no_larger_than_the_gap(reduction: Name, planes: tuple[str, ...], gap: float) -> None:
    """A sphere over a conducting plane."""
    bodies = (Body("half-space", level=-1.0 - gap),)
    domain = made(reduction, planes, *bodies, shape=Sphere(radius=1.0))
    corners = domain.facets.points
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    close = corners.mean(axis=1)[:, -1] < -0.9
    assert sides[close].mean() < 1.3 * gap  # the mesh generator takes sizes as a guide
    assert sides[close].max() < 1.6 * gap


@pytest.mark.parametrize("reduction", ["3d", "axisymmetric", "plane-strain"])
@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (Body("sphere", (0.0, 0.0, 0.0), radius=1.0), "it touches the shell"),
        (Body("half-space", level=0.5), "it touches the shell"),
        (Body("half-space", level=-1.0), "it touches the shell"),
        (Body("sphere", (0.0, -3.8, 3.8), radius=0.5), "it reaches beyond the end of space"),
        (Body("cylinder", (0.0, 2.5, -3.0), radius=0.5, length=3.0), "it reaches beyond the end of space"),
        (Body("sphere", (0.0, 9.0, 9.0), radius=0.5), "it reaches beyond the end of space"),
        (Body("sphere", (0.0, 2.2, 2.2), radius=0.4), "it overlaps with ambient.bodies.0"),
    ],
)
def test_bodies_without_room(reduction: Name, body: Body, reason: str) -> None:
    """One sentence that names the body."""
    first = Body("sphere", (0.0, 2.2, 2.2), radius=0.5, solid=True)
    shape = InfiniteCylinder(radius=1.0) if reduction == "plane-strain" else Sphere(radius=1.0)
    if reduction == "plane-strain" and body.kind == "cylinder":
        body = Body("cylinder", (0.0, 3.8, 0.0), radius=0.5, length=3.0)
    for solid in (False, True):
        with pytest.raises(SceneError) as caught:
            made(reduction, (), first, Body(**(vars(body) | {"solid": solid})), shape=shape)
        assert str(caught.value) == f"ambient.bodies.1: not allowed here: {reason}"


def test_a_field_everywhere_is_continuous() -> None:
    """Solids share their boundary with the ambient: the total volume is that of the ball."""
    domain = made("3d", ("x",), placed("sphere", ("x",), "3d", solid=True), beyond=True)
    total = float(Integrate(CF(2.0), domain.mesh))
    assert total == pytest.approx(1.5**3 * BALL["3d"], rel=2e-3)
    elements = {element.mat: element for element in domain.mesh.Elements()}
    assert {"outside", "outside_near", "inside_near", "beyond", "magnet0"} == set(elements)
    interior = {v.nr for v in next(iter(domain.mesh.Boundaries("body0").Elements())).vertices}
    sharing = {e.mat for e in domain.mesh.Elements() if interior <= {v.nr for v in e.vertices}}
    assert sharing == {"outside", "magnet0"}
