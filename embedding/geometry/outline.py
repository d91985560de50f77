"""The geometry of a mid-surface before it is meshed: faces in space, or edges that stand for them in a reduction.

Lengths are dimensionless. Edges of the shape carry its own names, edges on mirror planes ``symmetry_x`` and so on.
Curves, which stand for surfaces in the reductions, have named ends instead; ``axis`` is an end on the axis.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from netgen.meshing import MeshingParameters, MeshingStep
from netgen.occ import Edge, OCCGeometry, Pnt, Wire
from ngsolve import Mesh, specialcf

from embedding.geometry.facets import Facets
from embedding.geometry.sizes import AT_POINTS, MeshSizes
from embedding.scene.shapes.base import SHARP

CLOSE = 1e-6
SEAM = "seam"
"""Name of edges that only join faces of one smooth surface."""
SHARP_ANGLE = np.radians(30.0)
"""Around a conductor's edge the potential goes like r^(pi / (pi + angle)): above this it is worth small elements."""
Names = Callable[[Edge], str | None]


@dataclass(frozen=True)
class SurfaceOutline:
    """All faces of an OCC ``shape``; an edge for which ``name`` answers None keeps the name it has."""

    shape: Any
    name: Names

    def prepare(self, sizes: MeshSizes) -> None:
        """Name and size the faces and edges."""
        sharp = self._sharp if SHARP in dict(sizes.edges) else frozenset()
        for face in self.shape.faces:
            face.name = "shell"
        for edge in filter(real, self.shape.edges):
            edge.name = self.name(edge) or edge.name
            if edge.name:
                edge.maxh = sizes.along(edge.name)
            if edge in sharp:
                edge.maxh = min(edge.maxh, sizes.along(SHARP))

    @cached_property
    def _sharp(self) -> frozenset[Edge]:
        """Edges at which faces meet at an angle of at least ``SHARP_ANGLE``, found on a coarse mesh."""
        edges = [edge for edge in self.shape.edges if real(edge)]
        for face in self.shape.faces:
            face.name = "shell"
        for number, edge in enumerate(edges):
            edge.name = f"edge {number}"
        low, high = self.shape.bounding_box
        wanted = MeshingParameters(maxh=(high - low).Norm() / 5, perfstepsend=MeshingStep.MESHSURFACE)
        mesh = Mesh(generated(OCCGeometry(self.shape), wanted)).Curve(2)
        facets = Facets(mesh, mesh.Boundaries("shell"))
        kinks = facets.kinks(specialcf.normal(3), SHARP_ANGLE)
        return frozenset(edge for edge in edges if np.any(kinks & facets.named(edge.name)))

    def number(self, sizes: MeshSizes) -> None:
        """Name and size the faces for a mesh of the space around them."""
        for number, face in enumerate(self.shape.faces):
            face.name, face.maxh = f"shell {number}", sizes.shell

    def keep(self, whole: Any) -> None:
        """Say of the ``whole`` geometry, that the outline is part of, what its mesh must keep."""

    def mesh(self, sizes: MeshSizes) -> Mesh:
        """Mesh of the surface alone, as ``shell``.

        Raises:
            NoMeshError: the mesh generator gave up.
        """
        self.prepare(sizes)
        wanted = MeshingParameters(maxh=sizes.shell, grading=sizes.grading, perfstepsend=MeshingStep.MESHSURFACE)
        for point in sizes.points:
            wanted.RestrictH(*point, h=sizes.shell / AT_POINTS)
        return Mesh(generated(OCCGeometry(self.shape), wanted))


@dataclass(frozen=True)
class CurveOutline:
    """Connected OCC ``edges`` in the plane, with the ends of the edges named by ``name``; edges that are ``kept`` are
    not divided."""

    edges: tuple[Edge, ...]
    name: Callable[[Pnt], str]
    kept: bool = False

    def name_ends(self, shape: Any, sizes: MeshSizes) -> None:
        """Name and size the vertices of ``shape``, those of the curve or of what it became a part of."""
        for vertex in shape.vertices:
            vertex.name = self.name(vertex.p)
            if vertex.name in dict(sizes.edges):
                vertex.maxh = sizes.along(vertex.name)

    def mesh(self, sizes: MeshSizes) -> Mesh:
        """Mesh of the curve alone, as ``shell``.

        Raises:
            NoMeshError: the mesh generator gave up.
        """
        wire = Wire(list(self.edges))
        wire.edges.name = "shell"
        self.name_ends(wire, sizes)
        wanted = MeshingParameters(maxh=sizes.shell, grading=sizes.grading)
        return Mesh(generated(OCCGeometry(wire, dim=2), wanted))


Outline = SurfaceOutline | CurveOutline


class NoMeshError(RuntimeError):
    """The mesh generator gave up."""


def generated(geometry: OCCGeometry, wanted: MeshingParameters) -> Any:
    """The netgen mesh of a geometry.

    Raises:
        NoMeshError: the mesh generator gave up.
    """
    try:
        return geometry.GenerateMesh(mp=wanted)
    except Exception as error:  # netgen raises its own untyped exceptions
        raise NoMeshError(f"the mesh generator gave up ({error})") from error


def real(edge: Edge) -> bool:
    """Has the edge a length? Poles of curved faces are edges without one, which must not be asked for their place."""
    return bool(edge.mass > CLOSE)
