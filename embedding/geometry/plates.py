"""Flat mid-surfaces that are more than one simple face: the slit ring and the T."""

from __future__ import annotations

import math

from netgen.occ import ArcOfCircle, Axes, Compound, Edge, Face, Glue, Pnt, Segment, Wire, WorkPlane

from embedding.geometry.outline import CLOSE, SEAM, SurfaceOutline


def slit_ring(inner: float, outer: float) -> SurfaceOutline:
    """Ring cut along the positive x axis: two half rings that share their edge at negative x, but not the other one.

    Edges ``inner`` and ``outer``, and the lips ``lip0`` (of the half y >= 0) and ``lip1``.
    """
    upper = _half_ring(inner, outer, 1.0, Segment(Pnt(-inner, 0, 0), Pnt(-outer, 0, 0)))
    shared = next(edge for edge in upper.edges if edge.center.x < -CLOSE and abs(edge.center.y) < CLOSE)
    lower = _half_ring(inner, outer, -1.0, shared)
    for half, lip in ((upper, "lip0"), (lower, "lip1")):
        next(edge for edge in half.edges if abs(edge.center.y) < CLOSE and edge.center.x > CLOSE).name = lip

    def name(edge: Edge) -> str | None:
        if abs(edge.center.y) < CLOSE:
            return None if edge.center.x > 0 else SEAM
        return "outer" if math.hypot(edge.start.x, edge.start.y) > (inner + outer) / 2 else "inner"

    return SurfaceOutline(Compound([Face(upper), Face(lower)]), name)


def _half_ring(inner: float, outer: float, side: float, shared: Edge) -> Wire:
    def arc(radius: float) -> Edge:
        return ArcOfCircle(Pnt(radius, 0, 0), Pnt(0, side * radius, 0), Pnt(-radius, 0, 0))

    # the shared edge first: a wire gives the edges that follow the ends of the earlier ones, and so makes them anew
    return Wire([shared, arc(outer), Segment(Pnt(inner, 0, 0), Pnt(outer, 0, 0)), arc(inner)])


def t_section() -> SurfaceOutline:
    """Unit plate x = 0 under the unit plate z = 1, joined along the line ``junction``."""
    vertical = WorkPlane(Axes((0, 0, 0), n=(1, 0, 0), h=(0, 1, 0))).Rectangle(1, 1).Face()
    top = WorkPlane(Axes((-0.5, 0, 1), n=(0, 0, 1), h=(1, 0, 0))).Rectangle(1, 1).Face()

    def name(edge: Edge) -> str:
        middle = edge.center
        if abs(middle.y) < CLOSE or abs(middle.y - 1) < CLOSE:
            return "front" if abs(middle.y) < CLOSE else "back"
        if abs(abs(middle.x) - 0.5) < CLOSE:
            return "left" if middle.x < 0 else "right"
        return "bottom" if middle.z < 0.5 else "junction"

    return SurfaceOutline(Glue([vertical, top]), name)
