"""A stage in equal steps of its load or volume, with cutbacks; a limit point ends it."""

from __future__ import annotations

import time

from embedding.scene import Stage
from embedding.solving.diagnosis import Landmark, diagnose
from embedding.solving.events import Iteration
from embedding.solving.path import Stepper, Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.session import Session
from embedding.solving.stability import unstable_modes


def ramp(session: Session, stage: Stage, start: Target, end: Target, steps: int) -> Result:
    """Walk from ``start`` to ``end`` in ``steps`` planned steps; a step that fails is cut."""
    stepper = Stepper(steps, session.scene.solver.min_step)
    landmark: Landmark | None = None
    for fraction in stepper.proposals():
        target = end.between(start, fraction)
        reason = step(session, stage, target)
        if reason is Result.INVERTED_AMBIENT and session.tired:
            landmark = None if landmark is None else landmark.measured(session.problem, end)
            reason = step(session, stage, target) if _remeshed(session) else reason
        if reason is None:
            if landmark is None or stepper.relative_length >= 0.5:
                landmark = Landmark(session.problem.system.save(), target, fraction)
            stepper.accept()
            if session.worn and fraction < 1.0:
                landmark = landmark.measured(session.problem, end)
                _remeshed(session)
        elif not stepper.cut():
            return diagnose(session.problem, reason, session.at, end, stepper.accepted, landmark)
        else:
            session.cut(stepper.relative_length, reason.name)
    return Result.CONVERGED


def _remeshed(session: Session) -> bool:
    """Has the ambient a new mesh around the last accepted state now?"""

    def settle(_: Problem) -> bool:
        outcome = session.solver.solve(lambda iteration: session.iterated(session.at, iteration))
        return outcome.reason is None

    return session.remesh(settle)


def step(session: Session, stage: Stage, target: Target) -> Result | None:
    """Solve for ``target`` from the last good state and accept it; else a reason, and the last good state."""
    system, started = session.problem.system, time.perf_counter()
    saved = system.save()
    session.load(target)

    def watch(iteration: Iteration) -> None:
        session.iterated(target, iteration)

    try:
        outcome = session.solver.solve(watch, at_rest=session.at_rest)
    except KeyboardInterrupt:
        session.go_back(saved)
        raise
    reason = outcome.reason
    if reason is None:
        unstable = unstable_modes(system) if session.solver is session.newton else None
        reason = session.accept(stage.name, target, outcome.iterations, started, unstable)
    else:
        session.detail = outcome.detail
    if reason is not None:
        session.go_back(saved)
    return reason
