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

HONEST = 2.0
"""An answer that is off by no more than this many times its own error estimate was told to be. The estimate is a part
of the answer, and so is the error that it is held against; that all of an answer is uncertain (an estimate of 1) tells
of an error of twice the answer, and of no larger one."""


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
    errors = _errors(answers, reference)
    worst = max(errors, key=errors.__getitem__, default="")
    error, stated = errors.get(worst, 0.0), _stated(solution, worst)
    verdict, reason = _verdict(cell, solution, answers, reference)
    told = solution.message
    if verdict in (TOLD, WRONG) and solution.result.ok:
        told = f"{worst} is {answers[worst]:.9g}, {reference[worst]:.9g} by {cell.source}"
    found = {name: answers[name] for name in reference}
    return replace(_finding(cell, verdict, reason, message=told), error=error, stated=stated, found=found)


def _errors(answers: Numbers, reference: Numbers) -> Numbers:
    return {name: abs(answers[name] - exact) / abs(exact) for name, exact in reference.items()}


def _verdict(cell: Cell, solution: Solution, answers: Numbers, reference: Numbers) -> tuple[str, str]:
    """The verdict on a solution with these ``answers``, and what it rests on."""
    errors = _errors(answers, reference)
    if not solution.result.ok:
        right = max(errors.values(), default=0.0) <= cell.tolerance
        return FAILED if right else WRONG, solution.result.name
    off = [name for name, error in errors.items() if error > cell.tolerance]
    if not off:
        return RIGHT, ""
    stated = {name: HONEST * _stated(solution, name) * abs(answers[name]) for name in off}
    if all(abs(answers[name] - reference[name]) <= most for name, most in stated.items()):
        return TOLD, "error estimate"
    warned = ", ".join(topic for topic in _warnings(solution) if topic in cell.warnings)
    return (TOLD, warned) if warned else (WRONG, "")


def _stated(solution: Solution, name: str) -> float:
    """The error that the solution states of this scalar, a part of its answer; nan where it says nothing of it."""
    return solution.errors[name].value if name in solution.errors else math.nan


def _warnings(solution: Solution) -> Iterator[str]:
    """What a user sees in red."""
    yield from (check.topic for check in solution.health if not check.good)
    yield from (assumption.topic for assumption in solution.assumptions if not assumption.held)


def _finding(cell: Cell, verdict: str, reason: str, *, message: str) -> Finding:
    return Finding(cell.family, cell.row, cell.value, verdict, reason, message=message, source=cell.source)


def lost(cell: Cell, why: str) -> Finding:
    """The finding of a cell whose process said nothing."""
    return _finding(cell, WRONG, "no end", message=why)
