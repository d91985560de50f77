"""Rigid bodies that stand still beside the shell: conductors, poles, magnets and dielectrics."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Tag, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import Part, kind_under
from embedding.scene.units import (
    Charge,
    Coordinate,
    FluxDensityVector,
    Length,
    LengthVector,
    MagneticPotential,
    PositiveLengthVector,
    Ratio,
    Voltage,
)

Point = tuple[float, float, float]
ELECTRIC = ("voltage", "charge", "relative_permittivity")
MAGNETIC = ("potential", "relative_permeability", "remanence")
"""What a body may have in an electric and in a magnetic field."""


class Solid(Part):
    """What a body does to the field.

    A conductor has a ``voltage`` in V or a ``charge`` in C (in plane strain that of a metre), a pole (an infinitely
    permeable body in a magnetic field) a ``potential`` in A. Any other body has a field inside, with its
    permittivity or permeability relative to vacuum and, in a magnetic field, a ``remanence`` in T.
    """

    voltage: Voltage | None = None
    charge: Charge | None = None
    potential: MagneticPotential | None = None
    relative_permittivity: Ratio | None = None
    relative_permeability: Ratio | None = None
    remanence: FluxDensityVector | None = None

    @property
    def given(self) -> tuple[str, ...]:
        """Names of its fields that say what it is."""
        return tuple(name for name in (*ELECTRIC, *MAGNETIC) if getattr(self, name) is not None)

    @property
    def is_conductor(self) -> bool:
        """Is it at one potential, without a field inside?"""
        return any(value is not None for value in (self.voltage, self.charge, self.potential))

    @property
    def strength(self) -> float:
        """The voltage, charge or potential that is given; 0 without."""
        return self.voltage or self.charge or self.potential or 0.0

    @property
    def contrast(self) -> float:
        """Its relative permittivity or permeability, whichever is given; 1 without."""
        return self.relative_permittivity or self.relative_permeability or 1.0

    @abstractmethod
    def reach(self, axes: int) -> Point:
        """How far it extends from the origin along each axis, in m; ``axes`` is 2 in plane strain, else 3."""

    def farthest(self, axes: int) -> float:
        """How far from the origin (plane strain: from the axis) its farthest point is, in m."""
        return math.hypot(*self.reach(axes)[:axes])

    @abstractmethod
    def clearance(self, point: Point, axes: int) -> float:
        """Positive at points outside, negative inside: at most the distance to its surface, in m."""

    @model_validator(mode="after")
    def _is_something(self) -> Self:
        given = self.given
        if not given:
            reason = "a conductor needs a voltage, a charge or a potential, another body its constants"
            raise refusal(reason, field="voltage", value=None)
        alone = "voltage", "charge", "potential", "relative_permittivity"
        if len(given) > 1 and any(name in alone for name in given):
            reason = f"a body with a {given[0]} has nothing else but its place; leave out one of the two"
            raise refusal(reason, field=given[1], value=getattr(self, given[1]))
        return self


class SphereBody(Solid):
    """A ball; in plane strain a circular cylinder along z."""

    kind: Literal["sphere"] = "sphere"
    centre: LengthVector
    radius: Length

    def reach(self, axes: int) -> Point:
        """See ``Solid``."""
        return _reach(self.centre, (self.radius, self.radius, self.radius))

    def farthest(self, axes: int) -> float:
        """See ``Solid``."""
        return math.hypot(*self.centre[:axes]) + self.radius

    def clearance(self, point: Point, axes: int) -> float:
        """See ``Solid``."""
        return math.dist(point[:axes], self.centre[:axes]) - self.radius


class CylinderBody(Solid):
    """A circular cylinder with its axis along z, of finite ``length``; in plane strain of any."""

    kind: Literal["cylinder"] = "cylinder"
    centre: LengthVector
    radius: Length
    length: Length

    def reach(self, axes: int) -> Point:
        """See ``Solid``."""
        return _reach(self.centre, (self.radius, self.radius, self.length / 2))

    def farthest(self, axes: int) -> float:
        """See ``Solid``."""
        across = math.hypot(*self.centre[:2]) + self.radius
        return across if axes == 2 else math.hypot(across, self.reach(axes)[2])

    def clearance(self, point: Point, axes: int) -> float:
        """See ``Solid``."""
        across = math.dist(point[:2], self.centre[:2]) - self.radius
        return across if axes == 2 else max(across, abs(point[2] - self.centre[2]) - self.length / 2)


class BoxBody(Solid):
    """A box along the axes with edge lengths ``size``; in plane strain a rectangle, whose z counts for nothing."""

    kind: Literal["box"] = "box"
    centre: LengthVector
    size: PositiveLengthVector

    def reach(self, axes: int) -> Point:
        """See ``Solid``."""
        x, y, z = self.size
        return _reach(self.centre, (x / 2, y / 2, z / 2))

    def clearance(self, point: Point, axes: int) -> float:
        """See ``Solid``."""
        sides = list(zip(point, self.centre, self.size, strict=True))
        return max(abs(p - c) - edge / 2 for p, c, edge in sides[:axes])


class HalfSpace(Solid):
    """A conductor or pole that fills everything below z = ``level``, in plane strain below y = ``level``."""

    kind: Literal["half-space"] = "half-space"
    level: Coordinate

    @model_validator(mode="after")
    def _is_held(self) -> Self:
        if self.voltage is None and self.potential is None:
            reason = "a half-space is at a voltage, or in a magnetic field at a potential"
            name = self.given[0]
            raise refusal(reason, field=name, value=getattr(self, name))
        return self

    def reach(self, axes: int) -> Point:
        """See ``Solid``: that of its surface."""
        return (0.0, abs(self.level), 0.0) if axes == 2 else (0.0, 0.0, abs(self.level))

    def clearance(self, point: Point, axes: int) -> float:
        """See ``Solid``."""
        return point[axes - 1] - self.level


def _reach(centre: Point, half: Point) -> Point:
    x, y, z = (abs(c) + h for c, h in zip(centre, half, strict=True))
    return x, y, z


Body = Annotated[
    Annotated[SphereBody, Tag("sphere")]
    | Annotated[CylinderBody, Tag("cylinder")]
    | Annotated[BoxBody, Tag("box")]
    | Annotated[HalfSpace, Tag("half-space")],
    Discriminator(kind_under("kind")),
]
