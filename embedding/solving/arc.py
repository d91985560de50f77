"""A stage by arc length: the equilibrium path is followed until the stage's end is met, through limit points."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from embedding.scene import Stage
from embedding.scene.path import Until
from embedding.solving.branches import onto_branch
from embedding.solving.compression import compressed_from_rest
from embedding.solving.continuation import Condition, Corrector, Direction, Metric
from embedding.solving.critical import Critical, Search
from embedding.solving.curve import Point
from embedding.solving.diagnosis import FOLLOWED, crowded, limit_reason
from embedding.solving.events import Iteration
from embedding.solving.memory import Memory, of_target, point_of
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.ramp import out_of_rest, step
from embedding.solving.remeshing import Remeshed
from embedding.solving.result import Result
from embedding.solving.session import Session
from embedding.solving.shell_path import ShellPath
from embedding.solving.walk import Stride, Walk, settled, start

FIRST, LARGEST = 0.1, 0.25
"""First step, and largest one, as parts of the stage."""
MOST_ITERATIONS = 12
"""A correction that needs more is given up: a shorter step costs less."""
LAUNCHES = (1.0, 3.0, 0.5, 0.25, 0.125, 0.0625)
"""First steps out of a singular state that are tried, as parts of the first one. A slack sheet under next to no load is
the harder case: it has next to no tension."""
IMPATIENT = 0.2
"""A first step from rest is cut no shorter than this part before another way is tried."""
THERE = 1e-14
"""A goal is met within this rounding of displacements, in sizes of the structure."""
RETRIES = 5
"""How often a step into compression is halved, to end close to where it begins, and one that is too long to find the
critical points in it."""


ENDED = {
    Result.INVERTED_AMBIENT: "the space around the shell gives way",
    Result.STEP_BELOW_MINIMUM: "Newton's method no longer converges",
    Result.LINEAR_SOLVER_FAILED: "the equations are singular",
}
LOST = tuple(ENDED)
"""Ends of a path that say how it ended, and in which words; they may not be why."""


class ArcStage:
    """One stage followed by arc length until every one of the ``goals`` has been met, in their order; the last is the
    stage's end."""

    def __init__(
        self, session: Session, stage: Stage, begin: Target, end: Target, goals: Callable[[], Sequence[Condition]]
    ) -> None:
        self.session, self.stage, self.begin, self.end = session, stage, begin, end
        self._goals, self._number = goals, 0
        self._known = len(session.steps)
        self._follow_on(session.problem)
        self._iterations: list[Iteration] = []
        self._started = time.perf_counter()
        self._good: Any = None
        self._walk: Walk | None = None
        self._launched: float | None = None

    def _follow_on(self, problem: Problem) -> None:
        options = self.session.scene.solver
        self.path = ShellPath(problem, self.begin, self.end, self.session.newton.clock)
        self.corrector = Corrector(self.path, options.tolerance, min(options.max_iterations, MOST_ITERATIONS))

    def accepted(self) -> None:
        """The state at the walk's last point, or that of the first step out of a singular state, is an accepted step;
        both are known already."""

    def memory(self) -> Memory:
        """What the rest of the stage depends on, right after an accepted step."""
        return {
            "start": of_target(self.begin),
            "end": of_target(self.end),
            "goal": self._number,
            "known": self._known,
            "launched": self._launched,
            "walk": None if self._walk is None else self._walk.memory(),
        }

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned; the system is in the state of that step."""
        self._number, self._known = memory["goal"], memory["known"]
        self._launched = memory["launched"]
        walk = memory["walk"]
        if walk is None:
            return
        self.path.restore((self.session.problem.system.save(), walk["here"]["parameter"]))
        here = point_of(walk["here"], self.path.save())
        self._walk = self._walk_from(Metric(self.path, walk["weight"]), here)
        self._walk.recall(walk)

    def follow(self) -> Result:
        """Walk until the last goal has been met."""
        saved = self.path.save()
        try:
            return self._why(self._follow())
        except KeyboardInterrupt:
            self.path.restore(self._good if self._good is not None else saved)
            raise

    def _why(self, reason: Result) -> Result:
        """The true reason behind that of the last step: a load beyond its limit is not reached, however far the path
        goes on behind that."""
        if reason in FOLLOWED and self.stage.until is not None:
            self.session.detail = self._missed(self.stage.until)
        if reason not in LOST:
            return reason
        session, walk = self.session, self._walk
        tangent = None if walk is None else walk.here.tangent
        gone_back = tangent is not None and tangent.parameter < 0.0 and self.stage.until is None
        if gone_back and any(p.kind == "limit" and p.before_step > self._known for p in session.critical):
            found = limit_reason(session.problem, self.begin, self.end)
            session.detail = f"beyond its limit point the path was followed back to where {ENDED[reason]}"
            return found
        if session.at_rest:
            region = compressed_from_rest(session.problem, session.at, self.end)
            if region is not None:
                session.detail = region
                return Result.COMPRESSIVE_MEMBRANE
        found, detail = crowded(session.problem, reason)
        session.detail = detail or session.detail
        return found

    def _missed(self, until: Until) -> str:
        """In words: how far the point has come that the stage is to end with."""
        end, length = self._goals()[-1], self.session.problem.scales.length
        moved = length * end.value(self.path.values(), self.path.parameter)
        gone = f"the point of until is at {moved:.4g} m along {until.axis}, of {until.value:.4g} m asked for"
        return f"{gone}; see whether it, its axis and its sign are those meant"

    def _follow(self) -> Result:
        walk = self._walk or self._launch()
        while not isinstance(walk, Result):
            walk = self._to_goal(walk)
            if isinstance(walk, Result):
                break
            self._number += 1
            if self._number == len(self._goals()):
                return self._at_the_end(walk)
            self._aim(walk)
        return walk

    def _at_the_end(self, walk: Walk) -> Result:
        """Done; a stage that is at its end where it begins has that state as its one step."""
        if len(self.session.steps) > self._known:
            return Result.CONVERGED
        return self._accepted(walk.here, self._iterations) or Result.CONVERGED

    @property
    def _goal(self) -> Condition:
        return self._goals()[self._number]

    def _aim(self, walk: Walk) -> None:
        """Send the walk to the present goal, if it is not there."""
        walk.goal = self._goal
        walk.done = abs(walk.goal.gap(walk.here.values, walk.here.parameter)) <= THERE

    def _to_goal(self, walk: Walk) -> Walk | Result:
        """The walk at the present goal, or why it does not get there."""
        options = self.session.scene.solver
        while not walk.done:
            if self.session.worn:
                walk, _ = self._remeshed(walk)
            if len(self.session.steps) - self._known >= options.max_steps:
                return Result.MAX_STEPS
            if walk.here.place > options.max_arc:
                return Result.MAX_ARC
            walk.at_once = Result.INVERTED_AMBIENT if self.session.tired else None
            reason = self._step(walk)
            if reason is None:
                continue
            faded = self.path.faded
            self.path.restore(walk.here.saved)
            if reason is Result.INVERTED_AMBIENT and self.session.tired:
                walk, _ = self._remeshed(walk)  # where there is no new mesh, shorter steps are tried on this one
                continue
            return Result.FIELD_VANISHED if faded else reason
        return walk

    def _remeshed(self, walk: Walk) -> tuple[Walk, bool]:
        """The walk on a new mesh of the ambient around its last point; the same one and False if there is none."""
        here, kept, found = walk.here, (self.path, self.corrector), []

        def settle(problem: Remeshed) -> bool:
            self._follow_on(problem)
            if here.tangent is not None and self.path.move(self.path.values(), here.parameter):
                tangent = Direction(problem.carried(here.tangent.values), here.tangent.parameter)
                found.extend(settled(self.corrector, Metric(self.path, walk.metric.weight), here, tangent, self._watch))
            return bool(found)

        moved = False
        try:
            moved = self.session.remesh(settle)
        finally:  # also where somebody interrupts
            if not moved:
                self.path, self.corrector = kept
                self.path.restore(here.saved)
        if not moved:
            return walk, False
        new = self._walk_from(Metric(self.path, walk.metric.weight), found[0])
        new.length, new.done, self._walk = walk.length, walk.done, new
        return new, True

    def _launch(self) -> Walk | Result:
        """The walk at its first point; out of a singular state (a membrane at rest) the first step is one of load."""
        if self._launched is not None:
            return self._behind(self._launched)
        saved = self.path.save()
        walk = self._begun()
        if isinstance(walk, Walk):
            if walk.done or not self.session.at_rest:
                return walk
            patient, walk.stride = walk.stride, replace(walk.stride, smallest=IMPATIENT)
            reason = self._step(walk)
            walk.stride = patient
            if reason is None:
                return walk
            if reason is Result.COMPRESSIVE_MEMBRANE:
                return reason
        self._walk = None
        self.path.restore(saved)
        return self._out_of_rest()

    def _out_of_rest(self) -> Walk | Result:
        """The walk from a state at a small part of the load, found by Newton's method with a proximal term."""
        reason = Result.STEP_BELOW_MINIMUM
        for launch in LAUNCHES:
            self._launched = fraction = launch * self._stride().first
            found = step(self.session, self.stage, self.path.target(fraction))
            if found is None:
                return self._behind(fraction)
            reason = found
            self.session.cut(launch, found.name)
        reason, detail = out_of_rest(self.session, reason, self.path.target(fraction))
        self.session.detail = detail or self.session.detail
        return reason

    def _behind(self, launched: float) -> Walk | Result:
        """The walk that begins at the present state, to which a first step of load led."""
        self.path.move(self.path.values(), launched)
        self._started = time.perf_counter()
        return self._begun()

    def _begun(self) -> Walk | Result:
        """The walk at the present state, with the tangent towards the present goal."""
        found = start(self.corrector, self._goal, self._watch)
        if isinstance(found, Result):
            return found
        self._walk = self._walk_from(*found)
        self._aim(self._walk)
        return self._walk

    def _walk_from(self, metric: Metric, here: Point) -> Walk:
        self._good = here.saved
        return Walk(self.corrector, metric, here, self._goal, self._stride(), self._watch, self._cut)

    def _stride(self) -> Stride:
        hint = FIRST if self.stage.steps is None else min(FIRST, 1.0 / self.stage.steps)
        largest = LARGEST if self.stage.steps is None else 1.0 / self.stage.steps
        return Stride(hint, largest, self.session.scene.solver.min_step)

    def _step(self, walk: Walk) -> Result | None:
        """One accepted step, with the critical points on the way to it."""
        for attempt in range(RETRIES + 1):
            reason = walk.advance()
            if reason is not None:
                return reason
            critical, iterations = self._critical(walk), self._iterations
            if critical is None and attempt < RETRIES:
                reason = Result.STEP_BELOW_MINIMUM
            else:
                switched = self._passed(walk, critical or [])
                reason = self._accepted(walk.here, iterations)
                if reason is None or switched:
                    return reason
            walk.retract()
            if attempt == RETRIES or not walk.shorten(reason):
                return reason
        return Result.COMPRESSIVE_MEMBRANE

    def _accepted(self, here: Point, iterations: list[Iteration]) -> Result | None:
        self.path.restore(here.saved)
        target = self.path.target(here.parameter)
        reason = self.session.accept(self.stage.name, target, iterations, self._started, here.unstable)
        if reason is None:
            self._good, self._started = here.saved, time.perf_counter()
        return reason

    def _critical(self, walk: Walk) -> list[Critical] | None:
        """The critical points of the last step; None if it was too long to find them."""
        low, high = walk.before, walk.here
        if low is None or (low.unstable == high.unstable and low.turns_with(high)):
            return []
        kept = self._iterations
        found = Search(self.corrector, walk.metric, self._watch).between(low, high)
        self._iterations = kept
        return found

    def _passed(self, walk: Walk, critical: list[Critical]) -> bool:
        """Record the critical points of the last step; True if the path was left at one of them."""
        for one in critical:
            self.path.restore(one.point.saved)
            self.session.passed(self.stage.name, self.path.target(one.parameter), one)
            if one.kind == "bifurcation" and self._leaves(walk, one):
                return True
        return False

    def _leaves(self, walk: Walk, critical: Critical) -> bool:
        """Is this where the stage goes over to another branch? Then the walk's last point is on that."""
        branch = self.stage.branch
        if branch is None:
            return False
        asked = self.session.branches[-1]
        asked.met += 1
        if asked.met != branch.number:
            return False
        point = onto_branch(self.corrector, walk.metric, critical, branch.amplitude, self._watch)
        if point is None:
            return False
        walk.go_on_from(point, 2 * abs(branch.amplitude))
        asked.left = True
        return True

    def _watch(self, number: int, size: float, decrement: float) -> None:
        iteration = Iteration(number, size, decrement, *self.session.state.mean_pressures())
        if number == 1:
            self._iterations = []
        self._iterations.append(iteration)
        self.session.iterated(self.path.target(self.path.parameter), iteration)

    def _cut(self, fraction: float, reason: Result) -> None:
        self.session.cut(fraction, reason.name)
