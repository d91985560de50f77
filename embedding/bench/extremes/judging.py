"""The verdict on one cell: its scene solved as a user would, and the answer held against the reference."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from embedding.bench.extremes.cell import FAILED, REFUSED, RIGHT, TOLD, WRONG, Cell, Finding, Numbers
from embedding.errors import SceneError

if TYPE_CHECKING:
    from embedding.scene import Scene
    from embedding.solving import Solution

UNKNOWN = 1.0
"""An error estimate of all of a number says that nothing of it is known."""
HONEST = 2.0
"""An answer that is off by no more than this many times its own error estimate was told to be."""


def judge(cell: Cell, threads: int | None = None) -> Finding:
    """Solve the cell in this process and say what became of it; nothing that goes wrong is raised."""
    begun = time.perf_counter()
    try:
        found = _judged(cell, threads)
    except Exception as error:  # whatever it is, a user would have seen it
        found = _finding(cell, WRONG, type(error).__name__, message=str(error))
    return replace(found, seconds=time.perf_counter() - begun)


def _judged(cell: Cell, threads: int | None) -> Finding:
    from embedding.api import solve

    try:
        scene = cell.scene()
        solution = solve(scene if threads is None else _with_threads(scene, threads), throw=False)
    except SceneError as error:
        paths = [problem.path for problem in error.problems]
        true = bool(cell.fields) and all(path.startswith(cell.fields) for path in paths)
        return _finding(cell, REFUSED if true else WRONG, ", ".join(paths), message=str(error))
    if not solution.result.ok and solution.result.name not in cell.reasons:
        return _finding(cell, WRONG, solution.result.name, message=solution.message)
    if solution.result.ok or cell.expected == FAILED:
        return _compared(cell, solution)
    return _finding(cell, FAILED, solution.result.name, message=solution.message)


def _with_threads(scene: Scene, threads: int) -> Scene:
    return scene.model_copy(update={"solver": scene.solver.model_copy(update={"threads": threads})})


def _compared(cell: Cell, solution: Solution) -> Finding:
    reference, answers = cell.reference(), cell.answers(solution)
    missing = [name for name in reference if not math.isfinite(answers.get(name, math.nan))]
    if missing:
        return _finding(cell, WRONG, solution.result.name, message=f"no {', '.join(missing)}: {solution.message}")
    errors = {name: abs(answers[name] - exact) / abs(exact) for name, exact in reference.items()}
    worst = max(errors, key=errors.__getitem__, default="")
    error, stated = errors.get(worst, 0.0), _stated(solution, worst)
    verdict, reason = _verdict(cell, solution, errors)
    told = solution.message
    if verdict in (TOLD, WRONG) and solution.result.ok:
        told = f"{worst} is {answers[worst]:.9g}, {reference[worst]:.9g} by {cell.source}"
    found = {name: answers[name] for name in reference}
    return replace(_finding(cell, verdict, reason, message=told), error=error, stated=stated, found=found)


def _verdict(cell: Cell, solution: Solution, errors: Numbers) -> tuple[str, str]:
    """The verdict on a solution with these ``errors``, and what it rests on."""
    if not solution.result.ok:
        right = max(errors.values(), default=0.0) <= cell.tolerance
        return FAILED if right else WRONG, solution.result.name
    off = [name for name, error in errors.items() if error > cell.tolerance]
    if not off:
        return RIGHT, ""
    if all(errors[name] <= HONEST * _stated(solution, name) or _stated(solution, name) >= UNKNOWN for name in off):
        return TOLD, "error estimate"
    warned = ", ".join(_warnings(solution))
    return (TOLD, warned) if warned else (WRONG, "")


def _stated(solution: Solution, name: str) -> float:
    """The error that the solution states of a scalar, or else of its answer."""
    error = solution.errors.get(name, solution.error)
    return math.nan if error is None else error.value


def _warnings(solution: Solution) -> Iterator[str]:
    """What a user sees in red."""
    yield from (check.topic for check in solution.health if not check.good)
    yield from (assumption.topic for assumption in solution.assumptions if not assumption.held)


def _finding(cell: Cell, verdict: str, reason: str, *, message: str) -> Finding:
    return Finding(cell.family, cell.row, cell.value, verdict, reason, message=message, source=cell.source)


def lost(cell: Cell, why: str) -> Finding:
    """The finding of a cell whose process said nothing."""
    return _finding(cell, WRONG, "no end", message=why)
