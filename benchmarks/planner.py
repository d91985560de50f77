"""What a neglected term is worth, estimated before the solve and found by solving both ways; and what the planner does.

Run on its own: ``python -m benchmarks.planner`` (two minutes); with ``docs`` it writes docs/planner.md.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from benchmarks.pages import tell, write
from benchmarks.planner_cases import CASES, Case
from embedding import explain
from problems import charged_balloon

PAGE = Path(__file__).parent.parent / "docs" / "planner.md"
ACCURACIES = (1e-2, 1e-3, 1e-4)
EXPLAINED = "<!-- explained -->"
"""Where the plan of the charged balloon stands on the page."""


def verdicts(case: Case, value: float, true: float) -> Iterator[str]:
    """What the planner does with the term at each of the accuracies: leaves it out or keeps it, and was that right."""
    for accuracy in ACCURACIES:
        if case.leaves_out is None:
            yield "kept"
            continue
        left_out = case.leaves_out(explain(case.scene(value, accuracy)))
        if left_out:
            yield "out" if true <= accuracy else "**out**"
        else:
            yield "kept" if true > accuracy else "kept (safe)"


def row(case: Case, value: float) -> str:
    """One row of the table, in Markdown."""
    true, estimated = case.true(value), case.estimated(value)
    known = estimated is not None
    number, ratio = (f"{estimated:.1e}", f"{estimated / true:.2g}") if known and estimated is not None else ("", "")
    what = f"{case.term} | {case.name}, {case.parameter} = {value:g}"
    return f"| {what} | {case.of} | {number} | {true:.1e} | {ratio} | {' | '.join(verdicts(case, value, true))} |"


def report() -> Iterator[str]:
    """The table, line by line."""
    yield f"| term | scene | answer | number | true | ratio | {' | '.join(f'{a:g}' for a in ACCURACIES)} |"
    yield "|---" * (6 + len(ACCURACIES)) + "|"
    for case in CASES:
        for value in case.values:
            yield row(case, value)


def main(arguments: list[str]) -> None:
    """Print the table; with "docs" also write the page's."""
    page = PAGE if arguments == ["docs"] else None
    tell(report(), page)
    if page is not None:
        plan = explain(charged_balloon.scene("accuracy=1e-2"))
        write(page, ["```text", *plan.text().splitlines(), "```"], EXPLAINED)


if __name__ == "__main__":
    main(sys.argv[1:])
