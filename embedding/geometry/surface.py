"""Mid-surfaces of one face each: plate, disc, sphere, ellipsoid, and the curves of the plane.

Where to find what: ``outline`` says what a geometry is before it is meshed. Lengths are dimensionless.
"""

from __future__ import annotations

import math
from typing import Any

from netgen.occ import ArcOfCircle, Axes, Box, Compound, Edge, Pnt, Segment, WorkPlane
from netgen.occ import Ellipsoid as EllipsoidSolid
from netgen.occ import Sphere as SphereSolid

from embedding.geometry.outline import CLOSE, SEAM, CurveOutline, Outline, SurfaceOutline
from embedding.geometry.reduction import Reduction


def plate(length: float, width: float, planes: tuple[str, ...] | None = None) -> SurfaceOutline:
    """Rectangle [0, length] x [0, width] in z = 0 with edges x0, x1, y0, y1; normal +z.

    With ``planes``, mirror planes or none, its middle is the origin.
    """
    x, y = (0.0, 0.0) if planes is None else (-length / 2, -width / 2)
    face = _halved(WorkPlane().MoveTo(x, y).Rectangle(length, width).Face(), planes or ())

    def name(edge: Edge) -> str:
        middle = edge.center
        for axis, at, low, high in (("x", middle.x, x, x + length), ("y", middle.y, y, y + width)):
            if min(abs(at - low), abs(at - high)) < CLOSE:
                return f"{axis}0" if abs(at - low) < CLOSE else f"{axis}1"
        raise ValueError("an edge of a rectangle lies on none of its sides")

    return SurfaceOutline(face, lambda edge: on_plane(edge, planes or ()) or name(edge))


def disc(reduction: Reduction) -> Outline:
    """Unit disc in z = 0, or its radius in axisymmetry; edge ``rim``, normal +z."""
    if reduction.name == "axisymmetric":
        edge = Segment(Pnt(0, 0, 0), Pnt(1, 0, 0))
        return CurveOutline((edge,), lambda p: "axis" if p.x < CLOSE else "rim")
    face = _halved(WorkPlane().Circle(0, 0, 1).Face(), reduction.planes)
    return SurfaceOutline(face, lambda edge: on_plane(edge, reduction.planes) or "rim")


def sphere(reduction: Reduction) -> Outline:
    """Unit sphere (or the part between the mirror planes), or its meridian in axisymmetry."""
    if reduction.name == "axisymmetric":
        half = math.sqrt(0.5)
        lower = ArcOfCircle(Pnt(0, -1, 0), Pnt(half, -half, 0), Pnt(1, 0, 0))
        upper = ArcOfCircle(Pnt(1, 0, 0), Pnt(half, half, 0), Pnt(0, 1, 0))
        return CurveOutline((lower, upper), lambda p: "axis" if p.x < CLOSE else SEAM)
    ball = _halved(SphereSolid(Pnt(0, 0, 0), 1.0), reduction.planes)
    return SurfaceOutline(_curved_faces(ball, reduction), lambda edge: on_plane(edge, reduction.planes) or SEAM)


def ellipsoid(semi_axes: tuple[float, float, float], reduction: Reduction) -> Outline:
    """Ellipsoid with the semi-axes along x, y and z, or its meridian in axisymmetry (the first two are equal)."""
    if reduction.name == "axisymmetric":
        across, along = semi_axes[0], semi_axes[2]
        frame, radii = Axes((0, 0, 0)), (across, along)
        if along > across:  # the major axis comes first and lies along the x of the frame
            frame, radii = Axes((0, 0, 0), h=(0, 1, 0)), (along, across)
        half = WorkPlane(frame).Ellipse(*radii).Face() * WorkPlane().MoveTo(0, -2).Rectangle(2, 4).Face()
        arcs = [edge for edge in half.edges if abs(edge.center.x) > CLOSE]
        return CurveOutline(tuple(arcs), lambda p: "axis" if p.x < CLOSE else SEAM)
    a, b, c = semi_axes
    frame = Axes((0, 0, 0), n=(0, 0, 1), h=(1, 0, 0))
    solid = _halved(EllipsoidSolid(frame, c, a, b), reduction.planes)  # the first radius lies along n
    return SurfaceOutline(_curved_faces(solid, reduction), lambda edge: on_plane(edge, reduction.planes) or SEAM)


def ring(reduction: Reduction) -> CurveOutline:
    """Cross-section of a unit cylinder: a circle, or the quarter between the mirror planes x and y."""
    if reduction.planes:
        half = math.sqrt(0.5)
        arcs = [ArcOfCircle(Pnt(1, 0, 0), Pnt(half, half, 0), Pnt(0, 1, 0))]
        return CurveOutline(tuple(arcs), lambda p: "symmetry_x" if p.x < CLOSE else "symmetry_y")
    arcs = [
        ArcOfCircle(Pnt(1, 0, 0), Pnt(0, 1, 0), Pnt(-1, 0, 0)),
        ArcOfCircle(Pnt(-1, 0, 0), Pnt(0, -1, 0), Pnt(1, 0, 0)),
    ]
    return CurveOutline(tuple(arcs), lambda p: SEAM)


def strip() -> CurveOutline:
    """The segment from 0 to 1 on the x axis, with ends x0 and x1."""
    edge = Segment(Pnt(0, 0, 0), Pnt(1, 0, 0))
    return CurveOutline((edge,), lambda p: "x0" if p.x < 0.5 else "x1")


def arch(radius: float, half_angle: float) -> CurveOutline:
    """The arc within ``half_angle`` of the y axis around the origin, with ends end0 (negative x) and end1."""
    x, y = radius * math.sin(half_angle), radius * math.cos(half_angle)
    arc = ArcOfCircle(Pnt(-x, y, 0), Pnt(0, radius, 0), Pnt(x, y, 0))
    return CurveOutline((arc,), lambda p: "end0" if p.x < 0 else "end1")


def positive_box(planes: tuple[str, ...], reach: float) -> Any:
    """The part of space on the positive side of the mirror ``planes``, within ``reach`` of the origin."""
    low = [0.0 if axis in planes else -reach for axis in "xyz"]
    return Box(Pnt(*low), Pnt(reach, reach, reach))


def on_plane(edge: Edge, planes: tuple[str, ...]) -> str | None:
    """``symmetry_x`` and so on for an edge that lies on one of the coordinate ``planes``, else None."""
    points = [edge.start, edge.end, edge.center]
    for axis in planes:
        if all(abs(getattr(p, axis)) < CLOSE for p in points):
            return f"symmetry_{axis}"
    return None


def _halved(shape: Any, planes: tuple[str, ...]) -> Any:
    return shape * positive_box(planes, 2.0) if planes else shape


def _curved_faces(solid: Any, reduction: Reduction) -> Any:
    """The faces of a solid that do not lie on a mirror plane; where its seam lies between the planes there are two."""
    flat = (any(abs(getattr(face.center, axis)) < CLOSE for axis in reduction.planes) for face in solid.faces)
    return Compound([face for face, is_flat in zip(solid.faces, flat, strict=True) if not is_flat])
