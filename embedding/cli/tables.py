"""What the commands on archives print of a table: for people, as JSON, as CSV."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.table import Table as Drawn

from embedding.cli.files import whole_file
from embedding.cli.output import console, number

if TYPE_CHECKING:
    from embedding.post import Table


KEYS = ("step", "point")
"""Columns that name a row."""


def table_summary(table: Table) -> dict[str, Any]:
    """A table as plain data: columns, units and notes."""
    columns = {name: column.tolist() for name, column in table.columns.items()}
    return {"columns": columns, "units": table.units, "notes": table.notes}


def print_table(table: Table, leave_out: tuple[str, ...] = ()) -> None:
    """Print a table in SI units, without the columns to ``leave_out``.

    Errors stand behind their values; what is not known is a dash. A table that is too wide comes in several parts, each
    with the columns that name its rows, as no number is cut short.
    """
    errors = {name for name in table.columns if name.removesuffix("_error") in set(table.columns) - {name}}
    shown = [name for name in table.columns if name not in errors.union(leave_out)]
    cells = {
        name: [_cell(table, name, row, with_error=f"{name}_error" in errors) for row in range(len(table))]
        for name in shown
    }
    screen = console()
    for place, part in enumerate(_parts(table, cells, screen.width)):
        if place:
            print()
        drawn = Drawn(box=None, padding=(0, 2, 0, 0), header_style="bold")
        for name in part:
            text = table.columns[name].dtype.kind == "O"
            heading = table.heading(name).replace("[", r"\[")
            drawn.add_column(heading, justify="left" if text else "right", no_wrap=not text)
        for row in range(len(table)):
            drawn.add_row(*(cells[name][row] for name in part))
        screen.print(drawn)
    for note in table.notes:
        print(f"  {note}")


def _parts(table: Table, cells: dict[str, list[str]], width: int) -> list[list[str]]:
    """The columns, in as many parts as it takes for each to be no wider than ``width``."""
    needed = {
        name: 2 + max([len(table.heading(name)), *(len(cell) for cell in column)]) for name, column in cells.items()
    }
    keys = [name for name in cells if name in KEYS]
    parts, room = [list(keys)], width - sum(needed[name] for name in keys)
    left = room
    for name in (name for name in cells if name not in keys):
        if needed[name] > left and len(parts[-1]) > len(keys):
            parts, left = [*parts, list(keys)], room
        parts[-1].append(name)
        left -= needed[name]
    return parts


def save_csv(table: Table, path: Path | None) -> None:
    """Write a table into a CSV file, if one is wanted."""
    if path is not None:
        with whole_file(path) as file:
            table.to_csv(file)


def _cell(table: Table, name: str, row: int, *, with_error: bool) -> str:
    value = table.columns[name][row]
    if isinstance(value, str):
        return value.replace("[", r"\[")
    if not isinstance(value, float):
        return str(value)
    if not math.isfinite(value):
        return "-"
    error = float(table.columns[f"{name}_error"][row]) if with_error else math.nan
    return f"{number(value)} ± {error:.1g}" if math.isfinite(error) else number(value)
