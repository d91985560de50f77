"""Surfaces of revolution: one meridian, meshed as a curve in axisymmetry or revolved about the z axis in 3D."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from netgen.occ import ArcOfCircle, Axis, Edge, Pnt, Segment, Wire

from embedding.geometry.outline import CLOSE, SEAM, CurveOutline, Outline, SurfaceOutline
from embedding.geometry.reduction import Reduction
from embedding.geometry.surface import on_plane
from embedding.scene import Annulus, Cap, Cone, Cylinder, Hemisphere, Torus

Place = tuple[float, float]


@dataclass(frozen=True)
class Meridian:
    """Pieces from point to point of the half plane (r, z), r >= 0, and the names of points that become edges.

    A piece is straight, or an arc of a circle if ``vias`` holds a point between its ends. Equal ends close the curve.
    """

    points: tuple[Place, ...]
    vias: tuple[Place | None, ...]
    names: tuple[tuple[str, Place], ...] = ()

    def name(self, radius: float, height: float) -> str:
        """Name of a point of the meridian."""
        near = (name for name, (r, z) in self.names if math.hypot(r - radius, z - height) < CLOSE)
        return next(near, SEAM)

    def pieces(self, place: Callable[[Place], Pnt]) -> list[Edge]:
        """OCC edges of the pieces, with (r, z) put into space by ``place``."""
        ends = zip(self.points, self.vias, self.points[1:], strict=False)
        return [
            Segment(place(a), place(b)) if via is None else ArcOfCircle(place(a), place(via), place(b))
            for a, via, b in ends
        ]


def outline(meridian: Meridian, reduction: Reduction, sector: tuple[float, float]) -> Outline:
    """What ``meridian`` sweeps from the angle ``sector[0]`` to ``sector[1]`` (radians; whole turn allowed).

    The mirror planes x and y of ``reduction`` cut it down to its positive side. A mirror plane z must be respected by
    the meridian itself.
    """
    if reduction.name == "axisymmetric":
        pieces = meridian.pieces(lambda p: Pnt(p[0], p[1], 0))
        return CurveOutline(tuple(pieces), lambda p: "axis" if p.x < CLOSE else meridian.name(p.x, p.y))
    start, end = _cut(sector, reduction.planes)
    toward = (math.cos(start), math.sin(start))
    wire = Wire(meridian.pieces(lambda p: Pnt(p[0] * toward[0], p[0] * toward[1], p[1])))
    swept = wire.Revolve(Axis((0, 0, 0), (0, 0, 1)), math.degrees(end - start))
    full = end - start > 2 * math.pi - CLOSE

    def name(edge: Edge) -> str:
        mirror = on_plane(edge, reduction.planes)
        if mirror is not None:
            return mirror
        begin, middle = edge.start, edge.Value(sum(edge.parameter_interval) / 2)
        radius, same = math.hypot(middle.x, middle.y), abs(begin.z - middle.z) < CLOSE
        if same and abs(math.hypot(begin.x, begin.y) - radius) < CLOSE:
            return meridian.name(radius, middle.z)
        turned = (math.atan2(middle.y, middle.x) - start) % (2 * math.pi)
        return SEAM if full else "side0" if min(turned, 2 * math.pi - turned) < CLOSE else "side1"

    return SurfaceOutline(swept, name)


def _cut(sector: tuple[float, float], planes: tuple[str, ...]) -> tuple[float, float]:
    """Angles of the part of a sector on the positive side of the mirror planes x and y."""
    start, end = sector
    quarter = math.pi / 2
    if "x" in planes:  # only a whole turn is mirrored there
        return (0.0 if "y" in planes else -quarter), quarter
    return (0.0, min(end, 2 * quarter)) if "y" in planes else (start, end)


def sector(shape: Annulus | Cylinder | Cap | Hemisphere | Cone) -> tuple[float, float]:
    """Angles between which ``shape`` is revolved."""
    return shape.start, shape.start + (2 * math.pi if shape.angle is None else shape.angle)


def annulus(shape: Annulus) -> Meridian:
    """From the inner to the outer circle."""
    inner, outer = (shape.inner_radius / shape.size, 0.0), (shape.outer_radius / shape.size, 0.0)
    return Meridian((inner, outer), (None,), (("inner", inner), ("outer", outer)))


def cylinder(shape: Cylinder, mirrored: bool) -> Meridian:
    """From the lower to the upper end, caps included; with ``mirrored`` only from z = 0 up."""
    radius, (low, high) = shape.radius / shape.size, (z / shape.size for z in shape.heights)
    low = 0.0 if mirrored else low
    points: tuple[Place, ...] = ((radius, low), (radius, high))
    names = (("symmetry_z" if mirrored else "end0", points[0]), ("end1", points[1]))
    if shape.closed:
        points = (*(() if mirrored else ((0.0, low),)), *points, (0.0, high))
    return Meridian(points, (None,) * (len(points) - 1), names)


def cap(shape: Cap | Hemisphere) -> Meridian:
    """From the pole, or the hole around it, down to the rim."""
    radius = shape.radius / shape.size
    hole = shape.hole_half_angle or 0.0 if isinstance(shape, Hemisphere) else 0.0
    rim = math.pi / 2 if isinstance(shape, Hemisphere) else shape.half_angle

    def at(angle: float) -> Place:
        return radius * math.sin(angle) if angle > 0.0 else 0.0, radius * math.cos(angle)

    names = (("rim", at(rim)), *((("hole", at(hole)),) if hole else ()))
    return Meridian((at(hole), at(rim)), (at((hole + rim) / 2),), names)


def cone(shape: Cone) -> Meridian:
    """From z = 0 to the top."""
    low, high = (shape.radius / shape.size, 0.0), (shape.top_radius / shape.size, shape.height / shape.size)
    return Meridian((low, high), (None,), (("end0", low), ("end1", high)))


def torus(shape: Torus, mirrored: bool) -> Meridian:
    """The circle of the tube in two arcs; with ``mirrored`` only the upper one."""
    centre, tube = shape.radius / shape.size, shape.tube_radius / shape.size
    outside, inside = (centre + tube, 0.0), (centre - tube, 0.0)
    above, below = (centre, tube), (centre, -tube)
    if mirrored:
        return Meridian((outside, inside), (above,), (("symmetry_z", outside), ("symmetry_z", inside)))
    return Meridian((outside, inside, outside), (above, below))
