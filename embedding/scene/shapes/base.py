"""What every mid-surface tells the rest of the house, and what surfaces of revolution share.

The top face is the one the normal points out of; on closed shapes that is the outside.
"""

from __future__ import annotations

from abc import abstractmethod
from math import cos, pi, sin
from typing import Annotated, Self

from pydantic import BeforeValidator, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import Part, known
from embedding.scene.units import Number

Point = tuple[float, float, float]
TURN = 2 * pi
SHARP = "sharp"
"""What the edges of a file at which its faces meet at more than 30 degrees are called together."""
EVEN = 1e-12
"""How far from even, relative to its angle, a sector may lie and still count as its own mirror image."""
Angle = Annotated[float, BeforeValidator(Number("angle", "rad", "90 deg", at_least=-TURN, at_most=TURN))]
PartOfTurn = Annotated[float, BeforeValidator(Number("angle", "rad", "90 deg", above=0.0, at_most=0.999 * TURN))]


class Surface(Part):
    """A reference mid-surface."""

    kind: str

    @property
    def edges(self) -> tuple[str, ...]:
        """Names of the lines that supports and line loads may stand on."""
        return ()

    @property
    def faces(self) -> tuple[str, ...]:
        """Names of the faces that regions of the shell may be made of."""
        return ()

    @property
    def kinks(self) -> tuple[str, ...]:
        """Edges along which faces meet at an angle, by name; ``SHARP`` for all such edges of a file."""
        return ()

    @property
    def reductions(self) -> tuple[str, ...]:
        """Dimensional reductions that can carry the shape, the general one first."""
        return ("3d",)

    @property
    def closed(self) -> bool:
        """Does it enclose a volume?"""
        return False

    @property
    def mirrors(self) -> tuple[str, ...]:
        """Axes whose coordinate plane through the origin maps the shape onto itself and may cut it."""
        return ()

    def mirror_image(self, edge: str, axis: str) -> str:
        """The name of the mirror image of ``edge`` in the plane of one of ``mirrors``."""
        return edge

    @property
    def surroundable(self) -> bool:
        """Has the space around it a top and a bottom side everywhere?"""
        return True

    @property
    @abstractmethod
    def size(self) -> float:
        """The length, in m, that every other length is measured in."""

    @property
    def narrowest(self) -> float:
        """The narrowest extent that a mesh must resolve, in m."""
        return self.size

    @property
    def curvature_radius(self) -> float | None:
        """Smallest radius of curvature in m; None for a flat shape."""
        return None

    @abstractmethod
    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, among them likely places of a division by zero."""


class Revolved(Surface):
    """A surface of revolution about the z axis, whole or between two half planes.

    The sector reaches from the angle ``start`` to ``start + angle``, counted from x towards y; None: the whole turn.
    Its sides are the edges ``side0`` (at ``start``) and ``side1``.
    """

    start: Angle = 0.0
    angle: PartOfTurn | None = None

    @model_validator(mode="after")
    def _start_needs_an_angle(self) -> Self:
        if self.angle is None and self.start != 0.0:
            reason = 'a sector needs an angle, such as angle = "90 deg"'
            raise refusal(reason, field="start", value=self.start)
        return self

    @property
    def sides(self) -> tuple[str, ...]:
        """Edges along meridians."""
        return () if known(self.angle) is None else ("side0", "side1")

    @property
    def reductions(self) -> tuple[str, ...]:
        """In 3D, and the whole turn also by its meridian."""
        return ("3d",) if self.sides else ("3d", "axisymmetric")

    @property
    def mirrors(self) -> tuple[str, ...]:
        """The planes of the whole turn; a sector that lies evenly on both sides of y = 0 is mirrored there."""
        if self.angle is None:
            return ("x", "y")
        return ("y",) if abs(self.start + self.angle / 2) < EVEN * self.angle else ()

    def mirror_image(self, edge: str, axis: str) -> str:
        """Mirroring a sector swaps its sides."""
        return {"side0": "side1", "side1": "side0"}.get(edge, edge) if axis == "y" else edge

    def _ring(self, radius: float, height: float) -> tuple[Point, ...]:
        """A few points of the circle, or of its arc, at a ``radius`` and ``height``."""
        if self.angle is None:
            return circle(radius, height)
        angles = [self.start + part * self.angle for part in (0.0, 0.31, 0.5, 1.0)]
        return tuple((radius * cos(angle), radius * sin(angle), height) for angle in angles)

    def _along(self, radius: float) -> float:
        """Length of the arc at a ``radius``; the circle counts by its diameter."""
        return 2 * radius if self.angle is None else radius * self.angle


def circle(radius: float, height: float) -> tuple[Point, ...]:
    """The axes, which are the likely places of a division by zero, and two angles without symmetry."""
    axes = ((radius, 0.0, height), (0.0, radius, height), (-radius, 0.0, height), (0.0, -radius, height))
    return (*axes, *((radius * cos(angle), radius * sin(angle), height) for angle in (0.7, 3.9)))
