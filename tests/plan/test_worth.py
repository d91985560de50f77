"""What a neglected term is worth: the planner's estimate against the truth, and its choice on both sides of it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from benchmarks.planner import PAGE
from benchmarks.planner_cases import CASES, Case
from embedding import explain
from embedding.plan.allowance import SAFE
from embedding.scene.accuracy import COARSEST

pytestmark = pytest.mark.usefixtures("unestimated")

WILD = 10.0
"""An estimate larger than the truth by more than that would keep terms for nothing."""
NAMES = [f"{case.term}: {case.name}" for case in CASES]


def check(case: Case, value: float) -> None:
    true, number = case.true(value), case.estimated(value)
    assert number is not None
    # What is left out is within the accuracy although numbers are estimates: they may fall short by the safe part.
    assert true < number / SAFE
    assert number < WILD * true
    if case.leaves_out is None:
        return
    coarse = 1.1 * number / SAFE
    if coarse < COARSEST:
        assert case.leaves_out(explain(case.scene(value, coarse)))  # the cheap model, and it is good enough
    assert not case.leaves_out(explain(case.scene(value, 0.9 * true)))  # the dear one, and it is needed


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_both_directions(case: Case) -> None:
    check(case, case.values[1])


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_both_directions_near_and_far(case: Case) -> None:
    check(case, case.values[0])
    check(case, case.values[2])


@pytest.mark.parametrize("case", CASES, ids=NAMES)
def test_the_page_shows_these_numbers(case: Case) -> None:
    """And that nothing was left out that mattered: the page has the truth, found by solving both ways."""
    rows = [line for line in Path(PAGE).read_text().splitlines() if line.startswith(f"| {case.term} | {case.name}, ")]
    assert len(rows) == len(case.values)
    for value, line in zip(case.values, rows, strict=True):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        assert cells[1].endswith(f"{case.parameter} = {value:g}")
        assert cells[3] == f"{case.estimated(value):.1e}"
        assert 1 / WILD < float(cells[4]) / float(cells[3]) < 1 / SAFE
        assert not re.search(r"\*\*out\*\*", line)
