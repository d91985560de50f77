"""Mid-surfaces that were read from a file."""

from __future__ import annotations

from netgen.occ import Edge, Pnt

from embedding.geometry.outline import SEAM, SurfaceOutline
from embedding.scene.shapes.file import FileContent, SurfaceFile


def file(shape: SurfaceFile) -> SurfaceOutline:
    """All faces, scaled so that the longest side of their box is 1; edges keep their names."""
    content = shape.content
    scaled = FileContent(content.shape.Scale(Pnt(0, 0, 0), 1 / content.extent))
    names = {edge: name for name, edge in scaled.named_edges()}

    def name(edge: Edge) -> str:
        return names.get(edge, SEAM)

    return SurfaceOutline(scaled.shape, name)
