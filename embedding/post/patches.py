"""The blocks of an archive at one step, in the coordinates that the mesh shows: deformed cells and their boundary."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, ArchivedBlock
from embedding.post.cells import boundary_facets, dimension_of
from embedding.post.locate import Found, containing, interpolated, nearest
from embedding.post.space import Space
from embedding.post.table import PostError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
SIDES = ("outside", "inside")
FACES = {"top": "outside", "bottom": "inside"} | dict(zip(SIDES, SIDES, strict=True))


def side_named(archive: Archive, side: str) -> str:
    """The block on a ``side``: "outside" (or "top"), "inside" (or "bottom").

    Raises:
        PostError: no such side, or nothing is meshed around the shell.
    """
    if side not in FACES:
        raise PostError(f"no side {side!r}; there are outside (the same as top) and inside (bottom)")
    if FACES[side] not in archive.blocks:
        raise PostError(f"{archive.path}: nothing is meshed around the shell; there is the block shell only")
    return FACES[side]


@dataclass(frozen=True)
class Patch:
    """The cells of ``block`` at ``step``, all of them or those of its boundary: deformed, undeformed, or with the nodes
    ``placed`` elsewhere."""

    block: ArchivedBlock
    step: int
    space: Space
    cells: Integers
    fills: bool
    deformed: bool = True
    placed: Floats | None = None

    @staticmethod
    def of(archive: Archive, name: str, step: int, *, deformed: bool = True) -> Patch:
        """A whole block."""
        block, space = archive.block(name, step), Space.of(archive)
        return Patch(block, step, space, block.cells, dimension_of(block.cell_type) == len(space.axes), deformed)

    @cached_property
    def boundary(self) -> Patch:
        """The boundary of a block that fills space."""
        facets = boundary_facets(self.block.cells, self.block.cell_type, self.block.order)
        return Patch(self.block, self.step, self.space, facets, False, self.deformed)

    def part(self, which: npt.NDArray[np.bool_]) -> Patch:
        """Some of the cells."""
        return Patch(self.block, self.step, self.space, self.cells[which], self.fills, self.deformed)

    @cached_property
    def nodes(self) -> Floats:
        """Where the nodes of the block are, (n, 3) in m."""
        if self.placed is not None:
            return self.placed
        points = self.block.points
        return points + self.block.field("u", self.step) if self.deformed else points

    @cached_property
    def corners(self) -> Floats:
        """Where the nodes of every cell are, (cells, nodes, d), in the coordinates that the mesh shows."""
        return self.space.shown(self.nodes)[self.cells]

    def find(self, points: npt.NDArray[np.floating]) -> Found:
        """The cells that hold points (n, 3) of the meshed part, or the nearest ones if the cells fill no space."""
        seek = containing if self.fills else nearest
        return seek(self.corners, self.block.order, self.space.shown(points))

    def values(self, field: str, found: Found) -> Floats:
        """A field at places that were found, nan elsewhere."""
        return interpolated(self.block.field(field, self.step), self.cells, self.block.order, found)

    def where(self, found: Found) -> Floats:
        """The positions (n, 3) of places that were found."""
        return interpolated(self.nodes, self.cells, self.block.order, found)
