"""Meshed bodies: which side is the top, what is measured, where the mirror planes are, and what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from ngsolve import (
    BND,
    CF,
    ET,
    H1,
    VOL,
    BilinearForm,
    GridFunction,
    InnerProduct,
    Integrate,
    IntegrationRule,
    SurfaceL2,
    ds,
    dx,
)

from embedding import Plate, Sphere
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from embedding.geometry.spaces import plane_mask
from tests.forms import BODIES, CLOSED, SHAPES, Array, body

SURROUNDED = tuple((name, radius) for name in CLOSED for radius in (0.0, 3.0))
EVERY = tuple((name, 0.0) for name in BODIES if name not in CLOSED) + SURROUNDED


def shell_points(domain: Domain) -> tuple[Array, Array]:
    """Positions and our normals at three points of every element of the shell."""
    rule = IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, 3)
    points = domain.mesh.MapToAllElements(rule, domain.shell)
    return np.asarray(domain.reduction.position(points)), np.asarray(CF(domain.normal)(points))


@pytest.mark.parametrize(("name", "radius"), EVERY)
def test_the_top_is_the_side_of_the_normal(name: str, radius: float) -> None:
    """Outwards on a closed body, +z on a flat one, on every element and whatever surrounds the shell."""
    place, normal = shell_points(body(name, 0.5, 3, radius=radius))
    up = place if name in CLOSED else np.eye(place.shape[1])[-1] + 0 * place
    alignment = np.einsum("ij,ij->i", normal, up) / np.linalg.norm(up, axis=1)
    assert alignment.min() > 0.99
    assert np.abs(np.linalg.norm(normal, axis=1) - 1).max() < 1e-12


@pytest.mark.parametrize("name", CLOSED)
def test_the_outside_is_outside(name: str) -> None:
    """The material that is called outside lies where the normal points, the other one behind it."""
    domain = body(name, 0.5, 2, radius=3.0)
    rule = IntegrationRule(ET.TET if domain.mesh.dim == 3 else ET.TRIG, 1)
    for side, beyond in (("outside", True), ("inside", False)):
        points = domain.mesh.MapToAllElements(rule, domain.mesh.Materials(domain.materials(side)))
        distance = np.linalg.norm(np.asarray(domain.reduction.position(points)), axis=1)
        assert np.all((distance > 0.99) == beyond)


@pytest.mark.parametrize(("name", "radius"), EVERY)
def test_areas(name: str, radius: float) -> None:
    domain = body(name, 0.4, 3, radius=radius)
    area = {"plate": 0.6, "disc": math.pi, "sphere": 4 * math.pi, "cylinder": 2 * math.pi}[BODIES[name][0]]
    assert domain.shell_integral(1.0) == pytest.approx(area, rel=1e-4)


@pytest.mark.parametrize("name", CLOSED)
def test_volumes(name: str) -> None:
    """Ball and shell of the ambient, counted for the whole body; and what the mid-surface encloses."""
    domain = body(name, 0.3, 3, radius=3.0)
    plane = domain.reduction.name == "plane-strain"
    inner, outer = (math.pi, math.pi * 9) if plane else (4 / 3 * math.pi, 4 / 3 * math.pi * 27)
    for side, volume in (("inside", inner), ("outside", outer - inner)):
        measured = Integrate(domain.reduction.measure * dx(domain.materials(side)), domain.mesh)
        assert measured == pytest.approx(volume, rel=1e-3)
    enclosed = domain.shell_integral(InnerProduct(domain.reduction.position, domain.normal) / (2 if plane else 3))
    assert enclosed == pytest.approx(inner, rel=1e-4)


@pytest.mark.parametrize("name", CLOSED)
def test_the_outer_boundary(name: str) -> None:
    domain = body(name, 0.5, 3, radius=3.0)
    plane = domain.reduction.name == "plane-strain"
    area = Integrate(domain.reduction.measure * domain.surface("outer"), domain.mesh)
    assert area == pytest.approx(6 * math.pi if plane else 36 * math.pi, rel=1e-3)


@pytest.mark.parametrize("name", ["octant", "sphere"])
def test_the_near_layer_is_all_that_touches_the_shell(name: str) -> None:
    domain = body(name, 0.4, 2, radius=3.0)
    on_shell = {v.nr for element in domain.mesh.Boundaries("shell").Elements() for v in element.vertices}
    for element in domain.mesh.Elements(VOL):
        touches = any(v.nr in on_shell for v in element.vertices)
        assert touches == element.mat.endswith("_near")
    assert domain.near("outside") == "outside_near"
    assert domain.near("inside") == "inside_near"


PARTS = {"octant": 8, "quarter disc": 4, "quarter ring": 4}


@pytest.mark.parametrize("name", PARTS)
def test_a_part_is_meshed_between_its_mirror_planes(name: str) -> None:
    for radius in (0.0, 3.0) if name in CLOSED else (0.0,):
        domain = body(name, 0.5, 2, radius=radius)
        assert domain.reduction.copies == PARTS[name]
        place = np.array([v.point for v in domain.mesh.vertices])
        for axis in domain.reduction.planes:
            across = place[:, "xyz".index(axis)]
            assert across.min() > -1e-9
            assert (np.abs(across) < 1e-9).sum() >= 1


@pytest.mark.parametrize(("name", "radius"), [("octant", 3.0), ("octant", 0.0), ("axisymmetric sphere", 3.0)])
def test_unknowns_on_a_plane(name: str, radius: float) -> None:
    """A function that vanishes on the plane has none of the plane's unknowns, and one that does not has some."""
    domain = body(name, 0.5, 3, radius=radius)
    space = H1(domain.mesh, order=3)
    for axis in range(domain.mesh.dim if name == "octant" else 1):
        mask = plane_mask(space, axis)
        field = GridFunction(space)
        coordinate = domain.reduction.position[axis]
        _set(field, coordinate, domain)
        assert np.abs(field.vec.FV().NumPy()[mask]).max() < 1e-10
        _set(field, CF(1.0), domain)
        assert np.abs(field.vec.FV().NumPy()[mask]).max() > 0.9


def _set(field: GridFunction, value: Any, domain: Domain) -> None:
    if domain.has_ambient:
        field.Set(value)
    else:
        field.Set(value, BND, definedon=domain.shell)


@pytest.mark.parametrize(
    ("name", "edges"),
    [
        ("plate", {"x0": 0.6, "x1": 0.6, "y0": 1.0, "y1": 1.0}),
        ("disc", {"rim": 2 * math.pi}),
        ("quarter disc", {"rim": 2 * math.pi}),
    ],
)
def test_rims(name: str, edges: dict[str, float]) -> None:
    """The true edges have their names and lengths; the indicator is 1 on them and 0 on every other element edge."""
    domain = body(name, 0.3, 3)
    assert set(domain.rims) == set(edges)
    for edge, length in edges.items():
        line = dx(definedon=domain.mesh.BBoundaries(edge))
        assert Integrate(domain.reduction.measure * line, domain.mesh) == pytest.approx(length, rel=1e-4)
        around = ds(definedon=domain.shell, element_boundary=True)
        marked = Integrate(domain.reduction.measure * domain.rim_indicator((edge,)) * around, domain.mesh)
        assert marked == pytest.approx(length, rel=1e-4)


def test_the_axisymmetric_rim_is_a_point() -> None:
    domain = body("axisymmetric disc", 0.3, 3)
    line = dx(definedon=domain.mesh.BBoundaries("rim"))
    assert Integrate(domain.reduction.measure * line, domain.mesh) == pytest.approx(2 * math.pi)
    assert domain.rim_indicator(("rim",))(domain.mesh(1.0, 0.0, BND)) == pytest.approx(1.0)
    assert domain.rim_indicator(("rim",))(domain.mesh(0.1, 0.0, BND)) == pytest.approx(0.0)


def test_plates_of_any_proportion_have_four_edges() -> None:
    for width in (0.01, 1.0, 50.0):
        domain = build(Plate(length=1.0, width=width), Reduction("3d"), MeshSizes(0.35, 0.35, 0.0, 0.3, 1))
        scale = max(1.0, width)
        for edge, length in (("x0", width), ("x1", width), ("y0", 1.0), ("y1", 1.0)):
            line = dx(definedon=domain.mesh.BBoundaries(edge))
            assert Integrate(CF(1.0) * line, domain.mesh) == pytest.approx(length / scale, rel=1e-9)


def test_curvature_and_sides_are_known_by_shape() -> None:
    expected = {"plate": (0.0, False), "disc": (0.0, False), "sphere": (-1.0, True), "infinite-cylinder": (-0.5, True)}
    for name in BODIES:
        domain = body(name, 0.8, 1)
        curvature = domain.shell_integral(domain.mean_curvature) / domain.shell_integral(1.0)
        assert (pytest.approx(curvature), domain.closed) == expected[domain.shape.kind]


def test_sides_that_cannot_be_told_apart_are_refused() -> None:
    """A flat mesh that claims to be a sphere: its normals point along the surface of the sphere."""
    flat = body("disc", 0.5, 1)
    pretended = Domain(flat.mesh, flat.reduction, SHAPES["sphere"], flat.sizes)
    assert isinstance(pretended.shape, Sphere)
    with pytest.raises(RuntimeError, match="cannot be told apart"):
        _ = pretended.normal


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_the_geometry_converges_with_its_order(order: int) -> None:
    errors = [abs(body("octant", size, order).shell_integral(1.0) / (4 * math.pi) - 1) for size in (0.5, 0.25)]
    assert errors[1] < errors[0] / 2 ** (order + 0.5)


@pytest.mark.parametrize("name", ["plate", "sphere"])
def test_no_jump_is_missed(name: str) -> None:
    """Of any jump, the square: exactly on a flat shell, and that of none is zero on a curved one."""
    domain = body(name, 0.5, 3)
    space = SurfaceL2(domain.mesh, order=domain.sizes.potential_order, definedon=domain.shell)
    trial, test = space.TnT()
    product = trial.Trace() * test.Trace()
    found, exact = (
        BilinearForm(product * integral).Assemble().mat.ToDense().NumPy()
        for integral in (domain.potential_surface(), ds("shell", bonus_intorder=8))
    )
    largest = np.abs(exact).max()
    if name == "plate":
        assert np.abs(found - exact).max() < 1e-13 * largest
    assert np.linalg.eigvalsh(found).min() > 0.5 * np.linalg.eigvalsh(exact).min()
