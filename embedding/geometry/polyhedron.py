"""A deformed shell as a geometry of its own: each of its elements a flat face, or a straight edge, that is not divided.

A mesh of the space around it has the same elements on the shell.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import netgen.meshing as netgen
import numpy as np
import numpy.typing as npt
from netgen.occ import Face, Glue, Pnt, Segment, Wire
from ngsolve import Mesh

from embedding.geometry.facets import INNER, Integers
from embedding.geometry.matching import nearest_of
from embedding.geometry.outline import CurveOutline, SurfaceOutline
from embedding.geometry.sizes import MeshSizes

Floats = npt.NDArray[np.float64]
WIDE = 1.5
"""Largest size of the elements at a facet, over its own."""


@dataclass(frozen=True)
class Polyhedron:
    """Simplices ``corners`` (n, d) over vertices at ``places`` (vertices, d), with the number of the shape's face that
    each belongs to, and the names of facets, by their vertices, that lie on edges (in the plane: ends) of the shape."""

    corners: Integers
    places: Floats
    faces: Integers
    names: Mapping[frozenset[int], str]

    def outline(self) -> SurfaceOutline | CurveOutline:
        """The geometry."""
        return self._curve() if self.places.shape[1] == 2 else self._surface()

    def _named(self, places: list[list[float]]) -> str:
        """Name of the facet with its vertices at ``places``."""
        return self.names.get(frozenset(nearest_of(self.places, np.array(places)).tolist()), INNER)

    def _curve(self) -> CurveOutline:
        points = self.places[self.corners]
        edges = tuple(Segment(Pnt(*a, 0.0), Pnt(*b, 0.0)) for a, b in points)

        def name(point: Any) -> str:
            return self._named([[point.x, point.y]])

        return CurveOutline(edges, name, kept=True)

    def _surface(self) -> SurfaceOutline:
        faces = []
        for corners, number in zip(self.places[self.corners], self.faces, strict=True):
            a, b, c = (Pnt(*corner) for corner in corners)
            face = Face(Wire([Segment(a, b), Segment(b, c), Segment(c, a)]))
            face.name = f"shell {number}"
            faces.append(face)

        def name(edge: Any) -> str:
            return self._named([[vertex.p.x, vertex.p.y, vertex.p.z] for vertex in edge.vertices])

        return _Triangles(Glue(faces), name, corners=self.corners, places=self.places)


@dataclass(frozen=True)
class _Triangles(SurfaceOutline):
    """The outline of a polyhedron."""

    corners: Integers
    places: Floats

    def prepare(self, sizes: MeshSizes) -> None:
        for edge in self.shape.edges:
            edge.name = self.name(edge)

    def number(self, sizes: MeshSizes) -> None:
        for face in self.shape.faces:
            face.maxh = WIDE * max(edge.mass for edge in face.edges)

    def keep(self, whole: Any) -> None:
        for face in whole.faces:
            if face.name is not None and face.name.startswith("shell "):
                for edge in face.edges:
                    edge.partition, edge.maxh = [], WIDE * edge.mass

    def mesh(self, sizes: MeshSizes) -> Mesh:
        raw = netgen.Mesh(dim=3)
        numbers = [raw.Add(netgen.MeshPoint(netgen.Pnt(*place))) for place in self.places]
        raw.Add(netgen.FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
        for corners in self.corners:
            raw.Add(netgen.Element2D(1, [numbers[int(corner)] for corner in corners]))
        return Mesh(raw)
