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
    text = page.read_text()
    start = text.index(mark) + len(mark)
    end = text.index(END, start)
    page.write_text("\n".join([text[:start], "", *lines, "", text[end:]]))
