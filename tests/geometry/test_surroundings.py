"""Shells inside an ambient: every shape in every reduction and between any of its mirror planes.

Against closed forms: areas, volumes, lengths of rims, normals. The sides of elements are told from points of the shell
and its exact normal, without the mesh's topology.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from netgen.occ import Axes, Axis, Glue, Pnt, Segment, WorkPlane
from ngsolve import BND, ET, VOL, Det, Integrate, IntegrationRule, dx, specialcf

from embedding import Disc, InfiniteCylinder, Plate, SceneError, Sphere, SurfaceFile, Torus
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from tests.geometry.shapes import CASES as ALONE
from tests.geometry.shapes import PI, Case, central, constant, flat, upwards

RADIUS, SIZE, ORDER = 3.0, 0.5, 2


def of_thick_torus(x: np.ndarray) -> np.ndarray:
    """Away from the circle of radius 1."""
    across = x * (1.0, 1.0, 0.0)
    away = x - across / np.linalg.norm(across, axis=1)[:, None]
    return np.asarray(away / np.linalg.norm(away, axis=1)[:, None])


CASES = {name: case for name, case in ALONE.items() if name not in ("T", "slit ring", "torus")} | {
    "plate": Case(Plate(length=1.0, width=0.6), 0.6, upwards(2), flat, {"x0": 0.6, "x1": 0.6, "y0": 1.0, "y1": 1.0}),
    "centred plate": Case(
        Plate(length=1.0, width=0.6, centred=True), 0.6, upwards(2), flat, {"x0": 0.6, "x1": 0.6, "y0": 1.0, "y1": 1.0}
    ),
    "disc": Case(Disc(radius=1.0), PI, upwards(2), flat, {"rim": 2 * PI}),
    "sphere": Case(Sphere(radius=1.0), 4 * PI, central, constant(-1.0), volume=4 / 3 * PI),
    "thick torus": Case(Torus(radius=1.0, tube_radius=0.6), 2.4 * PI**2, of_thick_torus, flat, volume=0.72 * PI**2),
    "tube": Case(InfiniteCylinder(radius=1.0), 2 * PI, central, constant(-0.5), volume=PI),
}


def _planes(case: Case, reduction: str) -> list[tuple[str, ...]]:
    """Any set of mirror planes in space; a cross-section is meshed whole or as a quarter."""
    mirrors = case.shape.mirrors
    if reduction == "3d":
        counts = (
            range(len(mirrors) + 1) if case is not CASES["prolate spheroid"] else (3,)
        )  # the oblate one stands for it
        return [some for count in counts for some in combinations(mirrors, count)]
    return [(), mirrors] if reduction == "plane-strain" and mirrors else [()]


EVERY = [
    (name, reduction, planes)
    for name, case in CASES.items()
    for reduction in case.shape.reductions
    for planes in _planes(case, reduction)
]


def _paced(entries: list[tuple[str, str, tuple[str, ...]]]) -> list[object]:
    """Bodies that are meshed whole or between all their mirror planes come first; the rest is slow."""

    def first(name: str, planes: tuple[str, ...]) -> bool:
        return not planes or planes == tuple(CASES[name].shape.mirrors)

    return [entry if first(entry[0], entry[2]) else pytest.param(*entry, marks=pytest.mark.slow) for entry in entries]


CLOSED = _paced([entry for entry in EVERY if CASES[entry[0]].volume is not None])
OPEN = _paced([entry for entry in EVERY if CASES[entry[0]].volume is None])


@cache
def surrounded(name: str, reduction: str, planes: tuple[str, ...], size: float = SIZE) -> Domain:
    sizes = MeshSizes(size, RADIUS / 2, RADIUS, 0.7, ORDER)
    return build(CASES[name].shape, Reduction(reduction, planes), sizes)  # type: ignore[arg-type]


def volume(domain: Domain, materials: str) -> float:
    return float(Integrate(domain.reduction.measure * dx(materials), domain.mesh))


def rim_length(domain: Domain) -> float:
    """Of the rims of the whole body, from corner to corner; in two dimensions around the axis or per length."""
    places = np.array([v.point for v in domain.mesh.vertices])
    if domain.mesh.dim == 3:
        a, b = places[domain.rim_edges[:, 0]], places[domain.rim_edges[:, 1]]
        return float(domain.reduction.copies * np.linalg.norm(a - b, axis=1).sum())
    at = places[domain.rim_vertices, 0]
    return float((2 * PI * at).sum() if domain.reduction.name == "axisymmetric" else len(at))


@pytest.mark.parametrize(("name", "reduction", "planes"), _paced(EVERY))
def test_areas_volumes_and_names(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Measures of the whole body, to the error of coarse elements of order 2; names of boundaries, and of edges, which
    supports ask for; no folded element."""
    case, domain = CASES[name], surrounded(name, reduction, planes)
    assert domain.shell_integral(1.0) == pytest.approx(case.area, rel=3e-3)
    ball = PI * RADIUS**2 if reduction == "plane-strain" else 4 / 3 * PI * RADIUS**3
    assert volume(domain, "inside.*|outside.*") == pytest.approx(ball, rel=6e-3)
    assert set(domain.mesh.GetMaterials()) <= {"outside", "outside_near", "inside", "inside_near"}
    boundaries = {"shell", "outer"} | ({"plane"} if planes or reduction == "axisymmetric" else set())
    assert set(domain.mesh.GetBoundaries()) == boundaries
    names = set(domain.mesh.GetBBoundaries())
    shown = set(case.shape.edges) & names
    assert shown | {case.shape.mirror_image(edge, axis) for axis in planes for edge in shown} == set(case.shape.edges)
    rule = IntegrationRule(ET.TET if domain.mesh.dim == 3 else ET.TRIG, 4)
    places = domain.mesh.MapToAllElements(rule, domain.mesh.Materials(".*"))
    assert np.asarray(Det(specialcf.JacobianMatrix(domain.mesh.dim))(places)).min() > 0


@pytest.mark.parametrize(("name", "reduction", "planes"), CLOSED)
def test_closed_shells_enclose_their_volume(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    domain = surrounded(name, reduction, planes)
    assert volume(domain, domain.materials("inside")) == pytest.approx(CASES[name].volume, rel=6e-3)
    assert not domain.open
    assert domain.rims == ()
    assert len(domain.rim_vertices) == len(domain.rim_edges) == 0


@pytest.mark.parametrize(("name", "reduction", "planes"), OPEN)
def test_rims(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Where the mesh's topology says that the shell ends, its named edges lie, and they are as long as they should be.

    The chord of an angle a misses a^2 / 24 of its arc; a = 0.75 around the smallest hole.
    """
    case, domain = CASES[name], surrounded(name, reduction, planes)
    assert domain.open
    assert domain.far("inside") is None
    assert rim_length(domain) == pytest.approx(sum(case.edges[edge] for edge in case.true_edges), rel=0.024)
    if domain.mesh.dim == 3:
        assert {frozenset(edge) for edge in domain.rim_edges.tolist()} == {
            frozenset(v.nr for v in element.vertices)
            for edge in case.edges
            for element in domain.mesh.BBoundaries(edge).Elements()
        }
    swapped = {case.shape.mirror_image(edge, axis) for axis in planes for edge in domain.rims}
    assert set(domain.rims) | swapped == case.true_edges


@pytest.mark.parametrize(("name", "reduction", "planes"), _paced(EVERY))
def test_sides(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Every element of the shell has one neighbour on each side, the one its exact normal points to on top.

    Elements that touch the shell elsewhere than in its rims lie on the side of the part they touch; elements that do
    not touch it are no neighbours.
    """
    domain = surrounded(name, reduction, planes)
    mesh, facets = domain.mesh, domain.facets
    places = domain.reduction.embed(np.array([v.point for v in mesh.vertices]))
    corners = np.array([[v.nr for v in element.vertices] for element in mesh.Elements(VOL)])
    materials = np.array([element.mat for element in mesh.Elements(VOL)])
    centres, middles = places[corners].mean(axis=1), places[facets.corners].mean(axis=1)
    normals = CASES[name].normal(domain.reduction.embed(facets.at_centres(domain.reduction.position)))
    has = np.zeros((len(corners), len(places)), bool)
    has[np.arange(len(corners))[:, None], corners] = True
    for facet, normal, middle in zip(facets.corners, normals, middles, strict=True):
        beside = np.flatnonzero(has[:, facet].all(axis=1))
        height = (centres[beside] - middle) @ normal
        assert len(beside) == 2
        assert sorted(materials[beside[np.argsort(height)]]) == ["inside_near", "outside_near"]
        assert height.min() < 0 < height.max()
        assert materials[beside[np.argmax(height)]] == "outside_near"
    touches = has[:, np.unique(facets.corners)].any(axis=1)
    assert np.array_equal(touches, np.char.endswith(materials.astype(str), "_near"))
    for vertex in np.setdiff1d(facets.corners, domain.rim_vertices).tolist():
        assert set(materials[has[:, vertex]]) == {"inside_near", "outside_near"}


@pytest.mark.parametrize("name", ["annulus", "plate"])
def test_elements_between_rims_have_sides(name: str) -> None:
    """In a row of elements from rim to rim, and in corners of a plate, elements touch the shell with corners on rims
    only; those that share an inner edge with it have a side all the same."""
    domain = surrounded(name, "3d", (), 0.5)
    height = np.array([v.point[2] for v in domain.mesh.vertices])
    rims = {frozenset(edge) for edge in domain.rim_edges.tolist()}
    edges = [frozenset(edge) for facet in domain.facets.corners.tolist() for edge in combinations(facet, 2)]
    inner = {edge for edge in edges if edge not in rims and edge <= set(domain.rim_vertices.tolist())}
    found = set()
    for element in domain.mesh.Elements(VOL):
        corners = [v.nr for v in element.vertices]
        if any(frozenset(edge) in inner for edge in combinations(corners, 2)):
            assert element.mat == ("outside_near" if height[corners].sum() > 0 else "inside_near")
            found.add(element.mat)
    assert found == {"outside_near", "inside_near"}


@pytest.mark.slow
def test_no_element_is_folded(monkeypatch: pytest.MonkeyPatch) -> None:
    """The mesh of these sizes has elements that fold when they are curved; a somewhat finer one is taken, or none."""
    shape, reduction = CASES["prolate spheroid"].shape, Reduction("3d")
    sizes = MeshSizes(0.4, 1.5, RADIUS, 0.5, 2)
    domain = build(shape, reduction, sizes)
    assert domain.unfolded
    assert domain.sizes.grading < sizes.grading
    monkeypatch.setattr(Domain, "unfolded", False)
    with pytest.raises(SceneError, match="^discretisation.shell_size: elements .* are folded: make"):
        build(CASES["sphere"].shape, Reduction("3d", ("x", "y", "z")), sizes)


def test_a_box_around_a_shell() -> None:
    for reduction, planes, box, exact in (
        ("3d", ("x", "y"), (2.0, 1.5, 2.5), 60.0),
        ("3d", (), (2.0, 1.5, 2.5), 60.0),
        ("axisymmetric", (), (2.0, 2.0, 2.5), 20 * PI),
    ):
        sizes = MeshSizes(SIZE, 1.0, RADIUS, 0.5, 2, box=box)
        domain = build(Disc(radius=1.0), Reduction(reduction, planes), sizes)  # type: ignore[arg-type]
        assert volume(domain, ".*") == pytest.approx(exact, rel=1e-12)
        assert domain.shell_integral(1.0) == pytest.approx(PI, rel=1e-3)
        assert "outer" in domain.mesh.GetBoundaries()


def test_small_elements_along_edges() -> None:
    """Where asked for, also in space, where the mesh of the shell is not that of the shell alone."""
    sizes = MeshSizes(0.4, 1.5, RADIUS, 0.5, 1, (("end1", 0.08),))
    for reduction, planes in (("3d", ("x", "y")), ("axisymmetric", ())):
        domain = build(CASES["cylinder"].shape, Reduction(reduction, planes), sizes)  # type: ignore[arg-type]
        height = domain.facets.points[:, :, -1].mean(axis=1)
        length = np.linalg.norm(domain.facets.points[:, 1] - domain.facets.points[:, 0], axis=1)
        assert length[height > 0.9].max() < 0.16
        assert length[height < -0.5].max() > 0.2


@pytest.mark.parametrize("size", [0.5, 0.3])
@pytest.mark.parametrize("name", ["sphere", "disc"])
def test_the_shell_has_the_size_that_is_asked_for(name: str, size: float) -> None:
    """Mean length of the edges, within a third."""
    domain = surrounded(name, "3d", ("x", "y"), size)
    corners = domain.facets.points
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    assert lengths.mean() == pytest.approx(size, rel=1 / 3)


def test_faces_of_a_file(tmp_path: Path) -> None:
    """A panel with a wing in space: two named faces, their areas, edges, and the function that is 1 on one of them."""
    turn, radius, depth = math.radians(40), 25.0, 50.0
    panel = Segment(Pnt(radius, 0, 0), Pnt(radius, 0, depth)).Revolve(Axis((0, 0, 0), (0, 0, 1)), 40)
    start = (radius * math.cos(turn), radius * math.sin(turn), 0)
    both = Glue([panel, WorkPlane(Axes(start, n=(1, 0, 0), h=(0, 1, 0))).Rectangle(10, depth).Face()])
    for face in both.faces:
        face.name = "wing" if abs(face.center.x - start[0]) < 1e-9 else "panel"
    for edge in both.edges:
        if abs(edge.center.z) < 1e-9:
            edge.name = "foot"
    written = tmp_path / "roof.step"
    both.WriteStep(str(written))
    shape = SurfaceFile(path=str(written))
    domain = build(shape, Reduction("3d"), MeshSizes(0.2, 1.5, RADIUS, 0.5, 3))
    exact = {"panel": radius * turn * depth * 1e-6, "wing": 500e-6}
    for name, area in exact.items():
        measured = Integrate(1.0, domain.mesh, definedon=domain.face(name)) * shape.size**2
        assert measured == pytest.approx(area, rel=5e-4)
        covered = domain.shell_integral(domain.covered((name,))) * shape.size**2
        assert covered == pytest.approx(area, rel=5e-4)
    assert domain.shell_integral(domain.covered(("panel", "wing"))) * shape.size**2 == pytest.approx(
        sum(exact.values()), rel=1e-4
    )
    assert domain.open and set(shape.edges) <= set(domain.mesh.GetBBoundaries())
    assert domain.shape.size * rim_length(domain) == pytest.approx(2e-3 * (radius * turn + 10 + depth), rel=1e-2)
    assert len(domain.mesh.GetBoundaries()) == len(domain.face_numbers)
    for element in domain.mesh.Elements(BND):
        assert (domain.face_numbers[element.index] >= 0) == (element.mat == "shell")
