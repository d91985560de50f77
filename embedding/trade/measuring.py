"""Solving all rungs of a scene, one after the other, each in a process of its own that has the machine to itself."""

from __future__ import annotations

import csv
import math
import os
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from embedding.archive.units import scalar_unit
from embedding.errors import SceneError
from embedding.scene import Scene
from embedding.scene.messages import nearest
from embedding.scene.overrides import apply_overrides
from embedding.studies.cases import Case, hash_of
from embedding.studies.display import StudyDisplay
from embedding.studies.errors import StudyError
from embedding.studies.files import StudyFolder, read_json, write_case
from embedding.studies.pool import LocalPool, Record
from embedding.studies.record import DONE, REFUSED, states_in
from embedding.trade.ladder import FINEST, PLANNED, Rung, ladder
from embedding.trade.rows import Row, cheapest, front

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-6)


@dataclass(frozen=True)
class Trade:
    """What was measured of ``scene``: the ``quantity`` at the end of its path on every rung, against ``reference`` in
    its SI ``unit``, which is the answer of the finest rung unless one was ``stated``."""

    scene: Scene
    quantity: str
    unit: str
    reference: float
    stated: bool
    rows: tuple[Row, ...]

    @property
    def front(self) -> tuple[Row, ...]:
        """The rungs that no other beats in time and error at once, the cheapest first."""
        return front(self.rows)

    def cost(self, row: Row) -> float:
        """CPU time of a rung over that of the plan."""
        (planned,) = (one for one in self.rows if one.rung == PLANNED)
        return row.cpu_seconds / planned.cpu_seconds

    def best(self) -> dict[float, Row | None]:
        """The cheapest rung at each of the ``TOLERANCES``."""
        return {tolerance: cheapest(self.rows, tolerance) for tolerance in TOLERANCES}

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """All rungs as a table, errors relative, everything else in SI units."""
        names = [field.name for field in fields(Row)]
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(names)
            for row in self.rows:
                writer.writerow([" ".join(row.changes) if name == "changes" else getattr(row, name) for name in names])


def measure_trade(
    scene: Scene,
    folder: str | os.PathLike[str],
    *,
    quantity: str | None = None,
    reference: float | None = None,
    seconds: float | None = 600.0,
    progress: bool = False,
) -> Trade:
    """Solve ``scene`` on every rung of its ladder, each for at most ``seconds``, and compare.

    ``quantity`` is a scalar of the last step, by default the one whose error the planned solve estimates; ``reference``
    its exact value in SI units, by default the answer of the finest rung. Rungs that ``folder`` has already are not
    solved again. A script that calls this needs the guard ``if __name__ == "__main__":``.

    Raises:
        StudyError: a package of the extra ``studies`` is missing, the planned or the finest rung has no answer, or the
            scene has no such quantity.
    """
    rungs, home = ladder(scene), StudyFolder(Path(folder).resolve())
    records = _records(scene, rungs, home, seconds, progress)
    planned = records[next(i for i, rung in enumerate(rungs) if rung.name == PLANNED)]
    name = _quantity(planned, quantity)
    rows = [_row(rung, record, name) for rung, record in zip(rungs, records, strict=True)]
    (finest,) = (row for row in rows if row.rung == FINEST)
    exact = finest.value if reference is None else reference
    if not math.isfinite(exact) or exact == 0.0:
        raise StudyError(f"the finest rung has no {name} to compare with ({finest.status}: {finest.reason})")
    compared = [replace(row, error=abs(row.value / exact - 1.0)) for row in rows]
    if reference is None:  # it cannot tell its own error
        compared = [replace(row, error=math.nan) if row.rung == FINEST else row for row in compared]
    unit = scalar_unit(name, scene.shell.shape.kind in ("strip", "arch", "infinite-cylinder"))
    return Trade(scene, name, unit, exact, reference is not None, tuple(compared))


def _records(
    scene: Scene, rungs: Sequence[Rung], home: StudyFolder, seconds: float | None, progress: bool
) -> list[Record]:
    """How each rung ended."""
    cases = [_case(number, scene, rung) for number, rung in enumerate(rungs)]
    found: dict[int, Record] = {
        case.number: {"status": REFUSED, "reason": case.refusal, "states": {}} for case in cases if case.scene is None
    }
    for case in cases:
        record = None if case.scene is None else read_json(home.case(case.key).record)
        if record is not None and record.get("status") == DONE:
            found[case.number] = record
    missing = [case for case in cases if case.number not in found]
    with (
        StudyDisplay(f"trade of {scene.name}", len(cases), len(found), quiet=not progress) as display,
        LocalPool(home, seconds, 1) as pool,
    ):
        for case in missing:
            if case.scene is not None:
                write_case(home.case(case.key), case.scene)
                pool.start(case)
            while pool.running:
                for ended, record in pool.ended():
                    found[ended.number] = record
                    display.finished(ended, record)
                display.refresh(home, pool.running)
    return [found[case.number] for case in cases]


def _case(number: int, scene: Scene, rung: Rung) -> Case:
    try:
        changed = Scene.from_table(apply_overrides(tomllib.loads(scene.to_toml()), rung.changes))
    except SceneError as error:
        return Case(number, {"rung": rung.name}, rung.changes, None, "", "; ".join(map(str, error.problems)))
    return Case(number, {"rung": rung.name}, rung.changes, changed, hash_of(changed))


def _quantity(planned: Record, asked: str | None) -> str:
    last = states_in(planned).get("last")
    if planned["status"] != DONE or last is None:
        raise StudyError(f"the scene as it is planned has no answer: {planned['reason']}")
    name = asked or str(planned.get("estimated") or "displacement")
    if name not in last:
        guess = nearest(name, last)
        hint = f'did you mean "{guess}"?' if guess else f"there are {', '.join(last)}"
        raise StudyError(f"no scalar {name}: {hint}")
    return name


def _row(rung: Rung, record: Record, quantity: str) -> Row:
    last: dict[str, Any] = states_in(record).get("last") or {}
    if record["status"] != DONE or quantity not in last:
        reason = record["reason"] or f"it has no {quantity}"
        return Row(rung.name, rung.of, rung.changes, record["status"], reason)
    estimate = record.get("errors", {}).get(quantity, math.nan)
    return Row(
        rung.name, rung.of, rung.changes, DONE, "", last[quantity], math.nan, estimate,
        record["cpu_seconds"], record["seconds"], record["peak_memory_bytes"], sum(record["unknowns"].values()),
    )  # fmt: skip
