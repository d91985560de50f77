"""What `embedding study` and `embedding table` tell about a study: as plain data, and as a table for people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.table import Table

from embedding.cli.output import console, number

if TYPE_CHECKING:
    from embedding.studies import Row, StudyResult

DONE = "done"


def study_summary(result: StudyResult) -> dict[str, Any]:
    """A study as plain data: how many cases ended how, every row, and the units of the columns."""
    return {
        "study": result.study.name,
        "folder": result.folder,
        "counts": result.counts(),
        "rows": [asdict(row) for row in result.rows],
        "units": result.units,
    }


def print_study(result: StudyResult) -> None:
    """Print how a study ended: counts, the cases that are not done with their reasons, and where everything is."""
    counts = ", ".join(f"{count} {status}" for status, count in result.counts().items())
    print(f"{result.study.name}: {len(result.rows)} cases, {counts}")
    _print_reasons(result.rows)
    print(f"  {result.folder}")


def print_table(result: StudyResult) -> None:
    """Print a study as a table, one row a case, in SI units."""
    columns, units = result.columns(), result.units
    shown = [*result.study.parameters, *result.study.quantities, "status"]
    table = Table(box=None, padding=(0, 2, 0, 0), header_style="bold")
    for heading in ("case", *shown):
        unit = units.get(heading, "1")
        text = heading if unit == "1" else f"{heading} [{unit}]"
        table.add_column(text.replace("[", r"\["), justify="left" if heading == "status" else "right")
    for row in range(len(result.rows)):
        table.add_row(str(row + 1), *(_cell(columns[name][row]) for name in shown))
    console().print(table)
    _print_reasons(result.rows)


def draw_study(result: StudyResult, path: Path, of: str, over: Sequence[str], family: str | None) -> None:
    """Draw a column over another one, a line for each value of ``family``; over two others, a map.

    Raises:
        StudyError: a column does not exist, or has no numbers; or matplotlib is missing.
    """
    from embedding.studies.charts import Axis, contours, lines, save

    axes = [Axis(name) for name in (*over, of)]
    if len(over) == 2:
        figure = contours(result, *axes)
    else:
        figure = lines(result, *axes, family=None if family is None else Axis(family))
    save(figure, path, "png")


def _print_reasons(rows: Sequence[Row]) -> None:
    for place, row in enumerate(rows, start=1):
        if row.status != DONE:
            print(f"  case {place}: {row.status}: {row.reason}")


def _cell(value: float | str) -> str:
    return value.replace("[", r"\[") if isinstance(value, str) else number(value)
