"""What one rung of a trade gave and cost."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A rung called ``rung``, about the choice ``of``: the ``value`` of the quantity at the end of the path in its SI
    unit, its relative ``error`` and the ``estimate`` of it, CPU and wall time in s, peak memory in bytes, unknowns.

    ``status`` is "done", or why there is no value; numbers that are not known are nan.
    """

    rung: str
    of: str
    changes: tuple[str, ...]
    status: str
    reason: str = ""
    value: float = math.nan
    error: float = math.nan
    estimate: float = math.nan
    cpu_seconds: float = math.nan
    wall_seconds: float = math.nan
    peak_memory_bytes: float = math.nan
    unknowns: float = math.nan

    @property
    def done(self) -> bool:
        """Is there a value?"""
        return self.status == "done"


def front(rows: Sequence[Row]) -> tuple[Row, ...]:
    """Those that no other beats in CPU time and in error at once, the cheapest first (Pareto's front)."""
    best: list[Row] = []
    compared = [row for row in rows if row.done and math.isfinite(row.error)]
    for row in sorted(compared, key=lambda row: (row.cpu_seconds, row.error)):
        if not best or row.error < best[-1].error:
            best.append(row)
    return tuple(best)


def cheapest(rows: Sequence[Row], tolerance: float) -> Row | None:
    """The cheapest row whose error is at most ``tolerance``, if there is one."""
    good = [row for row in rows if row.done and row.error <= tolerance]
    return min(good, key=lambda row: row.cpu_seconds, default=None)
