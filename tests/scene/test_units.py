"""Text with a unit: exact in SI, of the right dimension, and never slow."""

from __future__ import annotations

from decimal import Decimal
from itertools import product

import pint
import pytest

from embedding.scene.units import parse_quantity, plain_factor, unit_factor


@pytest.mark.parametrize(
    ("text", "si", "value"),
    [
        ("0.2 mm", "m", 0.0002),
        ("1.1mm", "m", 0.0011),
        ("  3e-4 m ", "m", 0.0003),
        (".5 cm", "m", 0.005),
        ("5. µm", "m", 5e-6),
        ("+1 inch", "m", 0.0254),
        ("-2 meter", "m", -2.0),
        ("6 kV", "V", 6000.0),
        ("100 kPa", "Pa", 1e5),
        ("3 N/mm^2", "Pa", 3e6),
        ("3 N/mm**2", "Pa", 3e6),
        ("2 bar", "Pa", 2e5),
        ("3 N·m/m^2", "N/m", 3.0),
        ("1 kN/m^3", "N/m^3", 1000.0),
        ("2 kV/mm", "V/m", 2e6),
        ("4 kA/(m)", "A/m", 4000.0),
    ],
)
def test_exact_conversion(text: str, si: str, value: float) -> None:
    assert parse_quantity(text, si) == value


@pytest.mark.parametrize(
    ("text", "si", "reason"),
    [
        ("3 kg", "m", '"kg" is a unit of mass'),
        ("3 m^2", "m", '"m\\^2" is a unit of length \\*\\* 2'),
        ("3 rad", "m", '"rad" is a unit of dimensionless'),
        ("20 degC", "m", '"degC" is a unit of temperature'),
        ("20 K", "V", '"K" is a unit of temperature'),
        ("3 T", "A/m", '"T" is a unit of mass / time \\*\\* 2 / current'),
        ("3 dBm", "V", '"dBm" is a unit of'),
        ("3 parsnip", "m", 'unknown unit "parsnip"'),
        ("3 mpa", "Pa", 'unknown unit "mpa"'),
        ("3", "m", "text without a unit"),
        ("mm", "m", "not a number with a unit"),
        ("", "m", "not a number with a unit"),
        ("nan mm", "m", "not a number with a unit"),
        ("1_0 mm", "m", '"_0 mm" is not a unit'),
        ("٣ mm", "m", "not a number with a unit"),
        ("3 kA/(10^0 m)", "A/m", "is not a unit"),
        ("3 m*", "m", '"m\\*" is not a unit'),
        ("3 (m", "m", '"\\(m" is not a unit'),
        ("3 m^999999999", "m", '"m\\^999999999" is not a unit'),
        ("3 __import__", "m", '"__import__" is not a unit'),
        ("3 m" + "m" * 60, "m", "not a number with a unit"),
    ],
)
def test_refusal(text: str, si: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        parse_quantity(text, si)


def test_factor() -> None:
    assert unit_factor("kPa", "Pa") == 1000
    assert unit_factor("furlong*furlong", "furlong*furlong") == 1


def test_what_needs_no_library_is_as_the_library_has_it() -> None:
    registry = pint.UnitRegistry(non_int_type=Decimal)
    pairs = [(prefix + unit, unit) for prefix, unit in product(("", *"nuµmckMG"), ("m", "Pa", "V", "N", "A", "C", "T"))]
    pairs += [("kV/mm", "V/m"), ("mA/cm", "A/m"), ("uC/cm^2", "C/m^2"), ("kN/mm^3", "N/m^3"), ("N/mm**2", "N/m**2")]
    for unit, si in [*pairs, ("deg", "rad")]:
        known = registry.Quantity(Decimal(1), registry.parse_units(unit)).to(si).magnitude
        found = plain_factor(unit, si)
        assert found is not None and float(found) == float(known)  # digits beyond depend on who used pint before


@pytest.mark.parametrize("unit", ["inch", "N/mm^2", "kg", "m^2", "mm/m", "1/m", "V/m/m", "", "/", "Pam"])
def test_all_else_is_left_to_the_library(unit: str) -> None:
    assert plain_factor(unit, "Pa") is None
    assert plain_factor(unit, "N/m") is None
