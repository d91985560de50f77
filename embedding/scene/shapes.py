"""Reference mid-surfaces: their edges, whether they are closed, their size, the reductions that fit them.

The top face is the one the normal points out of; on closed shapes that is the outside.
"""

from __future__ import annotations

from math import cos, sin
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Discriminator, Tag, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import Part, kind_under
from embedding.scene.units import Length, Ratio

Point = tuple[float, float, float]


class Plate(Part):
    """A flat rectangle: x in [0, length], y in [0, width], z = 0, normal +z."""

    edges: ClassVar[tuple[str, ...]] = ("x0", "x1", "y0", "y1")
    reductions: ClassVar[tuple[str, ...]] = ("3d",)
    closed: ClassVar[bool] = False

    kind: Literal["plate"] = "plate"
    length: Length
    width: Length

    @property
    def size(self) -> float:
        """The longer side, in m."""
        return max(self.length, self.width)

    @property
    def curvature_radius(self) -> float | None:
        """Smallest radius of curvature in m; None for a flat shape."""
        return None

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: corners, centre and one without symmetry."""
        parts = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5), (0.31, 0.77))
        return tuple((a * self.length, b * self.width, 0.0) for a, b in parts)


class Disc(Part):
    """A flat circular disc around the origin in the plane z = 0, normal +z."""

    edges: ClassVar[tuple[str, ...]] = ("rim",)
    reductions: ClassVar[tuple[str, ...]] = ("3d", "axisymmetric")
    closed: ClassVar[bool] = False

    kind: Literal["disc"] = "disc"
    radius: Length

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def curvature_radius(self) -> float | None:
        """Smallest radius of curvature in m; None for a flat shape."""
        return None

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the centre and two circles."""
        return ((0.0, 0.0, 0.0), *_circle(self.radius, 0.0), *_circle(0.6 * self.radius, 0.0))


class Sphere(Part):
    """A sphere around the origin with outward normal."""

    edges: ClassVar[tuple[str, ...]] = ()
    reductions: ClassVar[tuple[str, ...]] = ("3d", "axisymmetric")
    closed: ClassVar[bool] = True

    kind: Literal["sphere"] = "sphere"
    radius: Length

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def curvature_radius(self) -> float | None:
        """Smallest radius of curvature in m; None for a flat shape."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the poles, the equator and two more circles."""
        poles = ((0.0, 0.0, self.radius), (0.0, 0.0, -self.radius))
        rings = (_circle(0.8 * self.radius, z * self.radius) for z in (0.6, -0.6))
        return (*poles, *_circle(self.radius, 0.0), *(point for ring in rings for point in ring))


class InfiniteCylinder(Part):
    """An infinitely long cylinder around the z axis with outward normal, treated per length of it.

    ``axial`` is "held", at the stretch ``axial_stretch``, or "free": open ends without traction.
    """

    edges: ClassVar[tuple[str, ...]] = ()
    reductions: ClassVar[tuple[str, ...]] = ("plane-strain",)
    closed: ClassVar[bool] = True

    kind: Literal["infinite-cylinder"] = "infinite-cylinder"
    radius: Length
    axial: Literal["held", "free"] = "held"
    axial_stretch: Ratio = 1.0

    @model_validator(mode="after")
    def _stretch_needs_holding(self) -> Self:
        if self.axial == "free" and self.axial_stretch != 1.0:
            reason = 'a prescribed axial stretch needs axial = "held"'
            raise refusal(reason, field="axial_stretch", value=self.axial_stretch)
        return self

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def curvature_radius(self) -> float | None:
        """Smallest radius of curvature in m; None for a flat shape."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, in the plane z = 0."""
        return _circle(self.radius, 0.0)


def _circle(radius: float, height: float) -> tuple[Point, ...]:
    # the axes, which are the likely places of a division by zero, and two angles without symmetry
    axes = ((radius, 0.0, height), (0.0, radius, height), (-radius, 0.0, height), (0.0, -radius, height))
    return (*axes, *((radius * cos(angle), radius * sin(angle), height) for angle in (0.7, 3.9)))


Shape = Annotated[
    Annotated[Plate, Tag("plate")]
    | Annotated[Disc, Tag("disc")]
    | Annotated[Sphere, Tag("sphere")]
    | Annotated[InfiniteCylinder, Tag("infinite-cylinder")],
    Discriminator(kind_under("kind")),
]
