"""Surfaces from STEP and BREP files: the same geometry, names, unit and sides as what was written."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from netgen.occ import ArcOfCircle, Axes, Axis, Compound, Cylinder, Glue, Pnt, Segment, Sphere, Wire, WorkPlane, Z
from ngsolve import CF, InnerProduct, Integrate, dx

from embedding import SceneError, SurfaceFile
from embedding.geometry.curvature import mesh_curvature
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction


def meshed(shape: SurfaceFile, size: float = 0.2, order: int = 3) -> Domain:
    return build(shape, Reduction("3d"), MeshSizes(size, size, 0.0, 0.3, order))


def length(domain: Domain, edge: str) -> float:
    line = dx(definedon=domain.mesh.BBoundaries(edge))
    return float(Integrate(CF(1.0) * line, domain.mesh)) * domain.shape.size


def roof(radius: float = 25.0, depth: float = 50.0) -> Any:
    """A cylindrical panel of 40 degrees, and a flat wing that hangs on its straight edge."""
    turn = math.radians(40)
    edge = Segment(Pnt(radius, 0, 0), Pnt(radius, 0, depth))
    panel = edge.Revolve(Axis((0, 0, 0), (0, 0, 1)), 40)
    start = (radius * math.cos(turn), radius * math.sin(turn), 0)
    wing = WorkPlane(Axes(start, n=(1, 0, 0), h=(0, 1, 0))).Rectangle(10, depth).Face()
    both = Glue([panel, wing])
    for face in both.faces:
        face.name = "wing" if abs(face.center.x - start[0]) < 1e-9 else "panel"
    for e in both.edges:
        if abs(e.center.z) < 1e-9:
            e.name = "foot"
        elif abs(e.center.x - radius) < 1e-9 and abs(e.center.y) < 1e-9:
            e.name = "crown"
    return both


def test_a_step_file_keeps_areas_names_and_edges(tmp_path: Path) -> None:
    written = tmp_path / "roof.step"
    roof().WriteStep(str(written))
    shape = SurfaceFile(path=str(written))
    assert {"foot", "crown"} < set(shape.edges)
    assert set(shape.faces) == {"panel", "wing"}
    assert shape.size == pytest.approx(0.05, rel=1e-5)  # the file is in mm
    assert not shape.closed
    domain = meshed(shape)
    panel, wing = 25 * math.radians(40) * 50e-6, 500e-6
    assert domain.shell_integral(1.0) * shape.size**2 == pytest.approx(panel + wing, rel=1e-5)
    for name, area in (("panel", panel), ("wing", wing)):
        measured = Integrate(CF(1.0), domain.mesh, definedon=domain.face(name)) * shape.size**2
        assert measured == pytest.approx(area, rel=1e-5)
    assert length(domain, "crown") == pytest.approx(0.05, rel=1e-6)
    assert length(domain, "foot") == pytest.approx(25e-3 * math.radians(40) + 10e-3, rel=1e-5)
    assert len(set(domain.rims)) == 5  # two unnamed edges opposite the foot, and one at the end of the wing
    assert domain.kinks.any() and not domain.junctions.any()
    assert domain.facets.parts.max() == 0
    assert domain.curvature_radius * shape.size == pytest.approx(0.025, rel=0.05)


def test_reading_leaves_the_names_alone(tmp_path: Path) -> None:
    written = tmp_path / "roof.step"
    roof().WriteStep(str(written))
    shape = SurfaceFile(path=str(written))
    before = shape.edges, shape.faces
    coarse, fine = (meshed(shape, size).facets.numbers for size in (0.3, 0.1))
    assert len(fine) > 4 * len(coarse)
    assert (shape.edges, shape.faces) == before


def test_a_brep_file_has_numbered_edges(tmp_path: Path) -> None:
    written = tmp_path / "roof.brep"
    roof().WriteBrep(str(written))
    shape = SurfaceFile(path=str(written), unit="1 m")
    assert shape.edges == tuple(f"edge{k}" for k in range(1, 7))
    assert shape.faces == ("face1", "face2")
    domain = meshed(shape)
    assert set(domain.rims) == set(shape.edges)
    assert domain.shell_integral(1.0) * shape.size**2 == pytest.approx(25 * math.radians(40) * 50 + 500, rel=1e-5)


def test_faces_that_only_touch_are_joined(tmp_path: Path) -> None:
    """Two squares of a compound that share no edge in the file, and three that meet in one."""
    frames = [
        Axes((0, 0, 0), n=(0, 0, 1), h=(1, 0, 0)),
        Axes((1, 0, 0), n=(0, 0, 1), h=(1, 0, 0)),
        Axes((1, 0, 0), n=(1, 0, 0), h=(0, 1, 0)),
    ]
    squares = [WorkPlane(frame).Rectangle(1, 1).Face() for frame in frames]
    for count, junction in ((2, False), (3, True)):
        written = tmp_path / f"{count}.step"
        Compound(squares[:count]).WriteStep(str(written))
        domain = meshed(SurfaceFile(path=str(written)))
        assert domain.junctions.any() == junction
        assert domain.facets.parts.max() == (2 if junction else 0)
        assert not domain.kinks.any()


@pytest.mark.parametrize("flip", [False, True])
def test_the_first_face_gives_the_side(tmp_path: Path, flip: bool) -> None:
    written = tmp_path / "square.step"
    for face, up in ((WorkPlane().Rectangle(1, 1).Face(), 1.0), (WorkPlane().Rectangle(1, 1).Face().Reversed(), -1.0)):
        face.WriteStep(str(written))
        domain = meshed(SurfaceFile(path=str(written), flip=flip))
        assert domain.shell_integral(domain.normal[2]) == pytest.approx(-up if flip else up, rel=1e-5)
        written.unlink()


def test_a_closed_file(tmp_path: Path) -> None:
    """A ball is closed; its area, volume and curvature."""
    written = tmp_path / "ball.step"
    Sphere(Pnt(0, 0, 0), 2.0).WriteStep(str(written))
    shape = SurfaceFile(path=str(written), unit="1 cm")
    assert shape.closed and shape.edges == ()
    domain = meshed(shape)
    unit = shape.size / 0.01
    assert domain.rims == ()
    assert domain.shell_integral(1.0) * unit**2 == pytest.approx(16 * math.pi, rel=1e-4)
    volume = domain.shell_integral(InnerProduct(domain.reduction.position, domain.normal)) / 3 * unit**3
    assert volume == pytest.approx(32 / 3 * math.pi, rel=1e-4)
    domain = meshed(shape, 0.1)
    mean = domain.shell_integral(mesh_curvature(domain.reduction, domain.sign)) / domain.shell_integral(1.0)
    assert mean / unit == pytest.approx(-0.5, rel=0.01)
    assert np.isfinite(domain.shell_integral(domain.mean_curvature))


def test_a_free_form_wire_is_refused_as_a_surface(tmp_path: Path) -> None:
    wire = tmp_path / "wire.brep"
    Wire([ArcOfCircle(Pnt(1, 0, 0), Pnt(0, 1, 0), Pnt(-1, 0, 0))]).WriteBrep(str(wire))
    broken = tmp_path / "broken.brep"
    broken.write_text("this is not a geometry")
    cases = (
        (wire, "there are no faces in wire.brep"),
        (broken, "broken.brep cannot be read; write it again from the program it comes from"),
        (tmp_path / "absent.step", "there is no file absent.step"),
        (tmp_path / "mesh.stl", "must be the name of a .step, .stp, .brep file"),
    )
    for path, reason in cases:
        with pytest.raises(SceneError) as caught:
            SurfaceFile(path=str(path))
        (problem,) = caught.value.problems
        assert problem.path == "path"
        assert problem.message.endswith(f"is not allowed: {reason}")


def test_elements_are_small_at_sharp_edges_alone(tmp_path: Path) -> None:
    """A can whose wall has two seams: the ends are sharp, named or not, and the seams are none."""
    written = tmp_path / "can.brep"
    Cylinder(Pnt(0, 0, 0), Z, 10.0, 30.0).WriteBrep(str(written))
    shape = SurfaceFile(path=str(written))
    whole = build(shape, Reduction("3d"), MeshSizes(0.3, 0.3, 0.0, 0.3, 2, edges=(("sharp", 0.05),)))
    assert whole.kinks.sum() == pytest.approx(2 * 2 * math.pi * 10 / (0.05 * 30), rel=0.15)  # two circles of 1.5 mm
    points = np.array([vertex.point for vertex in whole.mesh.vertices])
    ends = np.array([[vertex.nr for vertex in whole.mesh.edges[e].vertices] for e in np.flatnonzero(whole.kinks)])
    assert np.all(np.abs(np.abs(points[ends][..., 2] - 0.5) - 0.5) < 1e-6)
    halfway = np.abs(points[:, 2] - 0.5) < 0.2
    assert halfway.sum() < 60
