"""Curved mid-surfaces in space: most are surfaces of revolution about the z axis."""

from __future__ import annotations

from math import cos, hypot, pi, sin
from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import known
from embedding.scene.shapes.base import Point, Revolved, Surface, circle
from embedding.scene.units import Components, Length, Number

BelowEquator = Annotated[float, BeforeValidator(Number("angle", "rad", "18 deg", above=0.0, at_most=0.999 * pi / 2))]
BelowPole = Annotated[float, BeforeValidator(Number("angle", "rad", "40 deg", above=0.0, at_most=0.999 * pi))]


class Sphere(Surface):
    """A sphere around the origin with outward normal."""

    kind: Literal["sphere"] = "sphere"
    radius: Length

    @property
    def reductions(self) -> tuple[str, ...]:
        """In 3D and by its meridian."""
        return ("3d", "axisymmetric")

    @property
    def closed(self) -> bool:
        """Always."""
        return True

    @property
    def mirrors(self) -> tuple[str, ...]:
        """All three coordinate planes."""
        return ("x", "y", "z")

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def curvature_radius(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the poles, the equator and two more circles."""
        poles = ((0.0, 0.0, self.radius), (0.0, 0.0, -self.radius))
        rings = (circle(0.8 * self.radius, z * self.radius) for z in (0.6, -0.6))
        return (*poles, *circle(self.radius, 0.0), *(point for ring in rings for point in ring))


class Cylinder(Revolved):
    """A cylinder around the z axis, z in [-length/2, length/2], with outward normal; or a panel of it.

    ``ends`` is "open", or "capped" by flat discs: then it is closed, with a kink along each end. ``half`` keeps the
    part z >= 0. The end at the smaller z is the edge ``end0``, the other ``end1``.
    """

    kind: Literal["cylinder"] = "cylinder"
    radius: Length
    length: Length
    ends: Literal["open", "capped"] = "open"
    half: bool = False

    @model_validator(mode="after")
    def _caps_close_it(self) -> Self:
        if self.ends == "capped" and (self.angle is not None or self.half):
            raise refusal("only the whole cylinder can be capped", field="ends", value=self.ends)
        return self

    @property
    def edges(self) -> tuple[str, ...]:
        """Both ends (the kinks of a capped cylinder) and the sides of a sector."""
        return ("end0", "end1", *self.sides)

    @property
    def kinks(self) -> tuple[str, ...]:
        """The ends, with caps."""
        return ("end0", "end1") if self.closed else ()

    @property
    def closed(self) -> bool:
        """Only with caps."""
        return self.ends == "capped"

    @property
    def mirrors(self) -> tuple[str, ...]:
        """The plane z = 0 as well, unless only half is there."""
        return super().mirrors if self.half else (*super().mirrors, "z")

    def mirror_image(self, edge: str, axis: str) -> str:
        """Mirroring z swaps the ends."""
        if axis != "z":
            return super().mirror_image(edge, axis)
        return {"end0": "end1", "end1": "end0"}.get(edge, edge)

    @property
    def heights(self) -> tuple[float, float]:
        """z of both ends, in m."""
        return (0.0 if self.half else -self.length / 2), self.length / 2

    @property
    def size(self) -> float:
        """The radius, in m, or the longer side of a panel that is smaller than it."""
        return min(self.radius, max(self.heights[1] - self.heights[0], self._along(self.radius)))

    @property
    def narrowest(self) -> float:
        """Length or arc, in m."""
        return min(self.heights[1] - self.heights[0], self._along(self.radius))

    @property
    def curvature_radius(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, on three circles; the middles of the caps."""
        low, high = self.heights
        caps = ((0.0, 0.0, low), (0.0, 0.0, high)) if self.closed else ()
        rings = (self._ring(self.radius, z) for z in (low, 0.3 * low + 0.7 * high, high))
        return (*caps, *(point for ring in rings for point in ring))


class Cap(Revolved):
    """The part of a sphere around the origin within ``half_angle`` of +z; outward normal."""

    kind: Literal["cap"] = "cap"
    radius: Length
    half_angle: BelowPole

    @property
    def edges(self) -> tuple[str, ...]:
        """The circle around it, and the sides of a sector."""
        return ("rim", *self.sides)

    @property
    def size(self) -> float:
        """The radius of the sphere, in m, or of the rim of a shallow cap."""
        return self.radius * (sin(self.half_angle) if self.half_angle < pi / 2 else 1.0)

    @property
    def narrowest(self) -> float:
        """The arc from the pole to the rim, in m."""
        return self.radius * self.half_angle

    @property
    def curvature_radius(self) -> float:
        """The radius of the sphere, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the pole and three circles."""
        rings = [
            self._ring(self.radius * sin(part * self.half_angle), self.radius * cos(part * self.half_angle))
            for part in (0.3, 0.7, 1.0)
        ]
        return ((0.0, 0.0, self.radius), *(point for ring in rings for point in ring))


class Hemisphere(Revolved):
    """The half z >= 0 of a sphere around the origin, outward normal; ``hole_half_angle`` opens a hole at the pole."""

    kind: Literal["hemisphere"] = "hemisphere"
    radius: Length
    hole_half_angle: BelowEquator | None = None

    @property
    def edges(self) -> tuple[str, ...]:
        """The equator, the hole, and the sides of a sector."""
        return ("rim", *(() if known(self.hole_half_angle) is None else ("hole",)), *self.sides)

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def narrowest(self) -> float:
        """The arc from the rim to the hole or the pole, in m."""
        return self.radius * (pi / 2 - (self.hole_half_angle or 0.0))

    @property
    def curvature_radius(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: three circles, and the pole if there is no hole."""
        top = self.hole_half_angle or 0.0
        angles = [top + part * (pi / 2 - top) for part in (0.0, 0.4, 1.0)]
        rings = [self._ring(self.radius * sin(angle), self.radius * cos(angle)) for angle in angles]
        return tuple(point for ring in rings for point in ring)


class Cone(Revolved):
    """A frustum around the z axis: ``radius`` at z = 0 and ``top_radius`` at z = ``height``; outward normal.

    The edges are ``end0`` (z = 0), ``end1`` and the sides of a sector.
    """

    kind: Literal["cone"] = "cone"
    radius: Length
    top_radius: Length
    height: Length

    @property
    def edges(self) -> tuple[str, ...]:
        """Both ends and the sides of a sector."""
        return ("end0", "end1", *self.sides)

    @property
    def size(self) -> float:
        """The larger radius, in m."""
        return max(self.radius, self.top_radius)

    @property
    def slant(self) -> float:
        """Length of a straight line from end to end, in m."""
        return hypot(self.height, self.radius - self.top_radius)

    @property
    def narrowest(self) -> float:
        """Slant or arc, in m."""
        return min(self.slant, self._along(self.size))

    @property
    def curvature_radius(self) -> float:
        """At the smaller end, in m: its radius over the cosine of the wall's slope."""
        return min(self.radius, self.top_radius) * self.slant / self.height

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, on three circles."""
        rings = [
            self._ring((1 - part) * self.radius + part * self.top_radius, part * self.height)
            for part in (0.0, 0.37, 1.0)
        ]
        return tuple(point for ring in rings for point in ring)


class Torus(Surface):
    """A tube of ``tube_radius`` around the circle of ``radius`` in the plane z = 0, with outward normal."""

    kind: Literal["torus"] = "torus"
    radius: Length
    tube_radius: Length

    @model_validator(mode="after")
    def _has_a_hole(self) -> Self:
        if self.tube_radius >= self.radius:
            reason = f"must be less than radius = {self.radius} m"
            raise refusal(reason, "m", field="tube_radius", value=self.tube_radius)
        return self

    @property
    def reductions(self) -> tuple[str, ...]:
        """In 3D and by the circle that is revolved."""
        return ("3d", "axisymmetric")

    @property
    def closed(self) -> bool:
        """Always."""
        return True

    @property
    def mirrors(self) -> tuple[str, ...]:
        """All three coordinate planes."""
        return ("x", "y", "z")

    @property
    def size(self) -> float:
        """The radius of the tube's centre line, in m."""
        return self.radius

    @property
    def narrowest(self) -> float:
        """The radius of the tube, in m."""
        return self.tube_radius

    @property
    def curvature_radius(self) -> float:
        """The radius of the tube, in m."""
        return self.tube_radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: circles outside, inside, on top, below and between."""
        angles = (0.0, 0.9, pi / 2, pi, 3 * pi / 2)
        rings = [circle(self.radius + self.tube_radius * cos(angle), self.tube_radius * sin(angle)) for angle in angles]
        return tuple(point for ring in rings for point in ring)


class Ellipsoid(Surface):
    """An ellipsoid around the origin with ``semi_axes`` along x, y and z, and outward normal."""

    kind: Literal["ellipsoid"] = "ellipsoid"
    semi_axes: Annotated[tuple[Length, Length, Length], Components]

    @property
    def reductions(self) -> tuple[str, ...]:
        """In 3D; by its meridian if the semi-axes across z are equal."""
        return ("3d", "axisymmetric") if self.semi_axes[0] == self.semi_axes[1] else ("3d",)

    @property
    def closed(self) -> bool:
        """Always."""
        return True

    @property
    def mirrors(self) -> tuple[str, ...]:
        """All three coordinate planes."""
        return ("x", "y", "z")

    @property
    def size(self) -> float:
        """The longest semi-axis, in m."""
        return max(self.semi_axes)

    @property
    def narrowest(self) -> float:
        """The shortest semi-axis, in m."""
        return min(self.semi_axes)

    @property
    def curvature_radius(self) -> float:
        """Smallest semi-axis squared over the largest, in m: the sharper ends of the longest axis."""
        return min(self.semi_axes) ** 2 / max(self.semi_axes)

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the poles and three sections."""
        a, b, c = self.semi_axes
        unit = ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0), *circle(1.0, 0.0), *circle(0.8, 0.6), *circle(0.8, -0.6))
        return tuple((a * x, b * y, c * z) for x, y, z in unit)
