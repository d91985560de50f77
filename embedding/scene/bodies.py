"""Rigid bodies that stand still beside the shell: conductors, poles, magnets and dielectrics."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Tag

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


class BodyBase(Part):
    """What a body does to the field.

    A conductor has a ``voltage`` in V or a ``charge`` in C (C per metre in plane strain), a pole (an infinitely
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
    def is_conductor(self) -> bool:
        """Is it at one potential, without a field inside?"""
        return any(value is not None for value in (self.voltage, self.charge, self.potential))

    @property
    def contrast(self) -> float:
        """Its relative permittivity or permeability, whichever is given; 1 without."""
        return self.relative_permittivity or self.relative_permeability or 1.0


class SphereBody(BodyBase):
    """A ball; in plane strain a circular cylinder along z."""

    kind: Literal["sphere"] = "sphere"
    centre: LengthVector
    radius: Length


class CylinderBody(BodyBase):
    """A circular cylinder of finite ``length`` with its axis along z."""

    kind: Literal["cylinder"] = "cylinder"
    centre: LengthVector
    radius: Length
    length: Length


class BoxBody(BodyBase):
    """A box along the axes with edge lengths ``size``; in plane strain a rectangle, whose z counts for nothing."""

    kind: Literal["box"] = "box"
    centre: LengthVector
    size: PositiveLengthVector


class HalfSpace(BodyBase):
    """Everything below z = ``level``, in plane strain below y = ``level``."""

    kind: Literal["half-space"] = "half-space"
    level: Coordinate


Body = Annotated[
    Annotated[SphereBody, Tag("sphere")]
    | Annotated[CylinderBody, Tag("cylinder")]
    | Annotated[BoxBody, Tag("box")]
    | Annotated[HalfSpace, Tag("half-space")],
    Discriminator(kind_under("kind")),
]
