"""Mechanical loads: pressures on the two faces, dead loads on edges and in the volume."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Tag

from embedding.scene.expression import FLOAT_FUNCTIONS, Expression, Functions, parse_expression
from embedding.scene.messages import TABLE, VALUE, refusal
from embedding.scene.part import Part
from embedding.scene.texts import Line, Name
from embedding.scene.units import ForceDensityVector, LineForceVector, Pressure, unit_factor


def _expression(value: Any) -> Any:
    try:
        return parse_expression(value).text if isinstance(value, str) else value
    except ValueError as error:
        raise refusal(str(error)) from error


def _pressure_unit(value: Any) -> str:
    unit = Line(limit=40)(value)
    try:
        unit_factor(unit, "Pa")
    except ValueError as error:
        raise refusal(f"{error}: must be a unit of pressure, such as kPa") from error
    return unit


class PressureField(Part):
    """A pressure over the reference mid-surface: ``expression`` in x, y, z (metre), times ``unit``."""

    expression: Annotated[str, BeforeValidator(_expression)]
    unit: Annotated[str, BeforeValidator(_pressure_unit)] = "Pa"

    @property
    def parsed(self) -> Expression:
        """The expression, ready to be evaluated."""
        return parse_expression(self.expression)

    @property
    def factor(self) -> float:
        """Pascal per ``unit``."""
        return float(unit_factor(self.unit, "Pa"))

    def __call__(self, x: Any, y: Any, z: Any, functions: Functions = FLOAT_FUNCTIONS) -> Any:
        """Pressure in Pa at a point in m; on other objects than floats pass their ``functions``."""
        return self.factor * self.parsed(x, y, z, functions)


def _value_or_table(value: Any) -> str:
    return TABLE if isinstance(value, (dict, PressureField)) else VALUE


FacePressure = Annotated[
    Annotated[Pressure, Tag(VALUE)] | Annotated[PressureField, Tag(TABLE)],
    Discriminator(_value_or_table),
]


class EdgeTraction(Part):
    """A dead load on an edge of the shape, in N per metre of the reference edge."""

    edge: Name
    traction: LineForceVector


class Loads(Part):
    """Mechanical loads; positive pressures push on their face (top along -n, bottom along +n).

    ``rim`` says whether the thin rim face is free or pressed by the mean of the two pressures. ``variant``
    selects how face pressures act: with the shell's finite thickness ("embedding-aware"), as their difference
    on the mid-surface ("net"), or in the form first published ("as-published").
    """

    pressure_top: FacePressure = 0.0
    pressure_bottom: FacePressure = 0.0
    edge_tractions: tuple[EdgeTraction, ...] = ()
    body_force: ForceDensityVector = (0.0, 0.0, 0.0)
    rim: Literal["traction-free", "pressurised"] = "traction-free"
    variant: Literal["embedding-aware", "net", "as-published"] = "embedding-aware"

    @property
    def pressure_fields(self) -> dict[str, PressureField]:
        """The face pressures that vary over the surface, by their field name."""
        pressures = {"pressure_top": self.pressure_top, "pressure_bottom": self.pressure_bottom}
        return {name: value for name, value in pressures.items() if isinstance(value, PressureField)}
