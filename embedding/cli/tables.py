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


def table_summary(table: Table) -> dict[str, Any]:
    """A table as plain data: columns, units and notes."""
    columns = {name: column.tolist() for name, column in table.columns.items()}
    return {"columns": columns, "units": table.units, "notes": table.notes}


def print_table(table: Table, leave_out: tuple[str, ...] = ()) -> None:
    """Print a table in SI units, without the columns to ``leave_out``.

    Errors stand behind their values; what is not known is a dash.
    """
    drawn = Drawn(box=None, padding=(0, 2, 0, 0), header_style="bold")
    errors = {name for name in table.columns if name.removesuffix("_error") in set(table.columns) - {name}}
    shown = [name for name in table.columns if name not in errors.union(leave_out)]
    for name in shown:
        text = table.columns[name].dtype.kind == "O"
        drawn.add_column(table.heading(name).replace("[", r"\["), justify="left" if text else "right")
    for row in range(len(table)):
        drawn.add_row(*(_cell(table, name, row, with_error=f"{name}_error" in errors) for name in shown))
    console().print(drawn)
    for note in table.notes:
        print(f"  {note}")


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
