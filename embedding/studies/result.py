"""The result of a study: a row for every case, as a pandas table, an xarray dataset, CSV or Parquet, with units."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from embedding.archive.units import scalar_unit
from embedding.studies.cases import Case, cases_of
from embedding.studies.errors import require
from embedding.studies.files import StudyFolder
from embedding.studies.index import read_index
from embedding.studies.parameters import number_at
from embedding.studies.record import DONE, MISSING, REFUSED, failure, states_in
from embedding.studies.study import Grid, Study

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class Row:
    """One case: its hash, parameters and quantities in SI units, and how it ended.

    ``status`` is "done", "diverged", "refused", "raised", "killed", "over time" or "missing"; ``reason`` says more.
    Quantities that a case does not have are nan. ``start`` is "rest", "neighbour", "rest: ..." with the reason why it
    was not its neighbour's state, or "resumed" from an earlier attempt; ``iterations`` are Newton's. ``changes`` are
    what ``embedding run --set`` takes.
    """

    case: str
    parameters: dict[str, float | str]
    quantities: dict[str, float]
    status: str
    reason: str
    start: str
    iterations: float
    seconds: float
    estimated_error: float
    changes: tuple[str, ...]


@dataclass(frozen=True)
class StudyResult:
    """The rows of a study in the order of its design; ``units`` are those of all columns that have one."""

    study: Study
    rows: tuple[Row, ...]
    units: dict[str, str]
    folder: Path

    def counts(self) -> dict[str, int]:
        """How many cases ended how."""
        return dict(Counter(row.status for row in self.rows))

    @property
    def quantities(self) -> tuple[str, ...]:
        """The names of the quantities of every row: those of the study and those added."""
        return tuple(self.rows[0].quantities) if self.rows else tuple(self.study.quantities)

    def with_quantity(self, name: str, values: Sequence[float], unit: str = "1") -> StudyResult:
        """The same result with one number more in every row, in SI units: what was computed from rows or archives.

        Raises:
            ValueError: there are more or fewer values than rows, or a column of that name exists.
        """
        if name in self.columns():
            raise ValueError(f"there is a column {name} already")
        rows = tuple(
            replace(row, quantities={**row.quantities, name: float(value)})
            for row, value in zip(self.rows, values, strict=True)
        )
        return replace(self, rows=rows, units={**self.units, name: unit})

    def archive(self, number: int) -> Path:
        """The archive of a row; it need not exist if the case failed before its first step."""
        return StudyFolder(self.folder).case(self.rows[number].case).archive

    def columns(self) -> dict[str, list[Any]]:
        """The table by columns: hash, parameters, quantities, and how each case ended."""
        rows = self.rows
        return {
            "case": [row.case for row in rows],
            **{name: [row.parameters[name] for row in rows] for name in self.study.parameters},
            **{name: [row.quantities[name] for row in rows] for name in self.quantities},
            "status": [row.status for row in rows],
            "reason": [row.reason for row in rows],
            "start": [row.start for row in rows],
            "iterations": [row.iterations for row in rows],
            "seconds": [row.seconds for row in rows],
            "estimated_error": [row.estimated_error for row in rows],
        }

    def table(self) -> pandas.DataFrame:
        """A pandas table, one row a case; ``table.attrs["units"]`` holds the units by column.

        Raises:
            StudyError: pandas is missing.
        """
        require("pandas")
        import pandas

        table = pandas.DataFrame(self.columns())
        table.attrs["units"] = dict(self.units)
        return table

    def dataset(self) -> xarray.Dataset:
        """An xarray dataset: over the parameters of a grid, else over the number of the case. Units are attributes.

        Raises:
            StudyError: xarray is missing.
        """
        require("xarray")
        import numpy as np
        import xarray

        columns: dict[str, Any] = {name: np.array(values, _dtype(values)) for name, values in self.columns().items()}
        grid = isinstance(self.study.design, Grid)
        axes = self.study.axes if grid else (("number", *self.study.parameters),)
        dimensions = tuple(axis[0] for axis in axes)
        shape = tuple(len(self.study.parameters[axis[0]]) for axis in axes) if grid else (len(self.rows),)
        columns |= {} if grid else {"number": np.arange(len(self.rows))}
        coordinates: dict[str, Any] = {}
        for number, axis in enumerate(axes):
            first = tuple(slice(None) if number == other else 0 for other in range(len(shape)))
            coordinates |= {name: (axis[0], columns.pop(name).reshape(shape)[first]) for name in axis}
        data = {name: (dimensions, values.reshape(shape)) for name, values in columns.items()}
        dataset = xarray.Dataset(data, coordinates, {"study": self.study.name, "scene": self.study.scene.to_toml()})
        for name, unit in self.units.items():
            dataset[name].attrs["units"] = unit
        return dataset

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the table as CSV; a heading holds its unit: ``shell.thickness [m]``.

        Raises:
            StudyError: pandas is missing.
        """
        headings = {name: f"{name} [{unit}]" for name, unit in self.units.items() if unit != "1"}
        self.table().rename(columns=headings).to_csv(path, index=False)

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write the table as Parquet; the unit of a column is its metadata ``unit``.

        Raises:
            StudyError: pandas or pyarrow is missing.
        """
        require("pandas", "pyarrow")
        import pyarrow
        import pyarrow.parquet

        table = pyarrow.Table.from_pandas(self.table(), preserve_index=False)
        fields = [
            field.with_metadata({"unit": self.units[field.name]}) if field.name in self.units else field
            for field in table.schema
        ]
        schema = pyarrow.schema(fields, table.schema.metadata)
        pyarrow.parquet.write_table(table.cast(schema), os.fspath(path))


def open_study(folder: str | os.PathLike[str]) -> StudyResult:
    """The result that a study has so far, from its folder.

    Raises:
        StudyError: not the folder of a study, or its index is damaged.
    """
    home = StudyFolder(Path(folder).resolve())
    study = home.study()
    return result_of(study, cases_of(study), read_index(home.index), home.path)


def result_of(
    study: Study, cases: Sequence[Case], records: Mapping[str, Mapping[str, Any]], folder: Path
) -> StudyResult:
    """The result from the cases of a study and the records there are."""
    rows = []
    for case in cases:
        if case.scene is None:
            record: Mapping[str, Any] = failure(REFUSED, case.refusal)
        else:
            record = records.get(case.key, failure(MISSING, "not solved yet"))
        rows.append(_row(study, case, record))
    return StudyResult(study, tuple(rows), _units(study, cases), folder)


def _row(study: Study, case: Case, record: Mapping[str, Any]) -> Row:
    states, done = states_in(record), record["status"] == DONE
    quantities = {name: quantity.value(states, done) for name, quantity in study.wanted.items()}
    return Row(
        case.key,
        case.values,
        quantities,
        record["status"],
        record["reason"],
        record.get("start", ""),
        _number(record.get("iterations")),
        _number(record.get("seconds")),
        _number(record.get("estimated_error")),
        case.changes,
    )


def _number(value: float | None) -> float:
    """Null is nan."""
    return math.nan if value is None else float(value)


def _units(study: Study, cases: Sequence[Case]) -> dict[str, str]:
    """SI units of all columns that hold numbers."""
    scene = next((case.scene for case in cases if case.scene is not None), study.scene)
    per_length = scene.shell.shape.reductions == ("plane-strain",)
    units = {}
    for name in study.parameters:
        if all(isinstance(case.values[name], float) for case in cases):
            number = number_at(scene, name)
            units[name] = number.unit or "1" if number else "1"
    units |= {name: scalar_unit(quantity.scalar, per_length) for name, quantity in study.wanted.items()}
    return units | {"iterations": "1", "seconds": "s", "estimated_error": "1"}


def _dtype(values: Sequence[Any]) -> type:
    return float if all(isinstance(value, float) for value in values) else object
