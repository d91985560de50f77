"""The table of a study in its forms, from an index that is written by hand."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pyarrow.parquet
import pytest

from embedding.studies import LatinHypercube, Study, StudyResult, open_study
from embedding.studies.files import StudyFolder
from embedding.studies.index import Index
from tests.studies.samples import PRESSURE, keys, study

THICKNESS = "shell.thickness"
GRID = {THICKNESS: ["0.2 mm", "0.4 mm"], PRESSURE: [500, "600 Pa", 700], "model.theory": ["auto"]}
UNITS = {
    THICKNESS: "m",
    PRESSURE: "Pa",
    "stretch": "1",
    "largest": "1",
    "reached": "Pa",
    "iterations": "1",
    "seconds": "s",
    "estimated_error": "1",
}


def told(stated: Study, folder: Path) -> StudyResult:
    """The result of a study whose second case was killed, the stretches of the others counting up."""
    StudyFolder(folder).prepare(stated)
    with Index(folder / "index.jsonl") as index:
        for number, key in enumerate(keys(stated)):
            scalars = {"stretch": 1.0 + number, "stretch_max": 2.0 + number, "pressure_difference": 1.0}
            record: dict[str, Any] = {"status": "done", "reason": "", "states": {"last": scalars, "max": scalars}}
            if number == 1:
                record = {"status": "killed", "reason": "by a hand", "states": {}}
            index.append({"case": key, "seconds": 2.0, "estimated_error": None, **record})
    return open_study(folder)


def test_table(tmp_path: Path) -> None:
    table = told(study(GRID), tmp_path).table()
    assert list(table[THICKNESS]) == [2e-4] * 3 + [4e-4] * 3
    assert list(table[PRESSURE]) == [500.0, 600.0, 700.0] * 2
    assert set(table["model.theory"]) == {"auto"}
    assert list(table["status"]) == ["done", "killed", *["done"] * 4]
    assert table["reason"][1] == "by a hand"
    np.testing.assert_array_equal(table["stretch"], [1, math.nan, 3, 4, 5, 6])
    assert table.attrs["units"] == UNITS


def test_dataset_of_a_grid(tmp_path: Path) -> None:
    dataset = told(study(GRID), tmp_path).dataset()
    assert dict(dataset.sizes) == {THICKNESS: 2, PRESSURE: 3, "model.theory": 1}
    assert float(dataset["stretch"].sel({THICKNESS: 4e-4, PRESSURE: 600.0}).item()) == 5.0
    assert dataset["status"].sel({THICKNESS: 2e-4, PRESSURE: 600.0}).item() == "killed"
    assert dataset["reached"].dtype == float
    assert {name: dataset[name].attrs["units"] for name in UNITS} == UNITS


def test_dataset_of_parameters_that_go_together(tmp_path: Path) -> None:
    """One dimension, named by the first of the group, with a coordinate for each."""
    design = {"kind": "grid", "together": [[PRESSURE, "path.0.steps"]]}
    values = {THICKNESS: ["0.2 mm", "0.4 mm"], PRESSURE: [500, 600, 700], "path.0.steps": [1, 2, 3]}
    dataset = told(study(values, design=design), tmp_path).dataset()
    assert dict(dataset.sizes) == {THICKNESS: 2, PRESSURE: 3}
    assert dataset["path.0.steps"].dims == (PRESSURE,)
    assert float(dataset["stretch"].sel({THICKNESS: 4e-4, PRESSURE: 700.0}).item()) == 6.0


def test_dataset_of_samples(tmp_path: Path) -> None:
    bounds = {THICKNESS: {"low": "0.2 mm", "high": "0.4 mm"}}
    result = told(study(bounds, design=LatinHypercube(samples=4)), tmp_path)
    dataset = result.dataset()
    assert dict(dataset.sizes) == {"number": 4}
    assert dataset.coords[THICKNESS].values.tolist() == result.table()[THICKNESS].tolist()
    assert dataset[THICKNESS].attrs["units"] == "m"


def test_csv(tmp_path: Path) -> None:
    result = told(study(GRID), tmp_path / "study")
    result.to_csv(tmp_path / "table.csv")
    read = pandas.read_csv(tmp_path / "table.csv", keep_default_na=True)
    assert [name for name in read if "[" in name] == [
        "shell.thickness [m]", "loads.pressure_bottom [Pa]", "reached [Pa]", "seconds [s]",
    ]  # fmt: skip
    np.testing.assert_array_equal(read["stretch"], result.table()["stretch"])
    np.testing.assert_array_equal(read["shell.thickness [m]"], result.table()[THICKNESS])


def test_parquet(tmp_path: Path) -> None:
    result = told(study(GRID), tmp_path / "study")
    result.to_parquet(tmp_path / "table.parquet")
    schema = pyarrow.parquet.read_schema(tmp_path / "table.parquet")
    assert {name: schema.field(name).metadata[b"unit"].decode() for name in UNITS} == UNITS
    read = pandas.read_parquet(tmp_path / "table.parquet")
    pandas.testing.assert_frame_equal(read, result.table())


@pytest.mark.parametrize("kind", ["grid", "rows"])
def test_the_same_case_twice_is_two_rows(tmp_path: Path, kind: str) -> None:
    rows = told(study({PRESSURE: [500, 600, "500 Pa"]}, design={"kind": kind}), tmp_path).rows
    assert rows[0].case == rows[2].case
    assert rows[0].quantities == rows[2].quantities
