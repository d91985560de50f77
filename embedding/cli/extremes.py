"""`embedding bench extremes`: the map of extremes as tables of words, and what those words mean."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from embedding.cli.files import UsageError
from embedding.cli.output import console, print_json

if TYPE_CHECKING:
    from embedding.bench.extremes import Cell, Finding

COLOURS = {"right": "green", "told": "yellow", "failed": "cyan", "refused": "blue", "wrong": "bold red"}
LEGEND = {
    "right": "the error is within the cell's tolerance",
    "told": "it is not, but the solution's error estimate says so, or a health check or an assumption names the cause",
    "failed": "the solve ended with a reason that is true, where it should",
    "refused": "the scene was not accepted, for a true reason",
    "wrong": "a wrong number without a word, an untrue reason, an exception, or no end",
}


def extremes(
    *families: Annotated[str, Parameter(help="Families of the map; default all.")],
    workers: Annotated[int, Parameter(help="Cells at once.")] = 1,
    threads: Annotated[int | None, Parameter(help="Threads of each solve; default what the scenes say.")] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative="", help="Print one JSON object.")] = False,
) -> int:
    """Push scenes to extremes and print a map of what holds: errors against closed forms, and reasons where it ends.

    Each cell has a process of its own. The exit code is 1 if a cell is wrong.
    """
    from embedding.bench.extremes import FAMILIES, cells_of, find

    unknown = [family for family in families if family not in FAMILIES]
    if unknown:
        raise UsageError(f"{', '.join(unknown)}: no such family; there are {', '.join(FAMILIES)}")
    for option, value in (("--workers", workers), ("--threads", threads)):
        if value is not None and value < 1:
            raise UsageError(f"{option}: {value} is not allowed: at least 1")
    cells = cells_of(*families)
    found = _watched(cells, find(cells, workers=workers, threads=threads))
    if as_json:
        print_json({"cells": [asdict(one) for one in found]})
    else:
        print_map(found)
    return 1 if any(one.verdict == "wrong" for one in found) else 0


def _watched(cells: Sequence[Cell], found: Iterable[Finding]) -> list[Finding]:
    """The findings in the order of the map, with a bar on standard error while they come."""
    from rich.console import Console
    from rich.progress import track

    screen = Console(stderr=True)
    coming = track(found, "extremes", len(cells), console=screen, disable=not screen.is_terminal, transient=True)
    by_place = {(one.family, one.row, one.value): one for one in coming}
    return [by_place[cell.family, cell.row, cell.value] for cell in cells]


def print_map(found: Sequence[Finding]) -> None:
    """Print a table for each family, the legend, and what was said in the cells that are not right."""
    from rich.table import Table

    out = console()
    for family in dict.fromkeys(one.family for one in found):
        rows, columns, cells = arranged([one for one in found if one.family == family])
        table = Table(title=family.replace("_", " "), title_justify="left")
        for head in ("", *columns):
            table.add_column(head)
        for row in rows:
            shown = [cells.get((row, column)) for column in columns]
            table.add_row(row, *("" if one is None else _coloured(one) for one in shown))
        out.print(table)
    counts = {word: sum(one.verdict == word for one in found) for word in LEGEND}
    for word, meaning in LEGEND.items():
        out.print(f"[{COLOURS[word]}]{word}[/] {counts[word]}: {meaning}", highlight=False)
    for one in found:
        if one.verdict != "right":
            out.print(f"\n{one.family}: {one.row}, {one.value}: {words_of(one)}", markup=False, highlight=False)
            out.print(f"  {one.message}", markup=False, highlight=False, soft_wrap=True)


def arranged(found: Sequence[Finding]) -> tuple[list[str], list[str], dict[tuple[str, str], Finding]]:
    """Rows, columns and cells of one family's table, in the order of the map."""
    rows = list(dict.fromkeys(one.row for one in found))
    columns = list(dict.fromkeys(one.value for one in found))
    return rows, columns, {(one.row, one.value): one for one in found}


def words_of(one: Finding) -> str:
    """A finding in a few words: its verdict, the error or the reason."""
    if one.verdict in ("right", "told"):
        return f"{one.verdict} {one.error:.0e}"
    error = f" {one.error:.0e}" if one.verdict == "wrong" and math.isfinite(one.error) else ""
    return f"{one.verdict}{error} {one.reason}".rstrip()


def _coloured(one: Finding) -> str:
    text = words_of(one).replace("[", r"\[")
    return text if "NO_COLOR" in os.environ else f"[{COLOURS[one.verdict]}]{text}[/]"
