"""Columns with units: NumPy arrays, a pandas table, a CSV file."""

from __future__ import annotations

import csv
import importlib.util
import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from embedding.errors import EmbeddingError

if TYPE_CHECKING:
    import pandas


class PostError(EmbeddingError):
    """A question that an archive cannot answer; the message says why, and what there is instead."""

    exit_code: ClassVar[int] = 2


@dataclass(frozen=True)
class Table:
    """Named columns of equal length, with the SI ``units`` of those that have one, and ``notes`` for the reader.

    ``table["phi"]`` is a NumPy array. Raises PostError for a column that there is not, listing those there are.
    """

    columns: dict[str, npt.NDArray[Any]]
    units: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        if name not in self.columns:
            raise PostError(f"no column {name!r}; there are {', '.join(self.columns)}")
        return self.columns[name]

    def heading(self, name: str) -> str:
        """Name and unit of a column: "phi [V]"."""
        unit = self.units.get(name, "1")
        return name if unit in ("", "1") else f"{name} [{unit}]"

    def rows(self) -> Iterator[tuple[Any, ...]]:
        """The rows, as Python values."""
        return zip(*(column.tolist() for column in self.columns.values()), strict=True)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas table; ``table.attrs["units"]`` holds the units by column.

        Raises:
            PostError: pandas is missing.
        """
        if importlib.util.find_spec("pandas") is None:
            raise PostError("tables need pandas: pip install 'embedding[studies]'")
        import pandas

        table = pandas.DataFrame({name: list(column) for name, column in self.columns.items()})
        table.attrs["units"] = dict(self.units)
        return table

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write a CSV file whose first line has names and units, numbers in full; returns its path."""
        with Path(path).open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow([self.heading(name) for name in self.columns])
            for row in self.rows():
                writer.writerow(["" if value != value else value for value in row])
        return Path(path)


def stacked(tables: list[Table]) -> Table:
    """Tables of the same columns one below the other; a number that one of them lacks is nan there, a text empty."""
    names = list(dict.fromkeys(name for table in tables for name in table.columns))
    columns = {name: np.concatenate([_column(name, table, tables) for table in tables]) for name in names}
    units = {name: unit for table in tables for name, unit in table.units.items()}
    return Table(columns, units, tuple(dict.fromkeys(note for table in tables for note in table.notes)))


def _column(name: str, table: Table, tables: list[Table]) -> npt.NDArray[Any]:
    if name in table.columns:
        return table.columns[name]
    kind = next(other.columns[name] for other in tables if name in other.columns).dtype
    return np.full(len(table), np.nan if kind.kind == "f" else "", dtype=kind if kind.kind == "f" else object)
