"""What `embedding fit` tells about a fit: as plain data, and as a TOML table with remarks."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from embedding.cli.output import number

if TYPE_CHECKING:
    from pathlib import Path

    from embedding.fit import Fit, Parameter

DIGITS = 8
"""Of the printed parameters: more than any data determine, enough to repeat the printed errors."""


def fit_summary(fit: Fit) -> dict[str, Any]:
    """Everything about a fit except the points, as plain data; uncertainties the data do not give are null."""
    return {
        "material": fit.material.model_dump(mode="json"),
        "parameters": [asdict(parameter) for parameter in fit.parameters],
        "rms": fit.rms,
        "errors": [asdict(error) for error in fit.errors],
        "doubts": [{**asdict(doubt), "message": doubt.message} for doubt in fit.doubts],
    }


def print_fit(fit: Fit, picture: Path | None) -> None:
    """Print the material as it stands in a scene file, and the rest as remarks there."""
    from embedding.scene.toml_io import write_table

    print(write_table({"shell": {"material": _rounded(fit.material.model_dump())}}))
    for error in fit.errors:
        stated = f"rms {number(error.rms / 1e3)} kPa, largest relative error {100 * error.largest_relative:.3g} %"
        print(f"# {error.mode}: {error.points} points, {stated}")
    for parameter in fit.parameters:
        print(f"# {_line(parameter)}")
    for doubt in fit.doubts:
        print(f"# warning: {doubt.message}")
    if picture is not None:
        print(f"# {picture}")


def _line(parameter: Parameter) -> str:
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    spread = f"{parameter.uncertainty:.2g}" if math.isfinite(parameter.uncertainty) else "unknown"
    return f"{parameter.name} = {parameter.value:.6g} +- {spread}{unit}"


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(item) for item in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value
