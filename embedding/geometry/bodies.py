"""Rigid bodies beside the shell: conductors, which are holes in the ambient, and solids that carry a field inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from netgen.occ import Axes, Box, MoveTo, Pnt, WorkPlane
from netgen.occ import Cylinder as CylinderSolid
from netgen.occ import Sphere as SphereSolid

from embedding.geometry.reduction import Reduction


@dataclass(frozen=True)
class Body:
    """A body in shell sizes: a "sphere" or "cylinder" (axis z) around ``centre``, a "box" with the edge lengths
    ``size``, or the "half-space" below ``level`` (of z; of y in plane strain). ``solid``: it has a field inside."""

    kind: Literal["sphere", "cylinder", "box", "half-space"]
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    radius: float = 0.0
    length: float = 0.0
    size: tuple[float, float, float] = (0.0, 0.0, 0.0)
    level: float = 0.0
    solid: bool = False

    def shape(self, reduction: Reduction, reach: float) -> Any:
        """The OCC solid, or the face that a reduction shows of it; a half-space ends at ``reach`` from the origin."""
        return self._solid(reach) if reduction.dimension == 3 else self._section(reduction, reach)

    def _solid(self, reach: float) -> Any:
        x, y, z = self.centre
        if self.kind == "sphere":
            return SphereSolid(Pnt(x, y, z), self.radius)
        if self.kind == "cylinder":
            start = Axes((x, y, z - self.length / 2), n=(0, 0, 1), h=(1, 0, 0))
            return CylinderSolid(start, self.radius, self.length)
        if self.kind == "box":
            low, high = ([c + s * e / 2 for c, e in zip(self.centre, self.size, strict=True)] for s in (-1, 1))
            return Box(Pnt(*low), Pnt(*high))
        return Box(Pnt(-reach, -reach, -reach), Pnt(reach, reach, self.level))

    def _section(self, reduction: Reduction, reach: float) -> Any:
        axis = 2 if reduction.name == "axisymmetric" else 1
        x, y = (0.0 if reduction.name == "axisymmetric" else self.centre[0]), self.centre[axis]
        if self.kind == "sphere" or (self.kind == "cylinder" and reduction.name == "plane-strain"):
            return WorkPlane(Axes((x, y, 0), n=(0, 0, 1), h=(1, 0, 0))).Circle(self.radius).Face()
        if self.kind == "half-space":
            return MoveTo(-reach, -reach).Rectangle(2 * reach, reach + self.level).Face()
        width, height = (2 * self.radius, self.length) if self.kind == "cylinder" else (self.size[0], self.size[axis])
        return MoveTo(x - width / 2, y - height / 2).Rectangle(width, height).Face()
