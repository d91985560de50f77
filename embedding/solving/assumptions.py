"""Was what the plan left out small? Checked on the solution; and the scene with what was not put back.

Numbers are relative errors of the answer, allowed up to the scene's accuracy, or ``UNSTATED`` without one. The plan
decides by a safe part of that: a number with which it left a term out may grow on the way without being a violation.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from embedding.errors import SceneError
from embedding.plan.allowance import UNSTATED
from embedding.plan.far_field import ENOUGH
from embedding.plan.field import cramped
from embedding.plan.mesh import rim_size
from embedding.scene import Scene
from embedding.solving.events import StepRecord
from embedding.solving.neglected import Neglected
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.room import reach
from embedding.solving.solution import Assumption

RUNGS = {
    "bending": "model.theory=bending",
    "opened": "model.interface=opened",
    "meshed": "model.surroundings=meshed",
    "joint": "model.coupling=joint",
    "infinite": "model.far_field=infinite",
}
"""The overrides that bring back what a plan left out."""


def check_assumptions(
    problem: Problem, steps: Sequence[StepRecord], result: Result, of: Sequence[str]
) -> tuple[Assumption, ...]:
    """Everything the plan of ``problem`` left out, at the present state, the last of ``steps``.

    ``of`` names the scalars that are the answer. Of a solve that failed only what may have made it fail is checked:
    a membrane in compression.
    """
    if result is Result.COMPRESSIVE_MEMBRANE:
        return (_compressed(problem),)
    if not result.ok or not steps:
        return ()
    return tuple(_checked(problem, Neglected(problem, steps, of)))


def raised(scene: Scene, assumptions: Sequence[Assumption]) -> Scene:
    """``scene`` with every violated one of its ``assumptions`` lifted: the dearer model in its place.

    The same scene if all held, or if nothing can be lifted: compare with ``==``. A rung that the scene cannot have is
    left out. Solving what is returned may show further violations, of what the dearer models leave out in their turn;
    as every rung goes up, repeating it comes to an end.
    """
    for assumption in assumptions:
        if assumption.held or not assumption.rung:
            continue
        try:
            scene = scene.with_overrides(assumption.rung)
        except SceneError:  # such as space around electrodes that meet at a rim
            continue
    return scene


def _checked(problem: Problem, neglected: Neglected) -> Iterator[Assumption]:
    plan, ambient = problem.plan, problem.scene.ambient
    yield from _of_the_shell(problem, neglected)
    if ambient is None:
        return
    yield from _of_the_field(problem, neglected)
    if plan.coupling == "once":
        sentence = "the field's forces change with the shape by so much of the answer"
        yield _assumption(problem, "coupling", "once", neglected.coupling_gap, sentence, "joint")
    if not problem.system.motions:
        return
    if not plan.opened:
        sentence = "the faces lie half a thickness from the mid-surface: that much of the answer is the field's place"
        lifts = "" if cramped(problem.scene, rim_size(problem.scene, plan.sizes)) else "opened"
        yield _assumption(problem, "interface", "closed", neglected.closed_faces, sentence, lifts)
    if ambient.outer == "free-space" and not plan.sizes.beyond:
        sentence = "Robin's condition misses so much of the multipoles, by how far the deformed shell reaches"
        yield _assumption(problem, "far field", "second-order Robin", neglected.far_field, sentence, "infinite")
        yield from _of_soft_modes(problem, neglected)


def _of_soft_modes(problem: Problem, neglected: Neglected) -> Iterator[Assumption]:
    """Where modes were found unstable: shapes of soft rubber in a field of their own are nearly indifferent, as drops
    are, and what Robin's condition misses of their multipoles may tip them over."""
    if not any(step.scalars.get("unstable_modes", 0.0) > 0.0 for step in neglected.steps):
        return
    number = reach(problem) / problem.plan.sizes.radius
    sentence = "Robin's condition may tip soft modes over, by how far the deformed shell reaches into the space"
    rung = () if _pinned(problem.scene, "infinite") else (RUNGS["infinite"],)
    held = number <= 1 / ENOUGH
    yield Assumption("stability", "second-order Robin", number, 1 / ENOUGH, held, sentence, rung)


def _of_the_field(problem: Problem, neglected: Neglected) -> Iterator[Assumption]:
    """The field or its surroundings, where they are left out: the numbers of the planner, for the deformed shell."""
    extent, planned = problem.plan.extent, neglected.planned
    if extent == "none":
        sentence = "beside the mechanical loads the field is worth so much of the answer"
        yield _assumption(problem, "ambient", "none", neglected.field_felt, sentence, "meshed")
    if extent == "inside" and planned.surroundings is not None:
        sentence = "the field around the electrodes is worth so much of the answer"
        yield _assumption(problem, "field", "between the electrodes alone", planned.surroundings, sentence, "meshed")
    if extent == "given" and planned.perturbation is not None:
        sentence = "what the shell does to the applied field is worth so much of the answer"
        yield _assumption(problem, "field", "the applied field alone", planned.perturbation, sentence, "joint")


def _of_the_shell(problem: Problem, neglected: Neglected) -> Iterator[Assumption]:
    plan = problem.plan
    if not problem.system.unknowns.trace.free.any():
        return  # it is held
    theory = "bending" if plan.bending else "membrane"
    if neglected.slenderness > 0.0:
        better = "" if plan.bending or neglected.planned.walls_cancel else "bending"
        sentence = f"a wall of thickness over radius {neglected.slenderness:.2g} (deformed) is not a thin shell"
        yield _assumption(problem, "thin shell", theory, neglected.thickness, sentence, better)
    bends = not neglected.planned.walls_cancel
    if not plan.bending and bends and problem.domain.sizes.order > 1:
        sentence = "bending stores this against what carries the load"
        yield _assumption(problem, "shell theory", theory, neglected.bending, sentence, "bending")
    if not problem.system.physics.law.incompressible:
        sentence = "the law is one of small strains: the largest strain, that of bending on the faces included"
        yield _assumption(problem, "small strains", "small", neglected.strain, sentence, "")


def _compressed(problem: Problem) -> Assumption:
    sentence = "the membrane is in compression, which only bending stiffness carries: there is no answer"
    return _assumption(problem, "shell theory", "membrane", math.inf, sentence, "bending")


def _assumption(
    problem: Problem, topic: str, choice: str, number: float, sentence: str, lifts: str
) -> Assumption:
    stated = problem.scene.accuracy
    allowed = UNSTATED if stated is None else stated.relative
    rung = (RUNGS[lifts],) if lifts and not _pinned(problem.scene, lifts) else ()
    return Assumption(topic, choice, number, allowed, number <= allowed, sentence, rung)


def _pinned(scene: Scene, lifts: str) -> bool:
    """Does the scene itself say that this is to be left out?"""
    model = RUNGS[lifts].split("=")[0].split(".")[1]
    return bool(getattr(scene.model, model) != "auto")
