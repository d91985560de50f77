"""Meshes of the mid-surface alone, for scenes without a field: nothing around the shell is meshed.

Lengths are dimensionless. Edges of the shape carry its own names, edges on mirror planes ``symmetry_x`` and so on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from netgen.meshing import MeshingStep
from netgen.occ import ArcOfCircle, Box, Edge, OCCGeometry, Pnt, Segment, Wire, WorkPlane
from netgen.occ import Sphere as SphereSolid
from ngsolve import Mesh

from embedding.geometry.reduction import Reduction

CLOSE = 1e-6


def plate(length: float, width: float, size: float) -> Mesh:
    """Rectangle [0, length] x [0, width] in z = 0 with edges x0, x1, y0, y1; normal +z."""
    face = WorkPlane().Rectangle(length, width).Face()

    def name(edge: Edge) -> str:
        middle = edge.center
        if abs(middle.x) < CLOSE or abs(middle.x - length) < CLOSE:
            return "x0" if abs(middle.x) < CLOSE else "x1"
        return "y0" if abs(middle.y) < CLOSE else "y1"

    return _surface(face, name, size)


def disc(reduction: Reduction, size: float) -> Mesh:
    """Unit disc in z = 0, or its radius in axisymmetry; edge ``rim``, normal +z."""
    if reduction.name == "axisymmetric":
        edge = Segment(Pnt(0, 0, 0), Pnt(1, 0, 0))
        return _curve([edge], lambda p: "axis" if p.x < CLOSE else "rim", size)
    face = _halved(WorkPlane().Circle(0, 0, 1).Face(), reduction.planes)
    return _surface(face, lambda edge: _on_plane(edge, reduction.planes) or "rim", size)


def sphere(reduction: Reduction, size: float) -> Mesh:
    """Unit sphere (or the part between the mirror planes), or its meridian in axisymmetry."""
    if reduction.name == "axisymmetric":
        arc = ArcOfCircle(Pnt(0, -1, 0), Pnt(1, 0, 0), Pnt(0, 1, 0))
        return _curve([arc], lambda p: "axis", size)
    ball = _halved(SphereSolid(Pnt(0, 0, 0), 1.0), reduction.planes)
    face = next(f for f in ball.faces if not _flat_on_plane(f, reduction.planes))
    return _surface(face, None, size)


def ring(reduction: Reduction, size: float) -> Mesh:
    """Cross-section of a unit cylinder: a circle, or the quarter between the mirror planes x and y."""
    if reduction.planes:
        half = math.sqrt(0.5)
        arcs = [ArcOfCircle(Pnt(1, 0, 0), Pnt(half, half, 0), Pnt(0, 1, 0))]
        return _curve(arcs, lambda p: "symmetry_x" if p.x < CLOSE else "symmetry_y", size)
    arcs = [
        ArcOfCircle(Pnt(1, 0, 0), Pnt(0, 1, 0), Pnt(-1, 0, 0)),
        ArcOfCircle(Pnt(-1, 0, 0), Pnt(0, -1, 0), Pnt(1, 0, 0)),
    ]
    return _curve(arcs, lambda p: "seam", size)


def positive_box(planes: tuple[str, ...], reach: float) -> Any:
    """The part of space on the positive side of the mirror ``planes``, within ``reach`` of the origin."""
    low = [0.0 if axis in planes else -reach for axis in "xyz"]
    return Box(Pnt(*low), Pnt(reach, reach, reach))


def _halved(shape: Any, planes: tuple[str, ...]) -> Any:
    return shape * positive_box(planes, 2.0) if planes else shape


def _flat_on_plane(face: Any, planes: tuple[str, ...]) -> bool:
    return any(abs(getattr(face.center, axis)) < CLOSE for axis in planes)


def _on_plane(edge: Edge, planes: tuple[str, ...]) -> str | None:
    points = [edge.start, edge.end, edge.center]
    for axis in planes:
        if all(abs(getattr(p, axis)) < CLOSE for p in points):
            return f"symmetry_{axis}"
    return None


def _surface(face: Any, name: Callable[[Edge], str] | None, size: float) -> Mesh:
    face.faces.name = "shell"
    # A sphere has degenerate edges at its poles, which must not be asked for their place: it is never named.
    if name is not None:
        for edge in face.edges:
            edge.name = name(edge)
    mesh = OCCGeometry(face).GenerateMesh(maxh=size, perfstepsend=MeshingStep.MESHSURFACE)
    return Mesh(mesh)


def _curve(edges: list[Edge], name: Callable[[Pnt], str], size: float) -> Mesh:
    wire = Wire(edges)
    wire.edges.name = "shell"
    for vertex in wire.vertices:
        vertex.name = name(vertex.p)
    return Mesh(OCCGeometry(wire, dim=2).GenerateMesh(maxh=size))
