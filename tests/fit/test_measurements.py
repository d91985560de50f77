"""Tables of tests: what is read, and the one message for what is wrong."""

# ruff: noqa: E501 - one case per line, with the whole message

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding.fit import FitError, Measurements, read_measurements

GOOD = """# made up
mode, stretch, nominal_stress [kgf/cm^2]

uniaxial, 1.0, 0
uniaxial, 2.0, 6
# between
pure-shear, 1.5, "4"
uniaxial, 3.0, 9.5
"""


def test_a_table(tmp_path: Path) -> None:
    file = tmp_path / "rubber.csv"
    file.write_text(GOOD)
    data = read_measurements(file)
    assert len(data) == 4
    uniaxial, shear = data.series
    assert (uniaxial.mode, shear.mode) == ("uniaxial", "pure-shear")
    assert uniaxial.stretch == pytest.approx(np.array([1.0, 2.0, 3.0]))
    assert uniaxial.nominal_stress == pytest.approx(np.array([0.0, 6 * 98066.5, 9.5 * 98066.5]))
    assert data.source == str(file)


def test_columns_in_any_order(tmp_path: Path) -> None:
    file = tmp_path / "rubber.csv"
    file.write_text("stretch, nominal_stress [MPa], mode\n2, 0.5, equibiaxial\n")
    (series,) = read_measurements(file).series
    assert (series.mode, series.stretch[0], series.nominal_stress[0]) == ("equibiaxial", 2.0, 5e5)


HEADER = "must name the columns mode, stretch, nominal_stress [unit], such as nominal_stress [MPa]"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty: the first line must be mode, stretch, nominal_stress [unit]"),
        ("# nothing\n\n", "empty: the first line must be mode, stretch, nominal_stress [unit]"),
        ("mode, stretch, nominal_stress\n", f"line 1: {HEADER}; not mode, stretch, nominal_stress"),
        ("mode; stretch; nominal_stress [MPa]\n", f"line 1: {HEADER}; not mode; stretch; nominal_stress [MPa]"),
        ("mode, stretch, nominal_stress [mm]\n", 'line 1: "mm" is a unit of length: must be a unit of stress, such as MPa'),
        ("mode, stretch, nominal_stress [MPA]\n", 'line 1: unknown unit "MPA": must be a unit of stress, such as MPa'),
        ("mode, stretch, nominal_stress [MPa]\n", "there is no point in these data"),
        (GOOD + "biaxial, 1, 2", 'line 9: mode: "biaxial" is not allowed: must be "uniaxial", "equibiaxial" or "pure-shear"; did you mean "uniaxial"?'),
        (GOOD + "uniaxial, 1", "line 9: must hold 3 values, not 2"),
        (GOOD + "uniaxial, 1, 2, 3", "line 9: must hold 3 values, not 4"),
        (GOOD + "uniaxial, one, 2", 'line 9: stretch: "one" is not allowed: must be a finite number'),
        (GOOD + "uniaxial, 1, nan", 'line 9: nominal_stress: "nan" is not allowed: must be a finite number'),
        (GOOD + "uniaxial, -1, 2", "line 9: stretch: -1 is not allowed: must be greater than 0"),
        (GOOD + "uniaxial, 0, 2", "line 9: stretch: 0 is not allowed: must be greater than 0"),
    ],
)  # fmt: skip
def test_a_bad_table(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "rubber.csv"
    file.write_text(text)
    with pytest.raises(FitError) as raised:
        read_measurements(file)
    assert str(raised.value) == f"{file}: {message}"


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FitError, match="there is no such file"):
        read_measurements(tmp_path / "none.csv")
    with pytest.raises(FitError, match="cannot be read: Is a directory"):
        read_measurements(tmp_path)
    binary = tmp_path / "rubber.xlsx"
    binary.write_bytes(b"PK\x03\x04\xff\xfe")
    with pytest.raises(FitError, match="not UTF-8 text: byte 4 cannot be decoded"):
        read_measurements(binary)


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"shear": ([1.5], [1.0])}, 'mode: "shear" is not allowed: must be "uniaxial", "equibiaxial" or "pure-shear"; did you mean "pure-shear"?'),
        ({"uniaxial": ([1.5, 2.0], [1.0])}, "uniaxial: needs as many stresses as stretches, not 1 and 2"),
        ({"uniaxial": ([1.5, -2.0], [1.0, 2.0])}, "uniaxial: stretches must be greater than 0, and all numbers finite"),
        ({"uniaxial": ([1.5, 2.0], [1.0, np.inf])}, "uniaxial: stretches must be greater than 0, and all numbers finite"),
        ({}, "there is no point in these data"),
    ],
)  # fmt: skip
def test_bad_arrays(tables: Any, message: str) -> None:
    with pytest.raises(FitError) as raised:
        Measurements.of(tables)
    assert str(raised.value) == message
