"""Meshes of mid-surfaces that were read from a file."""

from __future__ import annotations

from netgen.occ import Edge, Pnt
from ngsolve import Mesh

from embedding.geometry.sizes import MeshSizes
from embedding.geometry.surface import SEAM, surface_mesh
from embedding.scene.shapes.file import FileContent, SurfaceFile


def file(shape: SurfaceFile, sizes: MeshSizes) -> Mesh:
    """Mesh of all faces, scaled so that the longest side of their box is 1; edges keep their names."""
    content = shape.content
    scaled = FileContent(content.shape.Scale(Pnt(0, 0, 0), 1 / content.extent))
    names = {edge: name for name, edge in scaled.named_edges()}

    def name(edge: Edge) -> str:
        return names.get(edge, SEAM)

    return surface_mesh(scaled.shape, name, sizes)
