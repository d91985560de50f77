"""The deformed shell as a triangulated surface in space, whatever reduction it was computed in."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.view.tessellation import Tessellation

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
AXES = "xyz"
STEPS = {1: 12, 2: 8}  # small simplices along an edge of a shell cell, by its dimension
TURNS = 180  # segments of a full turn
LINE = 68  # VTK's number of a Lagrange curve


@dataclass(frozen=True)
class Surface:
    """Triangles (cells, 3) on points (n, 3) in m, coloured by ``values`` (n,)."""

    points: Floats
    triangles: Integers
    values: Floats

    @property
    def centre(self) -> Floats:
        """Middle of the surface's box."""
        return np.asarray((self.points.min(axis=0) + self.points.max(axis=0)) / 2)


def shell_surface(
    archive: Archive,
    field: str,
    step: int,
    turn: tuple[float, float] = (0.0, 360.0),
    depth: float = 2.0,
    deformed: bool = True,
    steps: Mapping[int, int] = STEPS,
    turns: int = TURNS,
) -> Surface:
    """The shell of a step, coloured by ``field`` (the length of a vector), its mirror images
    included.

    ``turn`` holds the angles in degrees between which an axisymmetric shell is revolved about z; ``depth``
    is the length of a cylinder along z in multiples of its radius. ``steps`` are the small simplices along an edge of a
    cell, by its dimension, ``turns`` the segments of a full turn.
    """
    block = archive.block("shell", step)
    fine = Tessellation(block.cells, block.cell_type, block.order, steps[1 if block.cell_type == LINE else 2])
    points = fine.values(block.points)
    if deformed:
        points = points + fine.values(block.field("u", step))
    values = magnitude(fine.values(block.field(field, step)))
    reduction = archive.run["reduction"]
    if reduction == "axisymmetric":
        return revolved(points, values, fine.simplices, turn, turns)
    if reduction == "plane-strain":
        length = depth * float(np.linalg.norm(points, axis=1).max())
        return mirrored(extruded(points, values, fine.simplices, length), archive.run["mirrors"])
    return mirrored(Surface(points, fine.simplices, values), archive.run["mirrors"])


def magnitude(values: Floats) -> Floats:
    """Lengths of vectors; scalars stay what they are."""
    return values if values.ndim == 1 else np.asarray(np.linalg.norm(values, axis=1))


def revolved(
    points: Floats, values: Floats, lines: Integers, turn: tuple[float, float], turns: int = TURNS
) -> Surface:
    """Revolve segments of the half plane y = 0, x >= 0 about z, between two angles in degrees."""
    begin, end = (math.radians(angle) for angle in turn)
    copies = max(2, round(turns * abs(end - begin) / (2 * math.pi))) + 1
    angles = np.linspace(begin, end, copies)[:, None]
    radius, height = points[None, :, 0], np.broadcast_to(points[:, 2], (copies, len(points)))
    swept = np.stack([radius * np.cos(angles), radius * np.sin(angles), height], axis=2)
    swept = swept.reshape(-1, 3)
    triangles = _swept(lines, len(points), copies)
    corners = swept[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    real = area > 1e-9 * area.max()  # on the axis, half of the triangles are points
    return Surface(swept, triangles[real], np.tile(values, copies))


def extruded(points: Floats, values: Floats, lines: Integers, length: float) -> Surface:
    """Extrude segments of the plane z = 0 along z."""
    swept = np.concatenate([points, points + (0.0, 0.0, length)])
    return Surface(swept, _swept(lines, len(points), 2), np.tile(values, 2))


def _swept(lines: Integers, count: int, copies: int) -> Integers:
    """Triangles between ``copies`` copies of segments on ``count`` points each."""
    a, b = lines.T
    strip = np.concatenate([np.stack([a, b, b + count], 1), np.stack([a, b + count, a + count], 1)])
    return np.concatenate([strip + count * copy for copy in range(copies - 1)])


def mirrored(surface: Surface, planes: Sequence[str]) -> Surface:
    """The surface together with its mirror images in coordinate planes."""
    for plane in planes:
        flip = np.ones(3)
        flip[AXES.index(plane)] = -1
        surface = Surface(
            np.concatenate([surface.points, surface.points * flip]),
            np.concatenate([surface.triangles, surface.triangles[:, ::-1] + len(surface.points)]),
            np.tile(surface.values, 2),
        )
    return surface
