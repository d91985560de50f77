"""No cell of the map of extremes is wrong, and each has the verdict that it is held to."""

from __future__ import annotations

import pytest

from embedding.bench.extremes import WRONG, Cell, cells_of, judge
from embedding.bench.extremes.cell import nothing

CELLS = [pytest.param(cell, id=cell.name, marks=[pytest.mark.slow] if cell.slow else []) for cell in cells_of()]


@pytest.mark.parametrize("cell", CELLS)
def test_cell(cell: Cell) -> None:
    found = judge(cell)
    assert found.verdict != WRONG, f"{found.reason} {found.error:.1e}: {found.message}"
    assert found.verdict == cell.expected, f"{found.reason} {found.error:.1e}: {found.message}"


def test_cells_have_names_of_their_own_and_sources() -> None:
    cells = cells_of()
    assert len({cell.name for cell in cells}) == len(cells)
    assert not [cell.name for cell in cells if cell.reference is not nothing and not cell.source]
