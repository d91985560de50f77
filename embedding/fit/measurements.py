"""Tests of a material: nominal stress over stretch, and the CSV file that holds them."""

from __future__ import annotations

import csv
import math
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from embedding.fit.errors import FitError
from embedding.scene.messages import choice
from embedding.scene.units import unit_factor

Array = npt.NDArray[np.float64]
Mode = Literal["uniaxial", "equibiaxial", "pure-shear"]
MODES: tuple[Mode, ...] = get_args(Mode)
MAX_BYTES = 4_000_000
HEADER = "mode, stretch, nominal_stress [unit]"
_STRESS = re.compile(r"nominal_stress\s*\[(?P<unit>[^\]]*)\]")


@dataclass(frozen=True)
class Series:
    """Points of one kind of test: ``stretch`` along the pull and ``nominal_stress`` in Pa, arrays of one length."""

    mode: Mode
    stretch: Array
    nominal_stress: Array


@dataclass(frozen=True)
class Measurements:
    """One series of points for each kind of test that was made; ``source`` names the file, if any."""

    series: tuple[Series, ...]
    source: str = ""

    @classmethod
    def of(cls, tables: Mapping[str, tuple[Any, Any]], source: str = "") -> Measurements:
        """From arrays: ``{"uniaxial": (stretches, nominal stresses in Pa)}``.

        Raises:
            FitError: unknown kind of test, lengths that differ, a stretch that is not positive, no point at all.
        """
        series = tuple(_series(mode, *columns, source) for mode, columns in tables.items())
        if not any(len(one.stretch) for one in series):
            raise _refused(source, "there is no point in these data")
        return cls(series, source)

    def __len__(self) -> int:
        return sum(len(one.stretch) for one in self.series)


def _series(mode: str, stretches: Any, stresses: Any, source: str) -> Series:
    if mode not in MODES:
        raise _refused(source, f"mode: {choice(mode, MODES)}")
    stretch, stress = np.array(stretches, float), np.array(stresses, float)
    if stretch.ndim != 1 or stretch.shape != stress.shape:
        raise _refused(source, f"{mode}: needs as many stresses as stretches, not {stress.size} and {stretch.size}")
    if not (np.isfinite(stretch).all() and np.isfinite(stress).all() and (stretch > 0).all()):
        raise _refused(source, f"{mode}: stretches must be greater than 0, and all numbers finite")
    return Series(mode, stretch, stress)


def read_measurements(path: str | os.PathLike[str]) -> Measurements:
    """Read a CSV file with the columns ``mode, stretch, nominal_stress [unit]``; lines that begin with # are skipped.

    Modes are uniaxial, equibiaxial and pure-shear; nominal stress is force per undeformed area.

    Raises:
        FitError: the file cannot be read, or the first thing in it that is wrong, with its line.
    """
    source = os.fspath(path)
    lines = _lines(source)
    try:
        number, names = next(lines)
        columns, factor = _columns(names, f"{source}: line {number}")
    except StopIteration:
        raise FitError(f"{source}: empty: the first line must be {HEADER}") from None
    points: dict[str, tuple[list[float], list[float]]] = {}
    for number, cells in lines:
        mode, stretch, stress = _point(cells, columns, f"{source}: line {number}")
        stretches, stresses = points.setdefault(mode, ([], []))
        stretches.append(stretch)
        stresses.append(factor * stress)
    return Measurements.of(points, source)


def _lines(source: str) -> Iterator[tuple[int, list[str]]]:
    """Numbered rows of cells, without comments and empty lines."""
    try:
        with Path(source).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
        text = data.decode("utf-8-sig")
    except FileNotFoundError:
        raise FitError(f"{source}: there is no such file") from None
    except UnicodeDecodeError as error:
        raise FitError(f"{source}: not UTF-8 text: byte {error.start} cannot be decoded") from error
    except (OSError, ValueError) as error:
        raise FitError(f"{source}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if len(data) > MAX_BYTES:
        raise FitError(f"{source}: too large for a table of tests: more than {MAX_BYTES} bytes")
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, [cell.strip() for cell in next(csv.reader([line], skipinitialspace=True))]


def _columns(names: list[str], where: str) -> tuple[dict[str, int], float]:
    """Where the three columns are, and how many Pa the unit of stress holds."""
    columns = {name: at for at, name in enumerate(names) if name in ("mode", "stretch")}
    units = {at: match["unit"].strip() for at, name in enumerate(names) if (match := _STRESS.fullmatch(name))}
    if len(columns) != 2 or len(units) != 1 or len(names) != 3:
        found = ", ".join(names)[:60]
        raise FitError(f"{where}: must name the columns {HEADER}, such as nominal_stress [MPa]; not {found}")
    (columns["nominal_stress"], unit) = next(iter(units.items()))
    try:
        return columns, float(unit_factor(unit, "Pa"))
    except ValueError as error:
        raise FitError(f"{where}: {error}: must be a unit of stress, such as MPa") from error


def _point(cells: list[str], columns: dict[str, int], where: str) -> tuple[str, float, float]:
    if len(cells) != len(columns):
        raise FitError(f"{where}: must hold {len(columns)} values, not {len(cells)}")
    mode = cells[columns["mode"]]
    if mode not in MODES:
        raise FitError(f"{where}: mode: {choice(mode, MODES)}")
    stretch, stress = (_number(cells[columns[name]], f"{where}: {name}") for name in ("stretch", "nominal_stress"))
    if stretch <= 0.0:
        raise FitError(f"{where}: stretch: {stretch:g} is not allowed: must be greater than 0")
    return mode, stretch, stress


def _number(text: str, where: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise FitError(f'{where}: "{text[:40]}" is not allowed: must be a finite number')
    return number


def _refused(source: str, message: str) -> FitError:
    return FitError(f"{source}: {message}" if source else message)
