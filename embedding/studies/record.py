"""What is kept of a case: plain data for the index, from which every quantity of interest can be read later."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from embedding.solving import Solution

DONE, DIVERGED, REFUSED, RAISED = "done", "diverged", "refused", "raised"
KILLED, OVER_TIME, MISSING = "killed", "over time", "missing"
RESUMED = "resumed"
"""How a case started that went on from what an earlier attempt had left."""

Scalars = dict[str, float]


def record_of(solution: Solution) -> dict[str, Any]:
    """The record of a solve, converged or not."""
    steps = [_scalars(step) for step in solution.steps]
    states: dict[str, Scalars | None] = {
        "last": steps[-1] if steps else None,
        "max": {name: _extreme(max, name, steps) for name in steps[0]} if steps else None,
        "min": {name: _extreme(min, name, steps) for name in steps[0]} if steps else None,
    }
    for kind in ("limit", "bifurcation"):
        states[kind] = next((_scalars(point) for point in solution.critical_points if point.kind == kind), None)
    result = solution.result
    return {
        "status": DONE if result.ok else DIVERGED,
        "reason": "" if result.ok else f"{result.name}: {solution.message}",
        "states": states,
        "steps": len(steps),
        "start": solution.start,
        "iterations": solution.iterations,
        "estimated_error": None if solution.error is None else solution.error.value,
        "estimated": None if solution.error is None else solution.error.quantity,
        "errors": {name: error.value for name, error in solution.errors.items()},
        "seconds": solution.cost.wall_seconds,
        "cpu_seconds": solution.cost.cpu_seconds,
        "unknowns": solution.cost.unknowns,
        "peak_memory_bytes": solution.cost.peak_memory_bytes,
    }


def failure(status: str, reason: str) -> dict[str, Any]:
    """The record of a case without a solution."""
    return {"status": status, "reason": " ".join(reason.split()), "states": {}}


def without_nan(value: Any) -> Any:
    """The same data for JSON, which has neither nan nor inf: null in their place."""
    if isinstance(value, Mapping):
        return {key: without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def states_in(record: Mapping[str, Any]) -> dict[str, Scalars | None]:
    """The scalars of a record by place, null being nan again."""
    states: Mapping[str, Any] = record.get("states", {})
    return {place: None if state is None else _numbers(state) for place, state in states.items()}


def _numbers(state: Mapping[str, Any]) -> Scalars:
    return {name: math.nan if value is None else float(value) for name, value in state.items()}


def _scalars(point: Any) -> Scalars:
    """Scalars of a step or a critical point, with its load factors."""
    factors = {"factor_mechanical": point.factor_mechanical, "factor_field": point.factor_field}
    return {name: float(value) for name, value in (point.scalars | factors).items()}


def _extreme(choose: Any, name: str, steps: Iterable[Scalars]) -> float:
    values = [step[name] for step in steps if math.isfinite(step.get(name, math.nan))]
    return float(choose(values)) if values else math.nan
