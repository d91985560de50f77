"""The space around a shell, with the shell as an interface inside it: geometry and mesh, before its sides are told.

Boundaries are called ``shell``, ``outer`` (where the moving ambient ends), ``body0`` and so on, and ``plane`` (mirror
planes and the axis); materials ``outside``, ``beyond`` (the mapped exterior) and ``magnet0`` and so on (solid bodies).
Lengths are dimensionless.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import netgen.meshing as netgen
import numpy as np
from netgen.occ import Box, Glue, MoveTo, OCCGeometry, Pnt, WorkPlane
from netgen.occ import Sphere as SphereSolid
from ngsolve import BND, Mesh

from embedding.geometry.counting import refuse_too_large
from embedding.geometry.outline import CurveOutline, Outline, SurfaceOutline, generated
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes
from embedding.geometry.surface import positive_box

REACH = 1.5
"""Where the mapped exterior ends in the mesh, over where it begins."""
THINNEST = 1e-6
ACROSS_GAP = 1.0
"""Elements on the shell are at most this many times as large as the gap to a body."""


class BodyError(ValueError):
    """There is no room for the body ``number``."""

    def __init__(self, number: int, reason: str) -> None:
        self.number = number
        super().__init__(reason)


def raw_mesh(outline: Outline, reduction: Reduction, sizes: MeshSizes) -> netgen.Mesh:
    """Straight-sided mesh in which faces of the shell are called ``shell 0`` and so on (3D), edges ``shell`` (2D).

    Raises:
        BodyError: a body touches the shell or another body, or reaches beyond the end of space.
        TooLargeError: the mesh would not fit into memory.
        NoMeshError: the mesh generator gave up.
    """
    sizes = _near_bodies(outline, reduction, sizes)
    refuse_too_large(outline, reduction, sizes)
    space = _Space(reduction, sizes)
    if isinstance(outline, SurfaceOutline):
        outline.prepare(sizes)
        outline.number(sizes)
        whole = Glue([*space.parts(), outline.shape])
        for face in whole.faces:
            face.name = face.name or "plane"
        outline.keep(whole)
        geometry = OCCGeometry(whole)
    else:
        geometry = OCCGeometry(_section(outline, space, sizes), dim=2)
    return generated(geometry, _wanted(outline, sizes))


def _section(outline: CurveOutline, space: _Space, sizes: MeshSizes) -> Any:
    for edge in outline.edges:
        edge.name, edge.maxh = "shell", sizes.shell
    whole = Glue([*space.parts(), *outline.edges])
    for edge in whole.edges:
        edge.name = edge.name or "plane"
        if edge.name == "shell":
            edge.maxh = sizes.shell
            outline.name_ends(edge, sizes)
            if outline.kept:
                edge.partition = []
    return whole


def _wanted(outline: Outline, sizes: MeshSizes) -> netgen.MeshingParameters:
    """Element sizes. In space they are told at the vertices of a mesh of the shell alone: the size on a face does not
    hold for the elements that stand on it."""
    wanted = netgen.MeshingParameters(maxh=sizes.far, grading=sizes.grading)
    if isinstance(outline, SurfaceOutline):
        alone = outline.mesh(sizes)
        outline.number(sizes)
        for point, size in zip(*_local_sizes(alone), strict=True):
            wanted.RestrictH(*point, h=float(size))
    return wanted


def _local_sizes(mesh: Mesh) -> tuple[Any, Any]:
    """Places of the vertices of a surface mesh and the mean length of the edges that meet there."""
    points = np.array([v.point for v in mesh.vertices])
    corners = np.array([[v.nr for v in element.vertices] for element in mesh.Elements(BND)])
    ends = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [0, 2]]])
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    total = np.bincount(ends.ravel(), np.repeat(length, 2), len(points))
    return points, total / np.bincount(ends.ravel(), minlength=len(points))


def _near_bodies(outline: Outline, reduction: Reduction, sizes: MeshSizes) -> MeshSizes:
    """Elements on the shell no larger than the gap to the nearest body."""
    shapes = outline.edges if isinstance(outline, CurveOutline) else (outline.shape,)
    nearest = float("inf")
    for number, body in enumerate(sizes.bodies):
        solid = body.shape(reduction, 2 * sizes.radius)
        gap = min(shape.Distance(solid) for shape in shapes)
        if gap < THINNEST:
            raise BodyError(number, "it touches the shell")
        nearest = min(nearest, gap)
    return replace(sizes, shell=min(sizes.shell, ACROSS_GAP * nearest))


class _Space:
    """The parts of space between mirror planes, around the bodies, out to the outer boundary."""

    def __init__(self, reduction: Reduction, sizes: MeshSizes) -> None:
        self._reduction, self._sizes = reduction, sizes
        self._reach = 2 * REACH * sizes.radius

    def parts(self) -> list[Any]:
        """The ambient, the mapped exterior if there is one, and the solid bodies; all named."""
        bodies = [body.shape(self._reduction, self._reach) for body in self._sizes.bodies]
        window, inner = self._window(), self._ball(self._sizes.radius, "outer")
        self._check(bodies, inner)
        for number, body in enumerate(bodies):
            self._name(body, f"body{number}")
        parts = [self._filled(self._without(inner, bodies) * window, "outside")]
        if self._sizes.beyond:
            exterior = self._ball(REACH * self._sizes.radius, "infinity") - self._ball(self._sizes.radius, "outer")
            parts.append(self._filled(self._without(exterior, bodies) * window, "beyond"))
        for number, (body, shape) in enumerate(zip(self._sizes.bodies, bodies, strict=True)):
            if body.solid:
                parts.append(self._filled(shape * inner * window, f"magnet{number}"))
        return parts

    def _check(self, bodies: list[Any], inner: Any) -> None:
        for number, body in enumerate(bodies):
            if self._sizes.bodies[number].kind != "half-space" and self._measure(body - inner) > THINNEST:
                raise BodyError(number, "it reaches beyond the end of space")
            for other, earlier in enumerate(bodies[:number]):
                if self._measure(body * earlier) > THINNEST * self._measure(body):
                    raise BodyError(number, f"it overlaps with ambient.bodies.{other}")

    def _measure(self, shape: Any) -> float:
        parts = shape.solids if self._reduction.dimension == 3 else shape.faces
        return float(sum(part.mass for part in parts))

    @staticmethod
    def _without(part: Any, bodies: list[Any]) -> Any:
        for body in bodies:
            part = part - body
        return part

    def _ball(self, radius: float, name: str) -> Any:
        if self._sizes.box is not None:
            return self._box(name)
        centre = self._sizes.centre(self._reduction.dimension)
        if self._reduction.dimension == 3:
            ball = SphereSolid(Pnt(*centre), radius)
        else:
            ball = WorkPlane().Circle(*centre, radius).Face()
        self._name(ball, name)
        return ball

    def _box(self, name: str) -> Any:
        box = self._sizes.box or ()
        across, along = box[0], box[2 if self._reduction.name == "axisymmetric" else 1]
        if self._reduction.dimension == 3:
            shape = Box(Pnt(*(-b for b in box)), Pnt(*box))
        else:
            shape = MoveTo(-across, -along).Rectangle(2 * across, 2 * along).Face()
        self._name(shape, name)
        return shape

    def _window(self) -> Any:
        """The positive side of the mirror planes and of the axis; its faces are planes."""
        reach, planes = self._reach, self._reduction.planes
        if self._reduction.dimension == 3:
            window = positive_box(planes, reach)
        else:
            low = [0.0 if axis in planes else -reach for axis in "xy"]
            if self._reduction.name == "axisymmetric":
                low = [0.0, -reach]
            window = MoveTo(low[0], low[1]).Rectangle(reach - low[0], reach - low[1]).Face()
        self._name(window, "plane")
        return window

    def _name(self, shape: Any, name: str) -> None:
        for part in shape.faces if self._reduction.dimension == 3 else shape.edges:
            part.name = name

    def _filled(self, shape: Any, material: str) -> Any:
        if self._reduction.dimension == 3:
            shape.mat(material)
        else:
            shape.faces.name = material
        return shape
