"""Field lines in a plane, evenly spaced where the field is strongest and never ending in the open.

Lines are placed greedily, as B. Jobard and W. Lefer do (Creating evenly-spaced streamlines of arbitrary
density, 1997), with two changes that let them mean what field lines mean: the next line starts where the
field is strong (and beside another line, if possible), and a line that would come too close to another is
left out as a whole instead of being cut short.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.ndimage import distance_transform_edt

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]
Place = tuple[float, float]
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


def field_lines(raster: Raster, spacing: float, no_starts: Flags | None = None) -> list[Floats]:
    """Lines (points, 2) in cells, at least about ``spacing`` cells apart; none starts where ``no_starts`` (rows,
    columns) says so."""
    strength = raster.strength
    directions = raster.vectors / np.where(strength > 0, strength, 1.0)[..., None]
    free = _eroded(strength > 0)
    if no_starts is not None:
        free &= ~no_starts
    empty, crowded = np.ones(free.shape, bool), np.zeros(free.shape, bool)
    lines: list[Floats] = []
    distance = -strength  # the first line starts where the field is strongest, others beside those that are there
    follow = _Follower(directions)
    while free.any():
        strong = free & (strength >= STRONG * strength[free].max())
        row, column = np.unravel_index(np.where(strong, distance, np.inf).argmin(), free.shape)
        start = (float(column), float(row))
        backward, forward = (follow.traced(start, sign) for sign in (-1, 1))
        line = np.array([*backward[::-1], start, *forward])
        _mark(free, line[[len(backward)]], spacing / 4, False)
        cells = np.rint(line).astype(int)
        if crowded[cells[:, 1], cells[:, 0]].any() or len(line) * STRIDE < SHORTEST * spacing:
            continue
        lines.append(line)
        empty[cells[:, 1], cells[:, 0]] = False
        distance = distance_transform_edt(empty)
        _mark(free, line, spacing, False)
        _mark(crowded, line, APART * spacing, True)
    return lines


class _Follower:
    """Follows ``directions`` (rows, columns, 2) by the midpoint rule; on Python's own numbers, which for one point at a
    time are several times faster than arrays."""

    def __init__(self, directions: Floats) -> None:
        self._rows: list[list[list[float]]] = directions.tolist()
        self._last = directions.shape[1] - 1, directions.shape[0] - 1
        self._longest = int(2 * sum(directions.shape[:2]) / STRIDE)

    def traced(self, start: Place, sign: int) -> list[Place]:
        """The places behind ``start`` until the field ends."""
        (x, y), found = start, []
        for _ in range(self._longest):
            u, v = self._interpolated(x, y)
            u, v = self._interpolated(x + sign * STRIDE / 2 * u, y + sign * STRIDE / 2 * v)
            if u * u + v * v < 0.25:
                break
            x, y = x + sign * STRIDE * u, y + sign * STRIDE * v
            if not (0 <= x <= self._last[0] and 0 <= y <= self._last[1]):
                break
            found.append((x, y))
        return found

    def _interpolated(self, x: float, y: float) -> Place:
        """Bilinear interpolation; zero outside."""
        if not (0 <= x <= self._last[0] and 0 <= y <= self._last[1]):
            return 0.0, 0.0
        column, row = min(int(x), self._last[0] - 1), min(int(y), self._last[1] - 1)
        s, t = x - column, y - row
        a, b = self._rows[row][column : column + 2]
        c, d = self._rows[row + 1][column : column + 2]
        wa, wb, wc, wd = (1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t
        return (
            wa * a[0] + wb * b[0] + wc * c[0] + wd * d[0],
            wa * a[1] + wb * b[1] + wc * c[1] + wd * d[1],
        )


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
