"""The verdicts themselves, on cells made up to deserve each of them."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import pytest

from embedding import Scene
from embedding.bench.extremes import FAILED, REFUSED, RIGHT, TOLD, WRONG, Cell, cells_of, judge, running
from tests.balloons import SMALLEST

PUSHED = "column, pushed aside", "0.9999 of Euler's load"
BLOWN_UP = SMALLEST.replace("500 Pa", "5 kPa").replace("steps = 1", 'control = "load"\nsteps = 1')


def small(text: str = SMALLEST) -> Scene:
    return Scene.from_toml(text)


PLAIN = Cell("made up", "balloon", "0", small, source="itself")


def known(name: str, factor: float = 1.0) -> Cell:
    """The balloon, its reference the answer itself times a factor."""
    from embedding import solve

    value = float(solve(small())[name][-1])
    return replace(PLAIN, reference=lambda: {name: factor * value})


def test_right_and_wrong() -> None:
    assert judge(known("stretch")).verdict == RIGHT
    off = judge(known("stretch", 1.01))
    assert (off.verdict, off.error) == (WRONG, pytest.approx(0.01 / 1.01, rel=1e-6))
    assert off.message.startswith("stretch is 1.0")


def test_told() -> None:
    """Off by less than what the solution states."""
    cell = known("stretch")
    stated = judge(cell).stated
    off = judge(replace(known("stretch", 1 + stated), tolerance=0.1 * stated))
    assert (off.verdict, off.reason) == (TOLD, "error estimate")


def stating(error: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every solve states this relative error of the stretch from now on."""
    from embedding import api

    solution = api.solve(small())
    stated = replace(solution.errors["stretch"], value=error)
    monkeypatch.setattr(api, "solve", lambda *_, **__: replace(solution, errors={"stretch": stated}))


@pytest.mark.parametrize(("factor", "verdict"), [(2.9, TOLD), (3.1, WRONG), (-0.9, TOLD), (-1.1, WRONG)])
def test_that_all_is_uncertain_tells_of_twice_the_answer(
    factor: float, verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    cell = known("stretch", factor)
    stating(1.0, monkeypatch)
    assert judge(cell).verdict == verdict


def test_what_is_stated_of_another_number_tells_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    cell = known("displacement", 1.01)
    stating(1.0, monkeypatch)
    assert judge(cell).verdict == WRONG


def test_a_warning_tells_only_of_what_it_causes() -> None:
    """Near its limit point the column is in red, and that is why it is off."""
    (cell,) = (one for one in cells_of("limit_points") if (one.row, one.value) == PUSHED)
    told = judge(cell)
    assert (told.verdict, told.reason) == (TOLD, "limit point")
    assert judge(replace(cell, warnings=())).verdict == WRONG
    assert judge(replace(cell, warnings=("condition",))).verdict == WRONG


def test_the_column_is_off_by_its_strain() -> None:
    """With its compression by P / EA, which shortens the length that buckles, it is off ten times less (C. Magnusson,
    M. Ristinmaa, C. Ljung, Int. J. Solids Struct. 38 (2001) 8441)."""
    (cell,) = (one for one in cells_of("limit_points") if (one.row, one.value) == PUSHED)
    near, ratio = 0.9999, 1e-3
    shortened = 1.0 - near * math.pi**2 * ratio**2 / 48.0
    k = 0.5 * math.pi * math.sqrt(near * shortened)
    tip = shortened * 1e-8 / near * (math.tan(k) / k - 1.0)
    found = judge(replace(cell, reference=lambda: {"u_tip_y": tip}, tolerance=2e-4))
    assert found.verdict == RIGHT
    assert found.error < 0.1 * judge(cell).error


def test_failures_need_a_true_reason_at_the_right_place() -> None:
    cell = replace(PLAIN, scene=lambda: small(BLOWN_UP))
    assert judge(cell).verdict == WRONG
    true = replace(cell, reasons=frozenset({"LIMIT_POINT"}), expected=FAILED)
    found = judge(true)
    assert (found.verdict, found.reason) == (FAILED, "LIMIT_POINT") and "limit point" in found.message
    elsewhere = replace(true, reference=lambda: {"stretch": 2.0})
    assert judge(elsewhere).verdict == WRONG


def test_refusals_name_the_field() -> None:
    refused = replace(PLAIN, scene=lambda: small(SMALLEST.replace('"0.2 mm"', '"-1 mm"')))
    assert judge(refused).verdict == WRONG
    assert judge(replace(refused, fields=("loads",))).verdict == WRONG
    found = judge(replace(refused, fields=("shell.thickness",)))
    assert (found.verdict, found.reason) == (REFUSED, "shell.thickness")


def test_exceptions_are_wrong() -> None:
    def broken() -> Scene:
        raise ZeroDivisionError("planted")

    found = judge(replace(PLAIN, scene=broken))
    assert (found.verdict, found.reason, found.message) == (WRONG, "ZeroDivisionError", "planted")


def test_processes_of_their_own() -> None:
    """Two cells, each judged in a process, one of which is not given the time."""
    done, late = cells_of("thickness")[2], replace(cells_of("thickness")[3], seconds=0.01)
    begun = time.perf_counter()
    found = {one.value: one for one in running.find([done, late])}
    assert found[done.value].verdict == RIGHT
    assert (found[late.value].verdict, found[late.value].message) == (WRONG, "not done after 0.01 s")
    assert time.perf_counter() - begun < 60
