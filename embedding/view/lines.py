"""Field lines in a plane, evenly spaced where the field is strongest and never ending in the open.

Lines are placed greedily, as B. Jobard and W. Lefer do (Creating evenly-spaced streamlines of arbitrary
density, 1997), with two changes that let them mean what field lines mean: the next line starts where the
field is strong (and beside another line, if possible), and a line that would come too close to another is
left out as a whole instead of being cut short.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.ndimage import distance_transform_edt

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]
STRIDE = 0.5  # of a step along a line, in cells of the raster
APART = 0.6  # how close lines may come where they converge, relative to their spacing
STRONG = 0.9  # from which part of the strongest free field on a line may start
SHORTEST = 1.0  # length of the shortest line, relative to the spacing


@dataclass(frozen=True)
class Raster:
    """A plane field on a regular grid: ``vectors`` (rows, columns, 2) with components along columns and rows.

    It is zero where there is no field. Places are given in cells, (column, row).
    """

    vectors: Floats

    @property
    def strength(self) -> Floats:
        """Lengths of the vectors, (rows, columns)."""
        return np.asarray(np.linalg.norm(self.vectors, axis=2))


def field_lines(raster: Raster, spacing: float) -> list[Floats]:
    """Lines (points, 2) in cells, at least about ``spacing`` cells apart."""
    strength = raster.strength
    directions = raster.vectors / np.where(strength > 0, strength, 1.0)[..., None]
    free = _eroded(strength > 0)
    empty, crowded = np.ones(free.shape, bool), np.zeros(free.shape, bool)
    lines: list[Floats] = []
    while free.any():
        strong = free & (strength >= STRONG * strength[free].max())
        distance = distance_transform_edt(empty) if lines else -strength
        row, column = np.unravel_index(np.where(strong, distance, np.inf).argmin(), free.shape)
        start = np.array([column, row], float)
        backward, forward = (np.array(list(_traced(directions, start, sign))).reshape(-1, 2) for sign in (-1, 1))
        line = np.concatenate([backward[::-1], start[None], forward])
        _mark(free, start[None], spacing / 4, False)
        cells = np.rint(line).astype(int)
        if crowded[cells[:, 1], cells[:, 0]].any() or len(line) * STRIDE < SHORTEST * spacing:
            continue
        lines.append(line)
        empty[cells[:, 1], cells[:, 0]] = False
        _mark(free, line, spacing, False)
        _mark(crowded, line, APART * spacing, True)
    return lines


def _traced(directions: Floats, start: Floats, sign: int) -> Iterator[Floats]:
    """Follow the field from ``start`` by the midpoint rule until it ends."""
    place = start
    for _ in range(int(2 * sum(directions.shape[:2]) / STRIDE)):
        middle = place + sign * STRIDE / 2 * _interpolated(directions, place)
        step = _interpolated(directions, middle)
        if step @ step < 0.25:
            return
        place = place + sign * STRIDE * step
        if not _inside(directions, place):
            return
        yield place


def _inside(directions: Floats, place: Floats) -> bool:
    return bool(0 <= place[0] <= directions.shape[1] - 1 and 0 <= place[1] <= directions.shape[0] - 1)


def _interpolated(directions: Floats, place: Floats) -> Floats:
    """Bilinear interpolation; zero outside."""
    if not _inside(directions, place):
        return np.zeros(2)
    column, row = (min(int(p), n - 2) for p, n in zip(place, directions.shape[1::-1], strict=True))
    s, t = place[0] - column, place[1] - row
    a, b = directions[row, column : column + 2], directions[row + 1, column : column + 2]
    return np.asarray((1 - t) * ((1 - s) * a[0] + s * a[1]) + t * ((1 - s) * b[0] + s * b[1]))


def _eroded(flags: Flags) -> Flags:
    """Cells all of whose neighbours are flagged."""
    padded = np.pad(flags, 1)
    inner = flags.copy()
    for row in range(3):
        for column in range(3):
            inner &= padded[row : row + flags.shape[0], column : column + flags.shape[1]]
    return inner


def _mark(flags: Flags, points: Floats, radius: float, value: bool) -> None:
    """Set the cells within ``radius`` of any of the points."""
    reach = int(radius)
    around = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1).T
    around = around[(around**2).sum(axis=1) <= radius**2]
    cells = (np.rint(points[:, ::-1]).astype(int)[:, None] + around).reshape(-1, 2)
    cells = cells[((cells >= 0) & (cells < flags.shape)).all(axis=1)]
    flags[cells[:, 0], cells[:, 1]] = value
