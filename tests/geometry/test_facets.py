"""How elements hang together: slits, junctions, kinks, and one side for many faces."""

from __future__ import annotations

import math

import netgen.meshing as netgen
import numpy as np
import pytest
from netgen.occ import Axes, Glue, WorkPlane
from ngsolve import H1, GridFunction, Integrate, Mesh, ds

from embedding import Plate, SceneError
from embedding.geometry import kept, meshing
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.facets import Facets, OneSidedError
from embedding.geometry.outline import SurfaceOutline
from embedding.geometry.reduction import Reduction
from embedding.geometry.spaces import scalar_mask
from tests.geometry.shapes import BODIES, CASES, body

SIZES = MeshSizes(0.3, 0.3, 0.0, 0.3, 2)


def folded(angle: float, *, reverse: bool = False) -> Domain:
    """A unit square in z = 0 and one that starts from its edge x = 1, turned up by ``angle`` degrees."""
    turn = math.radians(angle)
    flat = WorkPlane().Rectangle(1, 1).Face()
    frame = Axes((1, 0, 0), n=(-math.sin(turn), 0, math.cos(turn)), h=(math.cos(turn), 0, math.sin(turn)))
    raised = WorkPlane(frame).Rectangle(1, 1).Face()
    mesh = SurfaceOutline(Glue([flat, raised.Reversed() if reverse else raised]), lambda edge: "x0").mesh(SIZES)
    return Domain(mesh, Reduction("3d"), Plate(length=2.0, width=1.0), SIZES)


def test_the_slit_is_cut() -> None:
    """The lips share no unknown though they lie in the same place, and a field may jump across them."""
    domain = body("slit ring", "3d", size=0.15)
    mesh, space = domain.mesh, H1(domain.mesh, order=3)
    lips = [scalar_mask(space, mesh.BBoundaries(lip)) for lip in ("lip0", "lip1")]
    assert not np.any(lips[0] & lips[1])
    assert lips[0].sum() == lips[1].sum() > 4
    jump = GridFunction(space)
    jump.vec.FV().NumPy()[lips[0]] = 1.0
    around = ds(definedon=domain.shell, element_boundary=True)
    lengths = [Integrate(jump * domain.rim_indicator((lip,)) * around, mesh) for lip in ("lip0", "lip1")]
    assert lengths[0] > 0.1
    assert lengths[1] == 0.0
    assert domain.facets.parts.max() == 0
    assert domain.facets.neighbours[domain.facets.named("seam")].tolist() == [2] * int(
        domain.facets.named("seam").sum()
    )


@pytest.mark.parametrize(("name", "reduction", "planes"), BODIES)
def test_junctions_and_kinks(name: str, reduction: str, planes: tuple[str, ...]) -> None:
    """Only the T has a junction and only the capped cylinder kinks; at any order of the geometry."""
    for order in (1, 3):
        domain = body(name, reduction, planes, 0.4, order)
        facets = domain.facets
        junction = facets.named("junction")
        assert np.array_equal(domain.junctions, junction)
        assert junction.any() == (name == "T")
        ends = facets.named("end0|end1") if name == "capped cylinder" else np.zeros(facets.count, bool)
        assert np.array_equal(domain.kinks, ends)
        assert ends.any() == (name == "capped cylinder")


@pytest.mark.parametrize("name", ["T", "capped cylinder", "torus"])
def test_masks_of_facets(name: str) -> None:
    """Edges of the mesh by number: those of the junction or the kinks have the ends that lie there."""
    domain = body(name, "3d")
    marked = np.flatnonzero(domain.junctions | domain.kinks)
    edges = list(domain.mesh.edges)
    places = np.array([domain.mesh[v].point for number in marked for v in edges[number].vertices]).reshape(-1, 3)
    if name == "T":
        assert np.abs(places[:, [0, 2]] - (0.0, 1.0)).max() < 1e-9
    elif name == "capped cylinder":
        assert np.abs(np.abs(places[:, 2]) - 1).max() < 1e-9
        assert np.abs(np.hypot(places[:, 0], places[:, 1]) - 1).max() < 1e-9
    else:
        assert len(places) == 0


@pytest.mark.parametrize("angle", [0.0, 5.0, 90.0])
@pytest.mark.parametrize("reverse", [False, True])
def test_one_side_across_faces(angle: float, reverse: bool) -> None:
    """Faces that are oriented against each other get one side over a fold, and the fold is found."""
    domain = folded(angle, reverse=reverse)
    place, normal = (domain.facets.at_centres(f) for f in (domain.reduction.position, domain.normal))
    turn = math.radians(angle)
    expected = np.where(place[:, :1] < 1, (0.0, 0.0, 1.0), (-math.sin(turn), 0.0, math.cos(turn)))
    assert np.abs(normal - expected).max() < 1e-12
    assert isinstance(domain.sign, float) != reverse
    fold = np.zeros(domain.facets.count, bool)
    for edge in domain.mesh.edges:
        ends = np.array([domain.mesh[v].point for v in edge.vertices])
        fold[edge.nr] = np.all(np.abs(ends[:, [0, 2]] - (1.0, 0.0)) < 1e-9)
    assert np.array_equal(domain.kinks, fold & (angle > 0))
    assert domain.junctions.sum() == 0


def test_one_side_on_curves() -> None:
    """Segments of the axisymmetric capped cylinder, three curves in a row."""
    domain = body("capped cylinder", "axisymmetric")
    assert domain.facets.parts.max() == 0
    assert domain.kinks.sum() == 2


def moebius(pieces: int, twist: bool) -> Mesh:
    """A band of triangles around the z axis that closes after half a turn about itself, or without one."""
    mesh = netgen.Mesh(dim=3)
    points = []
    for k in range(pieces):
        angle = 2 * math.pi * k / pieces
        lean = angle / 2 if twist else 0.0
        for side in (-0.3, 0.3):
            radius = 1 + side * math.cos(lean)
            place = (radius * math.cos(angle), radius * math.sin(angle), side * math.sin(lean))
            points.append(mesh.Add(netgen.MeshPoint(netgen.Pnt(*place))))
    face = mesh.Add(netgen.FaceDescriptor(bc=1, domin=1, domout=0, surfnr=1))
    mesh.SetBCName(0, "shell")
    for k in range(pieces):
        a, b = points[2 * k], points[2 * k + 1]
        c, d = points[(2 * k + 2) % (2 * pieces)], points[(2 * k + 3) % (2 * pieces)]
        if twist and k == pieces - 1:
            c, d = d, c
        mesh.Add(netgen.Element2D(face, [a, c, b]))
        mesh.Add(netgen.Element2D(face, [b, c, d]))
    return Mesh(mesh)


def test_a_surface_with_one_side_is_refused() -> None:
    band, strip = (Facets(mesh, mesh.Boundaries("shell")) for mesh in (moebius(20, False), moebius(20, True)))
    assert abs(band.turns.sum()) == 40
    assert band.parts.max() == 0
    with pytest.raises(OneSidedError):
        _ = strip.turns


def alone(mesh: Mesh) -> meshing.Meshed:
    none = np.zeros((0, 2), np.int64)
    return meshing.Meshed(mesh, (0,), none[:, 0], none)


def test_bad_meshes_end_in_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    shape, sizes = CASES["annulus"].shape, MeshSizes(0.3, 0.3, 0.0, 0.3, 1)
    monkeypatch.setattr(kept, "mesh", lambda *_: alone(moebius(20, False)))
    with pytest.raises(SceneError, match="discretisation.shell_size: .* has holes"):
        build(shape, Reduction("3d"), sizes)
    monkeypatch.setattr(Facets, "on_edges", True)
    monkeypatch.setattr(kept, "mesh", lambda *_: alone(moebius(20, True)))
    with pytest.raises(SceneError, match="only one side"):
        build(shape, Reduction("3d"), sizes)


def test_every_element_has_its_own_sign() -> None:
    """Turned elements inside one face do not matter either: every second triangle of a band."""
    mesh = moebius(20, False)
    facets = Facets(mesh, mesh.Boundaries("shell"))
    turned = facets.corners.copy()
    turned[::2] = turned[::2, ::-1]
    facets.corners = turned
    facets.of_element = np.where(np.arange(40)[:, None] % 2 == 0, facets.of_element[:, [1, 0, 2]], facets.of_element)
    assert np.array_equal(facets.turns, np.where(np.arange(40) % 2 == 0, 1, -1))


def test_neighbours_of_elements() -> None:
    """Euler's number of the open cylinder is 0, of the torus 0 and of the ellipsoid 2."""
    for name, expected in (
        ("cylinder", 0),
        ("torus", 0),
        ("oblate spheroid", 2),
        ("cap", 1),
        ("annulus", 0),
        ("slit ring", 1),
    ):
        facets = body(name, "3d").facets
        vertices = len(np.unique(facets.corners))
        assert vertices - (facets.neighbours > 0).sum() + len(facets.numbers) == expected
        assert len(CASES[name].shape.edges) == 0 or (facets.neighbours == 1).any()


def test_curvature_radius() -> None:
    for name, radius in (("torus", 0.3), ("cylinder", 1.0), ("annulus", math.inf), ("oblate spheroid", 0.36)):
        assert body(name, "3d", size=0.5).curvature_radius == pytest.approx(radius)
    assert body("annulus", "3d").is_flat and not body("T", "3d").is_flat and not body("torus", "3d").is_flat
    assert body("strip", "plane-strain").is_flat and not body("arch", "plane-strain").is_flat
