"""Quantities that vary over the reference mid-surface, given as expressions in x, y and z."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from embedding.scene.expression import FLOAT_FUNCTIONS, VARIABLES, Expression, Functions, parse_expression
from embedding.scene.messages import TABLE, VALUE, refusal
from embedding.scene.part import Part
from embedding.scene.texts import Line
from embedding.scene.units import unit_factor


def expression_in(names: tuple[str, ...] = VARIABLES) -> BeforeValidator:
    """A validator of expressions in the variables ``names``."""

    def check(value: Any) -> Any:
        try:
            return parse_expression(value, names).text if isinstance(value, str) else value
        except ValueError as error:
            raise refusal(str(error)) from error

    return BeforeValidator(check)


def unit_of(si: str, noun: str, example: str) -> BeforeValidator:
    """A validator of units of a ``noun``, which are multiples of ``si``."""

    def check(value: Any) -> str:
        unit = Line(limit=40)(value)
        try:
            unit_factor(unit, si)
        except ValueError as error:
            raise refusal(f"{error}: must be a unit of {noun}, such as {example}") from error
        return unit

    return BeforeValidator(check)


Point = tuple[float, float, float]
ExpressionText = Annotated[str, expression_in()]


class SurfaceField(Part):
    """A quantity over the reference mid-surface, or in space: ``expression`` in x, y, z (metre), times ``unit``."""

    si: ClassVar[str]

    expression: ExpressionText
    unit: str

    @property
    def parsed(self) -> Expression:
        """The expression, ready to be evaluated."""
        return parse_expression(self.expression)

    @property
    def factor(self) -> float:
        """SI units per ``unit``."""
        return float(unit_factor(self.unit, self.si))

    def __call__(self, x: Any, y: Any, z: Any, functions: Functions = FLOAT_FUNCTIONS) -> Any:
        """The SI value at a point in m; on other objects than floats pass their ``functions``."""
        return self.factor * self.parsed(x, y, z, functions=functions)

    def value_at(self, point: Point) -> float:
        """The SI value at ``point`` in m; nan where it has none."""
        try:
            return float(self(*point))
        except (ArithmeticError, ValueError, TypeError):  # TypeError: a root of a negative number is complex
            return math.nan

    def values_at(self, points: Iterable[Point]) -> list[float]:
        """The finite SI values at ``points`` in m."""
        return [value for value in map(self.value_at, points) if math.isfinite(value)]


class PressureField(SurfaceField):
    """A pressure over the reference mid-surface: ``expression`` in x, y, z (metre), times ``unit``."""

    si = "Pa"

    unit: Annotated[str, unit_of("Pa", "pressure", "kPa")] = "Pa"


class ThicknessField(SurfaceField):
    """A thickness over the reference mid-surface: ``expression`` in x, y, z (metre), times ``unit``."""

    si = "m"

    unit: Annotated[str, unit_of("m", "length", "mm")] = "m"


def value_or_table(kind: type[Part]) -> Callable[[Any], str]:
    """A discriminator between a plain value and a table or object of ``kind``."""

    def tag(value: Any) -> str:
        return TABLE if isinstance(value, (dict, kind)) else VALUE

    return tag
