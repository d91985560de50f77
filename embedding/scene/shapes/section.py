"""Cross-sections in the plane z = 0 of what is the same all along z, treated per length (plane strain)."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, model_validator

from embedding.scene.messages import refusal
from embedding.scene.shapes.base import Point, Surface, circle
from embedding.scene.units import Length, Number, Ratio


class Section(Surface):
    """A curve in the plane z = 0."""

    @property
    def reductions(self) -> tuple[str, ...]:
        """Only per length."""
        return ("plane-strain",)


class InfiniteCylinder(Section):
    """An infinitely long cylinder around the z axis with outward normal, treated per length of it.

    ``axial`` is "held", at the stretch ``axial_stretch``, or "free": open ends without traction.
    """

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
    def closed(self) -> bool:
        """Always: per length it encloses an area."""
        return True

    @property
    def mirrors(self) -> tuple[str, ...]:
        """The circle lies across x = 0 and y = 0."""
        return ("x", "y")

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    @property
    def curvature_radius(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, in the plane z = 0."""
        return circle(self.radius, 0.0)


class Strip(Section):
    """A flat strip of unit width in plane strain: x in [0, length], y = 0, normal +y."""

    kind: Literal["strip"] = "strip"
    length: Length

    @property
    def edges(self) -> tuple[str, ...]:
        """Its ends at x = 0 and x = length."""
        return ("x0", "x1")

    @property
    def size(self) -> float:
        """The length, in m."""
        return self.length

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m."""
        return tuple((part * self.length, 0.0, 0.0) for part in (0.0, 0.31, 0.5, 1.0))


class Arch(Section):
    """A circular arch of unit width in plane strain, around the origin within ``half_angle`` of +y; outward normal.

    It stands on its ends ``end0`` (negative x) and ``end1``.
    """

    kind: Literal["arch"] = "arch"
    radius: Length
    half_angle: Annotated[float, BeforeValidator(Number("angle", "rad", "30 deg", above=0.0, at_most=0.999 * pi))]

    @property
    def edges(self) -> tuple[str, ...]:
        """Its ends."""
        return ("end0", "end1")

    @property
    def size(self) -> float:
        """The radius, in m, or half the span of a shallow arch."""
        return self.radius * (sin(self.half_angle) if self.half_angle < pi / 2 else 1.0)

    @property
    def curvature_radius(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m."""
        angles = [part * self.half_angle for part in (-1.0, -0.38, 0.0, 0.6, 1.0)]
        return tuple((self.radius * sin(angle), self.radius * cos(angle), 0.0) for angle in angles)
