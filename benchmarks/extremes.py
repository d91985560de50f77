"""The map of extremes, ``embedding bench extremes``, on the page docs/extremes.md.

``python -m benchmarks.extremes [docs] [FAMILY ...]`` prints it; with ``docs`` each of the families goes onto the page.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.pages import END, tell
from embedding.bench.extremes import FAMILIES, RIGHT, Finding, cells_of, find
from embedding.cli.extremes import arranged, words_of

PAGE = Path(__file__).parents[1] / "docs" / "extremes.md"
MOST = 8
"""Columns of a table; where there are more, they change places with the rows."""


def section(found: Sequence[Finding]) -> Iterator[str]:
    """A family as a table, and what a user reads in each cell that is not right."""
    rows, columns, cells = arranged(found)
    words = {place: words_of(one) for place, one in cells.items()}
    if len(columns) > MOST:
        rows, columns, words = columns, rows, {(column, row): told for (row, column), told in words.items()}
    yield "| | " + " | ".join(columns) + " |"
    yield "|" + "---|" * (len(columns) + 1)
    for row in rows:
        yield f"| {row} | " + " | ".join(words.get((row, column), "") for column in columns) + " |"
    yield ""
    for one in found:
        if one.verdict != RIGHT:
            yield f"* *{one.row}, {one.value}* ({words_of(one)}): {' '.join(one.message.split())}"


def marked(family: str) -> str:
    """The marker of a family on the page, which is given a section for it if it has none."""
    mark, text = f"<!-- {family} -->", PAGE.read_text()
    if mark not in text:
        title = family.replace("_", " ").capitalize()
        PAGE.write_text(f"{text.rstrip()}\n\n## {title}\n\n{mark}\n{END}\n")
    return mark


if __name__ == "__main__":
    page = PAGE if "docs" in sys.argv[1:] else None
    for family in [name for name in sys.argv[1:] if name != "docs"] or FAMILIES:
        cells = cells_of(family)
        by_place = {(one.row, one.value): one for one in find(cells)}
        mark = marked(family) if page else ""
        tell(section([by_place[cell.row, cell.value] for cell in cells]), page, mark)
