"""Mid-surfaces read from a STEP or BREP file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import known
from embedding.scene.shapes.base import SHARP, Point, Surface
from embedding.scene.shapes.trial import why_not
from embedding.scene.texts import FilePath
from embedding.scene.units import Length

SUFFIXES = (".step", ".stp", ".brep")
POLE = 1e-6
"""Length of an edge, relative to the size of everything, below which it is only a point of a curved face."""


class SurfaceFile(Surface):
    """The faces of a STEP or BREP file, joined where they touch; their names and those of edges are kept.

    ``path`` counts from the working directory. ``unit`` is the length of 1 in the file; a STEP file states its own
    unit, and its numbers are read in mm whatever that is. Free edges without a name are called ``edge1``, ``edge2`` and
    so on, in the order of the file, and faces without one ``face1`` and so on. The normal is that of the first face;
    ``flip`` turns it round.

    Raises:
        SceneError: the file is missing, cannot be read, or has no faces.
    """

    kind: Literal["file"] = "file"
    path: FilePath
    unit: Length = 1e-3
    flip: bool = False

    @model_validator(mode="after")
    def _readable(self) -> Self:
        file = Path(known(self.path))
        if file.suffix.lower() not in SUFFIXES:
            raise refusal(f"must be the name of a {', '.join(SUFFIXES)} file", field="path", value=self.path)
        if not file.is_file():
            raise refusal(f"there is no file {file.name}", field="path", value=self.path)
        try:
            faces = len(self.content.faces)
        except Exception as error:  # the geometry kernel answers broken files with many kinds of error
            reason = f"{file.name} cannot be read; write it again from the program it comes from"
            raise refusal(reason, field="path", value=self.path) from error
        if faces == 0:
            raise refusal(f"there are no faces in {file.name}", field="path", value=self.path)
        return self

    @property
    def content(self) -> FileContent:
        """What the file holds, in its own unit."""
        return _read(self.path, Path(self.path).stat().st_mtime_ns)

    @property
    def edges(self) -> tuple[str, ...]:
        """Names in the file, then the numbered free edges."""
        return tuple(dict.fromkeys(self.content.edge_names))

    @property
    def kinks(self) -> tuple[str, ...]:
        """Edges at which faces meet at more than 30 degrees, if there are any, have one name for all."""
        return (SHARP,) if len(self.content.faces) > 1 else ()

    @property
    def faces(self) -> tuple[str, ...]:
        """Names of the faces, in the order of the file."""
        return self.content.face_names

    @property
    def closed(self) -> bool:
        """Do its faces leave no edge free?"""
        return self.content.closed

    @property
    def size(self) -> float:
        """The longest side of the box around it, in m."""
        return self.unit * self.content.extent

    @property
    def narrowest(self) -> float:
        """The side of a square as large as the smallest face, in m."""
        return float(self.unit * min(face.mass for face in self.content.faces) ** 0.5)

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: corners of its faces."""
        corners = [vertex.p for vertex in self.content.shape.vertices]
        return tuple((self.unit * p.x, self.unit * p.y, self.unit * p.z) for p in corners[:: 1 + len(corners) // 24])


@dataclass(frozen=True)
class FileContent:
    """The glued faces of a file as an OCC ``shape``, in the file's unit."""

    shape: Any

    @cached_property
    def faces(self) -> list[Any]:
        """Its OCC faces."""
        return list(self.shape.faces)

    @cached_property
    def extent(self) -> float:
        """The longest side of the box around it."""
        low, high = self.shape.bounding_box
        return float(max(high.x - low.x, high.y - low.y, high.z - low.z))

    @cached_property
    def _uses(self) -> dict[Any, int]:
        """How often the faces have each real edge on their outline; a seam counts twice."""
        return Counter(edge for face in self.faces for edge in face.edges if edge.mass > POLE * self.extent)

    @property
    def closed(self) -> bool:
        """Is no edge free?"""
        return all(uses > 1 for uses in self._uses.values())

    @cached_property
    def edge_names(self) -> tuple[str, ...]:
        """Names of the named edges and of the free ones, in the order of ``named_edges``."""
        return tuple(name for name, _ in self.named_edges())

    def named_edges(self) -> Iterator[tuple[str, Any]]:
        """Every edge that has a name or is free, with its name."""
        free = 0
        for edge, uses in self._uses.items():
            free += uses == 1
            if edge.name or uses == 1:
                yield edge.name or f"edge{free}", edge

    @cached_property
    def face_names(self) -> tuple[str, ...]:
        """Names of the faces, numbered where they have none."""
        return tuple(face.name or f"face{number}" for number, face in enumerate(self.faces, 1))


@lru_cache(maxsize=8)
def _read(path: str, _stamp: int) -> FileContent:
    reason = why_not(path)
    if reason is not None:
        raise ValueError(reason)
    # the geometry kernel takes a while to load, and most scenes need none here
    from netgen.occ import Glue, OCCGeometry

    shape = OCCGeometry(path).shape
    faces = list(shape.faces)
    return FileContent(Glue(faces) if len(faces) > 1 else shape)
