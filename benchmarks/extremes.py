"""The map of extremes, ``embedding bench extremes``, on the page docs/extremes.md.

``python -m benchmarks.extremes [docs] [FAMILY ...]`` prints it; with ``docs`` it goes onto the page as well.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.pages import tell
from embedding.bench.extremes import RIGHT, Finding, cells_of, find
from embedding.cli.extremes import arranged, words_of

PAGE = Path(__file__).parents[1] / "docs" / "extremes.md"


def tables(found: Sequence[Finding]) -> Iterator[str]:
    """Each family as a table; rows and columns change places where there are many columns."""
    for family in dict.fromkeys(one.family for one in found):
        rows, columns, cells = arranged([one for one in found if one.family == family])
        yield from ("", f"### {family.capitalize()}", "")
        yield "| | " + " | ".join(columns) + " |"
        yield "|" + "---|" * (len(columns) + 1)
        for row in rows:
            shown = [cells.get((row, column)) for column in columns]
            yield f"| {row} | " + " | ".join("" if one is None else words_of(one) for one in shown) + " |"


def messages(found: Sequence[Finding]) -> Iterator[str]:
    """What a user reads in each cell that is not right."""
    for one in found:
        if one.verdict != RIGHT:
            text = " ".join(one.message.split())
            yield f"* *{one.family}: {one.row}, {one.value}* ({words_of(one)}): {text}"


if __name__ == "__main__":
    page = PAGE if "docs" in sys.argv[1:] else None
    cells = cells_of(*(name for name in sys.argv[1:] if name != "docs"))
    by_place = {(one.family, one.row, one.value): one for one in find(cells)}
    everything = [by_place[cell.family, cell.row, cell.value] for cell in cells]
    tell(tables(everything), page, "<!-- map -->")
    tell(messages(everything), page, "<!-- messages -->")
