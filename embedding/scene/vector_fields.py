"""Vectors that depend on the place, given as three expressions in x, y and z."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from embedding.scene.messages import refusal
from embedding.scene.part import Part
from embedding.scene.surface_fields import ExpressionText, PressureField, SurfaceField, unit_of
from embedding.scene.texts import Line
from embedding.scene.units import unit_factor


def _three(value: Any) -> Any:
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise refusal("must be a list of 3 expressions, one for each of x, y and z")
    return [repr(float(v)) if isinstance(v, (int, float)) and not isinstance(v, bool) else v for v in value]


class FluxDensityComponent(SurfaceField):
    """One component of a remanence."""

    si = "T"


class PolarisationComponent(SurfaceField):
    """One component of a polarisation."""

    si = "C/m^2"


class ElectricComponent(SurfaceField):
    """One component of an electric field in space."""

    si = "V/m"


class MagneticComponent(SurfaceField):
    """One component of a magnetic field in space."""

    si = "A/m"


class VectorField(Part):
    """Three expressions in x, y, z (metre), times ``unit``."""

    component: ClassVar[type[SurfaceField]]

    expression: Annotated[tuple[ExpressionText, ExpressionText, ExpressionText], BeforeValidator(_three)]
    unit: str

    @property
    def components(self) -> tuple[SurfaceField, SurfaceField, SurfaceField]:
        """The x, y and z component, each a field of its own: call it with x, y, z and the functions of their kind."""
        x, y, z = (self.component(expression=text, unit=self.unit) for text in self.expression)
        return x, y, z


class ForceField(VectorField):
    """A dead force per reference area: three expressions in x, y, z (metre), times ``unit``."""

    component = PressureField

    unit: Annotated[str, unit_of("Pa", "pressure", "kPa")] = "Pa"


class RemanenceField(VectorField):
    """A remanence over the reference mid-surface: three expressions in x, y, z (metre), times ``unit``."""

    component = FluxDensityComponent

    unit: Annotated[str, unit_of("T", "flux density", "mT")] = "T"


class PolarisationField(VectorField):
    """A polarisation over the reference mid-surface: three expressions in x, y, z (metre), times ``unit``."""

    component = PolarisationComponent

    unit: Annotated[str, unit_of("C/m^2", "polarisation", "C/m^2")] = "C/m^2"


def _strength_unit(value: Any) -> str:
    unit = Line(limit=40)(value)
    for si in ("V/m", "A/m"):
        try:
            unit_factor(unit, si)
        except ValueError:
            continue
        return unit
    raise refusal("must be a unit of an electric or a magnetic field, such as kV/mm or kA/m")


class AppliedField(VectorField):
    """An electric or a magnetic field in space, by its ``unit``: three expressions in x, y, z (metre), times that."""

    unit: Annotated[str, BeforeValidator(_strength_unit)]

    @property
    def electric(self) -> bool:
        """Is it an electric field?"""
        try:
            return bool(unit_factor(self.unit, "V/m"))
        except ValueError:
            return False

    @property
    def components(self) -> tuple[SurfaceField, SurfaceField, SurfaceField]:
        """The x, y and z component, in V/m or A/m at a place in m."""
        kind = ElectricComponent if self.electric else MagneticComponent
        x, y, z = (kind(expression=text, unit=self.unit) for text in self.expression)
        return x, y, z
