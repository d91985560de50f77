"""From points in space to the part of it that is meshed, and vectors back: mirror planes, the axis, plane strain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.scene.checks_field import centre_of_space

Floats = npt.NDArray[np.float64]
AXES = "xyz"
PLANE = {"3d": (0, 1, 2), "axisymmetric": (0, 2), "plane-strain": (0, 1)}


@dataclass(frozen=True)
class Space:
    """How a run's mesh lies in space: its ``reduction``, the ``mirrors`` it was cut along, and those of them across
    which the potential changes sign (``odd``)."""

    reduction: str
    mirrors: tuple[str, ...]
    odd: tuple[str, ...]

    @staticmethod
    def of(archive: Archive) -> Space:
        """The space of an archive."""
        run = archive.run
        return Space(run["reduction"], tuple(run["mirrors"]), tuple(run.get("odd_mirrors", ())))

    @property
    def axes(self) -> tuple[int, ...]:
        """The coordinates that the mesh shows, of the three of space."""
        return PLANE[self.reduction]

    @property
    def copies(self) -> int:
        """Mirror images that make up the whole."""
        return int(2 ** len(self.mirrors))

    def shown(self, points: npt.NDArray[np.floating]) -> Floats:
        """The meshed coordinates (n, d) of points (n, 3) of the meshed part."""
        return np.asarray(points[:, self.axes], float)

    def folded(self, points: Floats) -> Places:
        """Where points (n, 3) of the whole space lie in the meshed part."""
        flips = np.ones_like(points)
        for plane in self.mirrors:
            axis = AXES.index(plane)
            flips[:, axis] = np.where(points[:, axis] < 0, -1.0, 1.0)
        moved, turn = points * flips, np.zeros(len(points))
        if self.reduction == "axisymmetric":
            turn = np.arctan2(moved[:, 1], moved[:, 0])
            moved = np.column_stack([np.hypot(moved[:, 0], moved[:, 1]), np.zeros(len(points)), moved[:, 2]])
        if self.reduction == "plane-strain":
            moved = moved * (1.0, 1.0, 0.0)
        odd = [AXES.index(plane) for plane in self.odd if plane in self.mirrors]
        return Places(moved, flips, flips[:, odd].prod(axis=1), turn)


def centre_of_outer(archive: Archive) -> Floats:
    """The centre of the sphere (plane strain: circle) where the meshed space ends, (3,) in m."""
    centre = np.zeros(3)
    centre[Space.of(archive).axes[-1]] = centre_of_space(archive.scene_object())
    return centre


@dataclass(frozen=True)
class Places:
    """Points (n, 3) of the meshed part, and what brings values there back: the signs of the coordinates that were
    folded (n, 3), the sign of the potential (n,), and the angle about the axis (n,)."""

    points: Floats
    flips: Floats
    parity: Floats
    turn: Floats

    def rows(self, which: Sequence[int] | npt.NDArray[np.bool_]) -> Places:
        """Some of the points."""
        return Places(self.points[which], self.flips[which], self.parity[which], self.turn[which])

    def unfolded(self, name: str, values: Floats) -> Floats:
        """Values (n, ...) of the quantity ``name``, found at the folded points, as they are at the points themselves.

        Vectors turn and are mirrored; what comes from the potential changes its sign across odd planes. Tensors keep
        the axes of the meshed part.
        """
        sign = self.parity if name in OF_POTENTIAL else np.ones(len(values))
        if values.ndim == 1:
            return np.asarray(sign * values)
        if values.shape[1] != 3:
            return values
        cosine, sine = np.cos(self.turn), np.sin(self.turn)
        turned = np.column_stack(
            [cosine * values[:, 0] - sine * values[:, 1], sine * values[:, 0] + cosine * values[:, 1], values[:, 2]]
        )
        return np.asarray(sign[:, None] * turned * self.flips)


OF_POTENTIAL = frozenset({"phi", "E", "H", "D", "B"})
"""Quantities that are proportional to the potential."""
