"""A stage in equal steps of its load or volume, with cutbacks; a limit point ends it."""

from __future__ import annotations

import math
import time
from dataclasses import replace

from embedding.scene import Stage
from embedding.solving.ahead import look_ahead
from embedding.solving.diagnosis import Landmark, Way, diagnose, largest, response_rate
from embedding.solving.events import Iteration
from embedding.solving.forecast import Array, Forecast
from embedding.solving.memory import Memory, of_target
from embedding.solving.path import DEFAULT_STEPS, Stepper, Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.session import Session
from embedding.solving.stability import unstable_modes

STILL = 1e-12
"""Displacement over size of a shell that its loads do not move."""


class Ramp:
    """One stage walked from ``start`` to ``end`` in planned steps; a step that fails is cut."""

    def __init__(self, session: Session, stage: Stage, start: Target, end: Target) -> None:
        self.session, self.stage, self.start, self.end = session, stage, start, end
        self._stepper = Stepper(stage.steps or DEFAULT_STEPS, session.scene.solver.min_step)
        self._landmark: Landmark | None = None
        begun = bool(session.steps) and not session.at_rest  # rest itself is no equilibrium under a magnet's own field
        self._forecast = Forecast([(0.0, session.problem.system.present)] if begun else [])

    def follow(self) -> Result:
        """Walk to the end of the stage, or to the first step that cannot be taken."""
        session, stepper, end = self.session, self._stepper, self.end
        for fraction in stepper.proposals():
            if session.worn:
                self._remeshed()
            target = end.between(self.start, fraction)
            whole = stepper.relative_length >= 1.0  # where steps fail, a guess would fail once more for each
            reason = step(session, self.stage, target, self._forecast.at(fraction) if whole else None)
            if reason is Result.INVERTED_AMBIENT and session.tired:
                reason = step(session, self.stage, target) if self._remeshed() else reason
            if reason is None:
                continue
            if not stepper.cut():
                return self._why(reason, target)
            session.cut(stepper.relative_length, reason.name)
        return Result.CONVERGED

    def _why(self, reason: Result, failed: Target) -> Result:
        """The true reason why the step to ``failed`` could not be taken."""
        session, found, detail = self.session, reason, ""
        if session.at_rest:
            found, detail = out_of_rest(session, reason, failed)
        if found is reason:
            way = Way(self.end, self._stepper.accepted, session.scene.solver.tolerance)
            found, detail = diagnose(session.problem, reason, session.at, failed, way, self._landmark)
        session.detail = detail or session.detail
        return found

    def _remeshed(self) -> bool:
        """Has the ambient a new mesh around the last accepted state now?"""
        if self._landmark is not None:  # it belongs to the mesh that may be given up
            self._landmark = self._landmark.measured(self.session.problem, self.end)
        found = _remeshed(self.session)
        if found:
            self._forecast.forget()
        return found

    def accepted(self) -> None:
        """The state at the last proposal is an accepted step."""
        session, stepper = self.session, self._stepper
        if self._landmark is None or stepper.relative_length >= 0.5:
            self._landmark = Landmark(session.problem.system.save(), session.at, stepper.fraction)
        stepper.accept()
        self._forecast.learn(stepper.accepted, session.problem.system.present)

    def memory(self) -> Memory:
        """What the ramp goes on from after an accepted step."""
        mark, here = self._landmark, self.session.at
        return {
            "start": of_target(self.start),
            "end": of_target(self.end),
            "accepted": self._stepper.accepted,
            "length": self._stepper.length,
            "former": [{"fraction": fraction, "unknowns": state} for fraction, state in self._forecast.former],
            "landmark": None if mark is None else {
                "target": of_target(mark.target), "fraction": mark.fraction, "rate": mark.rate,
                "saved": mark.saved if mark.target is not here and mark.rate is None else None,
            },
        }  # fmt: skip

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned; the system is in the state of that step."""
        self._stepper.accepted, self._stepper.length = memory["accepted"], memory["length"]
        former = [(state["fraction"], state["unknowns"]) for state in memory["former"]]
        self._forecast = Forecast([*former, (self._stepper.accepted, self.session.problem.system.present)])
        mark = memory["landmark"]
        if mark is not None:
            saved = mark["saved"] or self.session.problem.system.save()
            self._landmark = Landmark(saved, Target(**mark["target"]), mark["fraction"], mark["rate"])


def _remeshed(session: Session) -> bool:
    """Has the ambient a new mesh around the last accepted state now?"""

    def settle(_: Problem) -> bool:
        outcome = session.solver.solve(lambda iteration: session.iterated(session.at, iteration))
        return outcome.reason is None

    return session.remesh(settle)


def out_of_rest(session: Session, reason: Result, failed: Target) -> tuple[Result, str]:
    """Why there is no step out of rest to the load ``failed``, and words about it, if there is more to say than
    ``reason``: the field may pull in a membrane that its loads have not tensioned yet, and nothing may hold one."""
    problem, before = session.problem, session.at
    if reason is Result.COMPRESSIVE_MEMBRANE:
        return reason, ""
    alone = replace(failed, field=before.field)
    if session.solver is session.newton and alone not in (failed, before):
        limit, moved = _limit_of_field(session, alone, failed)
        if limit is not None:
            slack = "; tension the shell in a stage before that of the field" if moved else ""
            return Result.PULL_IN, largest(problem, limit) + slack
    if reason is Result.STEP_BELOW_MINIMUM and not math.isfinite(response_rate(problem, before, failed)):
        return Result.LINEAR_SOLVER_FAILED, ""
    return reason, ""


def _limit_of_field(session: Session, alone: Target, failed: Target) -> tuple[Target | None, bool]:
    """The limit point of the field on the way to ``failed`` from the load ``alone``, out of rest, if there is one; and
    whether that moves the shell."""
    system = session.problem.system
    saved = system.save()
    session.load(alone)
    try:
        if session.solver.solve(lambda _: None, at_rest=True).reason is not None:
            return None, False
        moved = session.state.displacement > STILL
        return look_ahead(session.problem, alone, failed, session.scene.solver.tolerance).limit, moved
    finally:
        session.go_back(saved)


def step(session: Session, stage: Stage, target: Target, guess: Array | None = None) -> Result | None:
    """Solve for ``target``, from a ``guess`` of the unknowns (n,) if there is one, and from the last good state if that
    leads nowhere, and accept what is found; else a reason, and the last good state."""
    if guess is not None and _attempt(session, stage, target, guess) is None:
        return None
    return _attempt(session, stage, target, None)


def _attempt(session: Session, stage: Stage, target: Target, guess: Array | None) -> Result | None:
    system, started = session.problem.system, time.perf_counter()
    saved = system.save()
    if guess is not None:
        system.present = guess
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
