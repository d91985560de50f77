"""Tables that are printed as they grow, and put on a page of the manual."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

TABLE, END = "<!-- table -->", "<!-- end -->"


def tell(lines: Iterable[str], page: Path | None = None, mark: str = TABLE) -> None:
    """Print each of the ``lines`` as it comes; with a ``page``, put them there behind ``mark`` as well."""
    kept = []
    for line in lines:
        kept.append(line)
        print(line, flush=True)
    if page is not None:
        write(page, kept, mark)


def write(page: Path, lines: Sequence[str], mark: str = TABLE) -> None:
    """Put ``lines`` on the ``page`` between ``mark`` and the end after it."""
    head, _, tail = _parted(page, mark)
    page.write_text("\n".join([head, "", *lines, "", tail]))


def merged(page: Path, lines: Sequence[str], mark: str = TABLE) -> list[str]:
    """The table on the ``page`` behind ``mark`` with those of its rows replaced whose first cells ``lines`` have, new
    rows in the order of their first cells; ``lines`` begin with the head of the table."""
    _, there, _ = _parted(page, mark)
    head, rows, new = list(lines[:2]), there.strip().splitlines()[2:], list(lines[2:])
    measured = {_first(row) for row in new}
    return head + sorted([row for row in rows if _first(row) not in measured] + new, key=_first)


def _first(row: str) -> str:
    return row.split("|")[1].strip()


def _parted(page: Path, mark: str) -> tuple[str, str, str]:
    """The page up to ``mark`` with it, what is behind it, and the rest from the end on."""
    text = page.read_text()
    start = text.index(mark) + len(mark)
    end = text.index(END, start)
    return text[:start], text[start:end], text[end:]
