"""Names and units for people: letters of the field, and prefixes that bring numbers between 1 and 1000."""

from __future__ import annotations

import math

PREFIXES = {-4: "p", -3: "n", -2: "µ", -1: "m", 0: "", 1: "k", 2: "M", 3: "G"}
NAMES = {
    "stretch": "stretch",
    "stretch_major": "larger principal stretch",
    "stretch_minor": "smaller principal stretch",
    "thickness_stretch": "thickness stretch",
    "moment_major": "larger bending moment",
    "moment_minor": "smaller bending moment",
    "p_t": "top face pressure $p_t$",
    "p_b": "bottom face pressure $p_b$",
    "u": "displacement $|u|$",
    "E": "electric field $|E|$",
    "H": "magnetic field $|H|$",
    "D": "flux density $|D|$",
    "B": "flux density $|B|$",
    "energy_density": "field energy density",
    "phi": r"potential $\varphi$",
    "t_t": "top face traction $|t_t|$",
    "t_b": "bottom face traction $|t_b|$",
}
SCALARS = {
    "stretch": "mean stretch",
    "displacement": "displacement (root mean square)",
    "pressure_difference": "inflating pressure $p_b - p_t$",
    "pressure_top": "mean $p_t$",
    "pressure_bottom": "mean $p_b$",
    "factor_mechanical": "load factor",
    "factor_field": "field factor",
    "step": "accepted step",
}
"""Of scalars, where their own name does not say it."""


def prefixed(size: float, unit: str) -> tuple[float, str]:
    """Factor and unit with prefix in which a number of about ``size`` is pleasant: 7e5 V/m gives 1e-3 and
    kV/m."""
    if unit in ("", "1") or not math.isfinite(size) or size == 0.0:
        return 1.0, "" if unit == "1" else unit
    step = min(max(math.floor(math.log10(abs(size)) / 3 + 1e-9), min(PREFIXES)), max(PREFIXES))
    return 1000.0**-step, PREFIXES[step] + unit


def quantity(size: float, unit: str) -> str:
    """A number with its unit: 6000 V is "6 kV"; a ratio keeps its zeros, "1.3000"."""
    if unit == "1":
        return f"{size:#.5g}"
    factor, name = prefixed(size, unit)
    return f"{factor * size:.4g} {name}"


def label(name: str, unit: str) -> str:
    """Text beside an axis or a colour bar."""
    text = NAMES.get(name, name.replace("_", " "))
    return _with_unit(text, unit)


def scalar_label(name: str, unit: str) -> str:
    """The same for a scalar of the steps."""
    return _with_unit(SCALARS.get(name, name.replace("_", " ")), unit)


def _with_unit(text: str, unit: str) -> str:
    unit = unit.replace("^2", "²").replace("^3", "³")
    return f"{text} [{unit}]" if unit else text


def round_length(length: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above ``length``."""
    power = 10.0 ** math.floor(math.log10(length))
    return max(factor * power for factor in (1, 2, 5) if factor * power <= length * (1 + 1e-9))
