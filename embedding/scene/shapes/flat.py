"""Mid-surfaces made of flat pieces."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import known
from embedding.scene.shapes.base import Point, Revolved, Surface, circle
from embedding.scene.units import Length


class Plate(Surface):
    """A flat rectangle: x in [0, length], y in [0, width], z = 0, normal +z; ``centred``, its middle is the origin."""

    kind: Literal["plate"] = "plate"
    length: Length
    width: Length
    centred: bool = False

    @property
    def edges(self) -> tuple[str, ...]:
        """By the coordinate that is constant there, at its lower and upper end."""
        return ("x0", "x1", "y0", "y1")

    @property
    def mirrors(self) -> tuple[str, ...]:
        """A centred plate lies across x = 0 and y = 0."""
        return ("x", "y") if self.centred else ()

    def mirror_image(self, edge: str, axis: str) -> str:
        """The opposite edge, across x or y."""
        return {f"{axis}0": f"{axis}1", f"{axis}1": f"{axis}0"}.get(edge, edge)

    @property
    def size(self) -> float:
        """The longer side, in m."""
        return max(self.length, self.width)

    @property
    def narrowest(self) -> float:
        """The shorter side, in m."""
        return min(self.length, self.width)

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: corners, centre and one without symmetry."""
        parts = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5), (0.31, 0.77))
        start = 0.5 if self.centred else 0.0
        return tuple(((a - start) * self.length, (b - start) * self.width, 0.0) for a, b in parts)


class Disc(Surface):
    """A flat circular disc around the origin in the plane z = 0, normal +z."""

    kind: Literal["disc"] = "disc"
    radius: Length

    @property
    def edges(self) -> tuple[str, ...]:
        """The circle around it."""
        return ("rim",)

    @property
    def reductions(self) -> tuple[str, ...]:
        """In 3D and by its radius."""
        return ("3d", "axisymmetric")

    @property
    def mirrors(self) -> tuple[str, ...]:
        """It lies across x = 0 and y = 0."""
        return ("x", "y")

    @property
    def size(self) -> float:
        """The radius, in m."""
        return self.radius

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: the centre and two circles."""
        return ((0.0, 0.0, 0.0), *circle(self.radius, 0.0), *circle(0.6 * self.radius, 0.0))


class Annulus(Revolved):
    """A flat ring around the origin in the plane z = 0, normal +z, or a sector of it.

    With ``slit`` the whole ring is cut along the positive x axis; ``lip0`` is the lip on the side of positive y,
    ``lip1`` lies in the same place on the other side and is not joined to it.
    """

    kind: Literal["annulus"] = "annulus"
    inner_radius: Length
    outer_radius: Length
    slit: bool = False

    @model_validator(mode="after")
    def _hole_fits(self) -> Self:
        if self.inner_radius >= self.outer_radius:
            reason = f"must be less than outer_radius = {self.outer_radius} m"
            raise refusal(reason, "m", field="inner_radius", value=self.inner_radius)
        if self.slit and self.angle is not None:
            raise refusal("a sector is open already: leave out slit or angle", field="slit", value=self.slit)
        return self

    @property
    def edges(self) -> tuple[str, ...]:
        """The two circles, and what a sector or a slit adds."""
        return ("inner", "outer", *self.sides, *(("lip0", "lip1") if known(self.slit) else ()))

    @property
    def reductions(self) -> tuple[str, ...]:
        """A slit ring only in 3D."""
        return ("3d",) if self.slit else super().reductions

    @property
    def mirrors(self) -> tuple[str, ...]:
        """A slit ring is meshed as it is."""
        return () if self.slit else super().mirrors

    @property
    def surroundable(self) -> bool:
        """The lips of a slit lie in one place."""
        return not self.slit

    @property
    def size(self) -> float:
        """The outer radius, in m."""
        return self.outer_radius

    @property
    def narrowest(self) -> float:
        """From the inner to the outer circle, or along the arc, in m."""
        return min(self.outer_radius - self.inner_radius, self._along(self.outer_radius))

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m, on three circles."""
        radii = (self.inner_radius, 0.37 * self.inner_radius + 0.63 * self.outer_radius, self.outer_radius)
        return tuple(point for radius in radii for point in self._ring(radius, 0.0))


class TSection(Surface):
    """Two square plates glued to a T: x = 0, y and z in [0, length], and on top z = length, x in [-length/2, length/2].

    The normal of the vertical plate is +x, that of the horizontal one +z. Three plates meet in the line ``junction``.
    """

    kind: Literal["t-section"] = "t-section"
    length: Length

    @property
    def edges(self) -> tuple[str, ...]:
        """Foot, ends of the top plate, both plates' edges at y = 0 and y = length, and where the plates meet."""
        return ("bottom", "left", "right", "front", "back", "junction")

    @property
    def surroundable(self) -> bool:
        """Three plates meet."""
        return False

    @property
    def size(self) -> float:
        """The side of a plate, in m."""
        return self.length

    @property
    def narrowest(self) -> float:
        """Half of the top plate, in m."""
        return self.length / 2

    def sample_points(self) -> tuple[Point, ...]:
        """A few points of the mid-surface, in m: corners, middles and one without symmetry on either plate."""
        parts = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5), (0.31, 0.77))
        vertical = tuple((0.0, a * self.length, b * self.length) for a, b in parts)
        return (*vertical, *(((a - 0.5) * self.length, b * self.length, self.length) for a, b in parts))
