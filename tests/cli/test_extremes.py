"""`embedding bench extremes` as people call it."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest

from embedding.bench import extremes as maps
from embedding.bench.extremes import FAILED, RIGHT, WRONG, Finding, cells_of
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]


@pytest.fixture
def pretend(monkeypatch: pytest.MonkeyPatch) -> list[Finding]:
    """Two cells of one family whose findings a test may change before it asks."""
    cells = cells_of("thickness")[:2]
    found = [
        Finding("thickness", cells[0].row, cells[0].value, RIGHT, error=1e-7),
        Finding("thickness", cells[1].row, cells[1].value, FAILED, "LIMIT_POINT", message="a limit point"),
    ]
    monkeypatch.setattr(maps, "cells_of", lambda *families: cells)
    monkeypatch.setattr(maps, "find", lambda cells, **options: iter(found))
    return found


def test_the_map(call: Call, pretend: list[Finding]) -> None:
    told = call("bench", "extremes", "thickness")
    assert told.code == 0
    assert "right 1e-07" in told.out and "failed LIMIT_POINT" in told.out
    assert "right 1: the error is within" in told.out
    assert told.out.rstrip().endswith("a limit point")


def test_a_wrong_cell_is_a_defect(call: Call, pretend: list[Finding]) -> None:
    pretend[0] = Finding("thickness", pretend[0].row, pretend[0].value, WRONG, error=0.5, message="it is off")
    told = call("bench", "extremes")
    assert told.code == 1 and "wrong 5e-01" in told.out


def test_as_json(call: Call, pretend: list[Finding]) -> None:
    told = json.loads(call("bench", "extremes", "--json").out)
    assert [cell["verdict"] for cell in told["cells"]] == [RIGHT, FAILED]


def test_mistakes(call: Call) -> None:
    told = call("bench", "extremes", "thicknes")
    assert told.code == 2 and "thicknes: no such family; there are thickness" in told.err
    assert call("bench", "extremes", "--workers", "0").code == 2
