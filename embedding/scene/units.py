"""Numbers at the door: SI floats, or text with a unit such as "0.2 mm", checked for dimension and range.

Values are stored in SI. The unit library takes as long to load as all of ngsolve. So prefixes of SI units and one
division are worked out here; the library is imported for all other texts, and for what is wrong with them.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from decimal import Decimal
from functools import cache, lru_cache
from numbers import Integral, Real
from typing import Annotated, Any

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from embedding.scene.messages import printable, refusal

LARGEST = 1e30
"""Largest magnitude accepted anywhere; products of a few such numbers still fit into a float."""

_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?(?:[0-9]{1,40}\.?[0-9]{0,40}|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,4})?)\s*(?P<unit>.{0,40})"
)
_UNIT = re.compile(r"(?:[^\W\d_]+|[ */()·]|(?:\*\*|\^)-?[0-9](?![0-9]))+")

_PREFIXES = {"": 0, "n": -9, "u": -6, "µ": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}
_SIMPLE = re.compile(r"(?P<prefix>[nuµmckMG]?)(?P<unit>m|Pa|V|N|A|C|T)(?:(?:\^|\*\*)(?P<power>[2-9]))?")
_TURN = {("deg", "rad"): Decimal("3.1415926535897932384626433832795028841971693993751") / 180}


@cache
def _registry() -> Any:
    """The unit registry, in decimal arithmetic so that "1.1 mm" is the float 0.0011 and not its neighbour."""
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


@lru_cache(maxsize=256)
def unit_factor(unit: str, si: str) -> Decimal:
    """How many ``si`` units one ``unit`` holds, for example ``unit_factor("kPa", "Pa") == 1000``.

    Raises:
        ValueError: unknown unit, or one of another dimension; the text says which.
    """
    if unit == si:
        return Decimal(1)
    known = plain_factor(unit, si)
    if known is not None:
        return known
    if not _UNIT.fullmatch(unit):
        raise ValueError(f'"{printable(unit)}" is not a unit')
    import pint

    registry = _registry()
    try:
        quantity = registry.Quantity(Decimal(1), registry.parse_units(unit.replace("·", "*")))
        return Decimal(quantity.to(si).magnitude)
    except pint.UndefinedUnitError as error:
        raise ValueError(f'unknown unit "{unit}"') from error
    except pint.DimensionalityError as error:
        dimension = str(error.dim1).strip(" ()").replace("[", "").replace("]", "")
        raise ValueError(f'"{unit}" is a unit of {dimension}') from error
    except Exception as error:  # the unit library answers odd text with many kinds of error
        raise ValueError(f'"{printable(unit)}" is not a unit') from error


def plain_factor(unit: str, si: str) -> Decimal | None:
    """The same for SI units with prefixes and their quotients, such as "kV/mm" for "V/m"; None for all others."""
    stated, wanted = ([_simple(part) for part in text.split("/")] for text in (unit, si))
    if len(stated) != len(wanted) or len(stated) > 2:
        return None
    exponent = 0
    for sign, one, other in zip((1, -1), stated, wanted, strict=False):
        if one is None or other is None or one[1:] != other[1:]:
            return _TURN.get((unit, si))
        exponent += sign * (one[0] - other[0])
    return Decimal(1).scaleb(exponent)


def _simple(text: str) -> tuple[int, str, int] | None:
    """Power of ten, unit without prefix and power of the unit: (-9, "m", 3) for "mm^3"; None for what is not simple."""
    match = _SIMPLE.fullmatch(text)
    if match is None:
        return None
    power = int(match["power"] or 1)
    return power * _PREFIXES[match["prefix"]], match["unit"], power


def parse_quantity(text: str, si: str) -> float:
    """Read "0.2 mm" as a float in the unit ``si``.

    Raises:
        ValueError: no number, no unit, unknown unit or another dimension; the text says which.
    """
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise ValueError("not a number with a unit")
    unit = match["unit"].strip()
    if not unit:
        raise ValueError("text without a unit")
    return float(Decimal(match["number"]) * unit_factor(unit, si))


@dataclass(frozen=True)
class Number:
    """Validator of one number: reads units, refuses booleans, nan, inf and values out of range."""

    noun: str = "number"
    unit: str | None = None
    example: str | None = None
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    whole: bool = False

    @property
    def allowed(self) -> str:
        """What may stand here: ``must be a length greater than 0, such as "0.2 mm"``."""
        noun = "whole number" if self.whole else self.noun
        article = "an" if noun[0] in "aeiou" else "a"
        example = f', such as "{self.example}"' if self.example else ""
        of = " of" if self.above is None and self._range() else ""
        return f"must be {article} {noun}{of}{self._range()}{example}"

    def __call__(self, value: Any) -> float | int:
        number = self._convert(value)
        if isinstance(number, float) and not math.isfinite(number):
            raise self._refusal("must be finite")
        outside = (
            (self.above is not None and number <= self.above)
            or (self.at_least is not None and number < self.at_least)
            or (self.at_most is not None and number > self.at_most)
        )
        if outside:
            raise self._refusal(f"must be{self._range()}")
        if abs(number) > LARGEST:
            raise self._refusal(f"must be at most {LARGEST:g} in magnitude")
        if self.above == 0 and number < 1 / LARGEST:
            raise self._refusal(f"must be at least {1 / LARGEST:g}")
        return number

    def _convert(self, value: Any) -> float | int:
        if isinstance(value, str) and self.unit is not None:
            try:
                return parse_quantity(value, self.unit)
            except ValueError as error:
                raise self._refusal(f"{error}: {self.allowed}") from error
        if self.whole and isinstance(value, Integral) and not isinstance(value, bool):
            return int(value)
        if self.whole or isinstance(value, bool) or not isinstance(value, Real):
            raise self._refusal(self.allowed)
        try:
            return float(value)
        except OverflowError:
            return math.inf

    def _range(self) -> str:
        bounds = (("greater than", self.above), ("at least", self.at_least), ("at most", self.at_most))
        words = [f"{word} {bound:g}" for word, bound in bounds if bound is not None]
        return f" {' and '.join(words)}" if words else ""

    def _refusal(self, reason: str) -> PydanticCustomError:
        return refusal(reason, self.unit or "")


def _positive(number: Number) -> Number:
    return replace(number, above=0.0)


LENGTH = Number("length", "m", "0.2 mm")
PRESSURE = Number("pressure", "Pa", "100 kPa")
VOLTAGE = Number("voltage", "V", "6 kV")
LINE_FORCE = Number("force per length", "N/m", "3 N/m")
FORCE_DENSITY = Number("force per volume", "N/m^3", "10 kN/m^3")
FORCE = Number("force", "N", "3 N")
EDGE_MOMENT = Number("moment per length (a force)", "N", "3 N")
ACCELERATION = Number("acceleration", "m/s^2", "9.81 m/s^2")
DENSITY = Number("density", "kg/m^3", "1100 kg/m^3")
COORDINATE = Number("length", "m", "0.2 mm")
ELECTRIC_FIELD = Number("electric field", "V/m", "2 kV/mm")
MAGNETIC_FIELD = Number("magnetic field", "A/m", "5 kA/m")
CHARGE = Number("charge", "C", "2 nC")
CURRENT = Number("current", "A", "3 A")
FLUX_DENSITY = Number("flux density", "T", "50 mT")
POLARISATION = Number("polarisation", "C/m^2", "1 mC/m^2")

Plain = Annotated[float, BeforeValidator(Number())]
Ratio = Annotated[float, BeforeValidator(_positive(Number()))]
Length = Annotated[float, BeforeValidator(_positive(LENGTH))]
PositivePressure = Annotated[float, BeforeValidator(_positive(PRESSURE))]
NonNegativePressure = Annotated[float, BeforeValidator(replace(PRESSURE, at_least=0.0))]
Pressure = Annotated[float, BeforeValidator(PRESSURE)]
Voltage = Annotated[float, BeforeValidator(VOLTAGE)]
LineForce = Annotated[float, BeforeValidator(LINE_FORCE)]
ForceDensity = Annotated[float, BeforeValidator(FORCE_DENSITY)]
Force = Annotated[float, BeforeValidator(FORCE)]
EdgeMomentValue = Annotated[float, BeforeValidator(EDGE_MOMENT)]
Acceleration = Annotated[float, BeforeValidator(ACCELERATION)]
Density = Annotated[float, BeforeValidator(_positive(DENSITY))]
Coordinate = Annotated[float, BeforeValidator(COORDINATE)]
Charge = Annotated[float, BeforeValidator(CHARGE)]
Current = Annotated[float, BeforeValidator(CURRENT)]
MagneticPotential = Annotated[float, BeforeValidator(replace(CURRENT, noun="magnetic potential"))]
FluxDensity = Annotated[float, BeforeValidator(FLUX_DENSITY)]
PositiveFluxDensity = Annotated[float, BeforeValidator(_positive(FLUX_DENSITY))]
Polarisation = Annotated[float, BeforeValidator(POLARISATION)]


def _components(value: Any) -> Any:
    """Accept a list, a tuple or an array of three; anything unordered or of another length is refused."""
    if not isinstance(value, (str, bytes, dict)) and hasattr(value, "tolist"):
        value = value.tolist()
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise refusal("must be a list of 3 components [x, y, z]")
    return value


Components = BeforeValidator(_components)
LineForceVector = Annotated[tuple[LineForce, LineForce, LineForce], Components]
ForceDensityVector = Annotated[tuple[ForceDensity, ForceDensity, ForceDensity], Components]
ForceVector = Annotated[tuple[Force, Force, Force], Components]
PressureVector = Annotated[tuple[Pressure, Pressure, Pressure], Components]
AccelerationVector = Annotated[tuple[Acceleration, Acceleration, Acceleration], Components]
LengthVector = Annotated[tuple[Coordinate, Coordinate, Coordinate], Components]
PositiveLengthVector = Annotated[tuple[Length, Length, Length], Components]
FluxDensityVector = Annotated[tuple[FluxDensity, FluxDensity, FluxDensity], Components]
PolarisationVector = Annotated[tuple[Polarisation, Polarisation, Polarisation], Components]
PlainVector = Annotated[tuple[Plain, Plain, Plain], Components]
