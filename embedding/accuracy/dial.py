"""From a scene that states an accuracy to a solution that has it, at little cost, or the reason why there is none.

Each attempt is a solve of the whole scene whose error estimate, split by source, says what to raise: the mesh and the
order where the discretisation is too coarse, a model where an assumption of the plan did not hold. What no mesh and no
model of this library can give, as the thickness of a thick wall, ends it at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from embedding.accuracy.levels import Level, first_level, ladder, next_level
from embedding.errors import SceneError
from embedding.plan import explain
from embedding.plan.decisions import Plan
from embedding.plan.loading import Loading
from embedding.scene import Scene
from embedding.solving.assumptions import raised
from embedding.solving.result import Result
from embedding.solving.solution import DISCRETE, Assumption, Attempt, ErrorEstimate, Solution

COUNTED = ("thin shell", "interface", "far field")
"""Assumptions that the error estimate has a part for, nearer to the truth than their bounds."""
SURE = 1.25
"""An estimate is trusted to this factor: that of nine in ten problems with a known answer is within it from below
(tests/solving/test_effectivity)."""
SHARE = 0.6
"""Part of what the model leaves of the accuracy that the discretisation may take at the next attempt."""
LEFT, TOO_MUCH, LEAST = 1e-4, 0.1, 1e-13
"""Part of the accuracy at which Newton's method may end, in sizes of the shell; it has made one more update by then.
A shell that hardly moves has more left of its answer: where that is ``TOO_MUCH`` of the accuracy, Newton's method goes
on to a hundredth of it, or to the ``LEAST`` that a scene may ask for."""
GAINING, PATIENCE = 0.7, 2
"""The mesh is given up where the last ``PATIENCE`` refinements left more than this of the discretisation's part."""
CANNOT = (Result.INTERRUPTED, Result.MAX_ARC, Result.MAX_STEPS, Result.LIMIT_POINT, Result.PULL_IN)
"""Ends of a path that are the scene's own, and no mesh's."""


@dataclass(frozen=True)
class Verdict:
    """What follows an attempt: the ``result`` that ends it all, or the ``scene`` (and ``level``) to go on with, and
    another ``tolerance`` for it."""

    reason: str
    result: Result | None = None
    scene: Scene | None = None
    level: Level | None = None
    tolerance: float | None = None


def solve_to_accuracy(scene: Scene, solve: Callable[[Scene], Solution]) -> Solution:
    """The first solution of ``scene`` whose estimated error is at most what the scene asks for.

    ``solve`` solves one scene and returns its solution, whatever became of it. The result of the one returned is
    CONVERGED, or says why the accuracy was not reached; ``attempts`` tell of all.
    """
    stated, plan = scene, explain(scene)
    if scene.accuracy is None:
        return solve(scene)
    level, attempts = first_level(plan, scene.accuracy.relative), list[Attempt]()
    tolerance, parts = _tolerance(stated, scene.accuracy.relative), list[float]()
    while True:
        changes = (*level.changes(stated, plan), *((f"solver.tolerance={tolerance}",) if tolerance else ()))
        solution = solve(stated.with_overrides(changes))
        parts.append(math.inf if solution.error is None else solution.error.discretisation)
        verdict = _judged(stated, plan, level, solution, parts)
        value = None if solution.error is None else solution.error.value
        cost = solution.cost
        told = (*_model_changes(scene, stated), *changes)
        attempts.append(Attempt(told, value, verdict.reason, cost.wall_seconds, cost.cpu_seconds))
        if verdict.result is not None:
            message = f"{verdict.reason}: {verdict.result.advice}" if verdict.reason else solution.message
            ended = verdict.result if solution.result.ok else solution.result
            return replace(solution, result=ended, message=message, attempts=tuple(attempts))
        if verdict.tolerance is not None:
            tolerance = verdict.tolerance
            parts.pop()
        if verdict.scene is not None and verdict.level is not None:
            stated, level = verdict.scene, verdict.level
            plan = explain(stated)


def resumed(solution: Solution) -> Solution:
    """The ``solution`` of an attempt that was resumed, which no other follows: with the accuracy that its scene asks
    for, or with the result that it has not."""
    asked, error = solution.scene.accuracy, solution.error
    if asked is None or error is None or not solution.result.ok or SURE * error.value <= asked.relative:
        return solution
    told = f"the error estimate is {error.value:.1e}, of {asked.relative:g}, and a run that is resumed is not refined"
    message = f"{told}. Solve the scene again, from its file"
    return replace(solution, result=Result.ACCURACY_NOT_REACHED, message=message)


def _tolerance(scene: Scene, relative: float) -> float | None:
    """Newton's method ends where what it leaves is next to nothing of the accuracy, unless the scene says where."""
    needed, default = LEFT * relative, type(scene.solver).model_fields["tolerance"].default
    return needed if scene.solver.tolerance == default < needed else None


def _tighter(scene: Scene, solution: Solution, relative: float) -> float | None:
    """The tolerance at which Newton's method is to end instead, where it ended too early for the answer."""
    left = 0.0 if solution.error is None else solution.error.parts.get("solver", 0.0)
    stated, used = scene.solver.tolerance, solution.scene.solver.tolerance
    if left <= TOO_MUCH * relative or stated != type(scene.solver).model_fields["tolerance"].default:
        return None
    needed = max(LEAST, used * min(1.0, relative / left) * TOO_MUCH**2)
    return needed if needed < 0.5 * used else None


def _judged(scene: Scene, plan: Plan, level: Level, solution: Solution, parts: Sequence[float]) -> Verdict:
    """What to do after an attempt on ``level``; ``parts`` are those of the discretisation so far."""
    relative = scene.accuracy.relative if scene.accuracy is not None else math.inf
    if solution.result in CANNOT:
        return Verdict("", solution.result)
    if solution.result.ok and solution.error is None:
        of = ", ".join(scene.accuracy.of) if scene.accuracy is not None and scene.accuracy.of else "the answer"
        return Verdict(f"{of}: 0, which has no relative error", Result.ACCURACY_NOT_REACHED)
    if not solution.result.ok or solution.error is None:
        lifted = raised(scene, solution.assumptions)
        if lifted != scene:
            return Verdict("what the plan left out was needed", scene=lifted, level=level)
        return _finer(scene, plan, level, float("inf"), solution, at_edges=False)
    violations = _violations(scene, solution)
    higher = raised(scene, violations)
    if higher != scene:
        return Verdict(_violated(violations), scene=higher, level=level)
    error = solution.error
    if SURE * error.value <= relative:
        return Verdict("", Result.CONVERGED)
    tighter = _tighter(scene, solution, relative)
    if tighter is not None:
        told = f"Newton's method left {error.parts['solver']:.1e} of the answer"
        return Verdict(told, scene=scene, level=level, tolerance=tighter)
    model = SURE * (error.value - error.discretisation)
    if model >= relative:
        return _beyond(scene, level, error, model, relative)
    excess = error.discretisation / (SHARE * (relative - model))
    ambient = sum(part for source, part in error.parts.items() if source.startswith("ambient"))
    at_edges = bool(plan.sizes.edges) and ambient > 0.5 * error.discretisation
    if len(parts) > PATIENCE and parts[-1] > GAINING * parts[-1 - PATIENCE]:
        worst = max((name for name in DISCRETE if name in error.parts), key=lambda name: error.parts[name])
        told = f"{worst} {error.parts[worst]:.1e}, of {relative:g} in all, does not become less on finer meshes"
        return Verdict(told, Result.BEYOND_THE_MODEL)
    return _finer(scene, plan, level, excess, solution, at_edges=at_edges)


def _finer(
    scene: Scene, plan: Plan, level: Level, excess: float, solution: Solution, *, at_edges: bool
) -> Verdict:
    higher = next_level(plan, level, excess, at_edges=at_edges)
    error = solution.error
    told = "no answer" if error is None else f"the discretisation's part {error.discretisation:.1e} is too large"
    if higher is None:
        return Verdict(f"{told} on the finest mesh", Result.ACCURACY_NOT_REACHED)
    most = scene.accuracy.max_unknowns if scene.accuracy is not None else 0
    if _predicted(plan, level, higher, sum(solution.cost.unknowns.values())) > most:
        return Verdict(f"{told}, and a finer mesh has more than {most} unknowns", Result.ACCURACY_NOT_REACHED)
    return Verdict(told, scene=scene, level=higher)


def _predicted(plan: Plan, level: Level, higher: Level, unknowns: int) -> float:
    """Unknowns on a higher level, from those on this one."""
    dimension = 2 if plan.reduction.name == "3d" else 1
    dimension += plan.extent == "surroundings"
    (order, size), (more, smaller) = ladder(plan)[level.mesh], ladder(plan)[higher.mesh]
    # away from the shell elements grow, so that their number goes with those on the shell and not with the volume
    return unknowns * (more / order) ** dimension * (size / smaller) ** (2 if plan.reduction.name == "3d" else 1)


def _beyond(scene: Scene, level: Level, error: ErrorEstimate, model: float, relative: float) -> Verdict:
    """The model alone misses more: a better one where there is one."""
    for source, change in BETTER.items():
        if error.parts.get(source, 0.0) > 0.5 * relative:
            try:
                higher = scene.with_overrides((change,))
            except SceneError:
                continue
            field = change.split("=")[0].split(".")[1]
            if getattr(scene.model, field) == "auto":
                return Verdict(f"{source} {error.parts[source]:.1e}", scene=higher, level=level)
    models = (source for source in error.parts if source not in DISCRETE)
    worst = max(models, key=lambda source: error.parts[source])
    if worst == "solver":
        told = f"{error.quantity}: 0 up to what Newton's method leaves of it, which has no relative error"
        return Verdict(told, Result.ACCURACY_NOT_REACHED)
    return Verdict(f"{worst} alone is {error.parts[worst]:.1e}, of {relative:g} in all", Result.BEYOND_THE_MODEL)


BETTER = {"closed faces": "model.interface=opened", "far field": "model.far_field=infinite"}
"""Sources of errors that a better model takes away."""


def _violations(scene: Scene, solution: Solution) -> list[Assumption]:
    """What the plan must not leave out and no part of the error counts. Where a shell grows alike everywhere that of
    the thickness counts its bending; else bending moves some points more than others."""
    counted = set(COUNTED)
    if Loading(scene).homogeneous and solution.error is not None and "thickness" in solution.error.parts:
        counted.add("shell theory")
    return [one for one in solution.assumptions if not one.held and one.topic not in counted]


def _violated(violations: Sequence[Assumption]) -> str:
    return ", ".join(f"{one.topic} ({one.choice}) {one.number:.1e}" for one in violations)


def _model_changes(scene: Scene, stated: Scene) -> tuple[str, ...]:
    """The models that were raised, as overrides."""
    fields = type(scene.model).model_fields
    return tuple(
        f"model.{name}={getattr(stated.model, name)}"
        for name in fields
        if getattr(stated.model, name) != getattr(scene.model, name)
    )
