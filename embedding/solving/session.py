"""What every way of following a path shares: the present load, accepting a state, giving one up, telling listeners."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any, Protocol

from embedding.errors import EmbeddingError, SceneError
from embedding.geometry.remeshing import RemeshingError
from embedding.plan import explain
from embedding.scene import Scene
from embedding.solving.acceleration import ACCELERATORS
from embedding.solving.branches import BranchAsked
from embedding.solving.compression import compressed, region_in_compression
from embedding.solving.critical import Critical
from embedding.solving.events import Iteration, Listener, StepRecord
from embedding.solving.memory import LAYOUT, Kept, Memory, critical_of, mesh_digest, of_critical, of_target
from embedding.solving.newton import Newton
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.remeshing import TIRED, WORN, Remeshed
from embedding.solving.result import Result
from embedding.solving.solution import CriticalPoint
from embedding.solving.stability import countable
from embedding.solving.staggered import Once, Staggered
from embedding.solving.state import State
from embedding.timing import part

REST = 1e-6
"""A shell that is stretched by less counts as unstressed."""


class Way(Protocol):
    """How the present stage is followed."""

    def accepted(self) -> None:
        """The present state is an accepted step: go on from it."""

    def memory(self) -> Memory:
        """What the rest of the stage depends on, right after an accepted step."""


class OtherMeshError(EmbeddingError):
    """A run cannot be continued: the meshes it was on do not come out the same again."""

    exit_code = 2


class Session:
    """One solve in progress: the problem, its state, and what has been reached."""

    def __init__(self, scene: Scene, listeners: Sequence[Listener]) -> None:
        self.scene, self.listeners = scene, listeners
        self.way: Way | None = None
        with part("plan"):
            plan = explain(scene)
        self._work_on(Problem(scene, plan))
        self.stage = 0
        self.remeshings, self._meshed_at = 0, 0
        self.steps: list[StepRecord] = []
        self.critical: list[CriticalPoint] = []
        self.branches: list[BranchAsked] = []
        self.iterations, self.start = 0, "rest"
        self.detail, self.no_mesh = "", ""
        self.at = Target(0.0, 0.0, None, None if self.full_difference is None else 0.0)

    def memory(self) -> Memory:
        """What the rest of the run depends on, right after an accepted step."""
        return {
            "layout": LAYOUT,
            "stage": self.stage,
            "way": None if self.way is None else self.way.memory(),
            "at": of_target(self.at),
            "system": self.problem.system.memory(),
            "solver": self.solver.memory(),
            "mesh": self._digest,
            "meshed_at": self._meshed_at,
            "iterations": self.iterations,
            "start": self.start,
            "critical_points": [of_critical(point) for point in self.critical],
            "branches": [asdict(branch) for branch in self.branches],
        }

    def recall(self, kept: Kept) -> None:
        """Go on from where a run of the same scene was; of its stage, see ``memory["way"]``.

        Raises:
            OtherMeshError: the mesh is another one than it was.
        """
        memory = kept.memory
        for origin in kept.origins:
            self._work_on(Remeshed.from_origin(self.problem, origin))
        if self._digest != memory["mesh"]:
            raise OtherMeshError("the mesh comes out different from that of the run: it was made by other versions")
        self.remeshings, self._meshed_at = len(kept.origins), memory["meshed_at"]
        self.steps, self.at, self.stage = list(kept.steps), Target(**memory["at"]), memory["stage"]
        self.critical = [critical_of(point) for point in memory["critical_points"]]
        self.branches = [BranchAsked(**branch) for branch in memory["branches"]]
        self.iterations, self.start = memory["iterations"], memory["start"]
        self.load(self.at)
        self.problem.system.recall(memory["system"])
        self.solver.recall(memory["solver"])

    def _work_on(self, problem: Problem) -> None:
        self.problem, self.state = problem, State(problem, self.memory)
        self._digest = mesh_digest(problem.mesh)
        options = self.scene.solver
        self.newton = Newton(problem.system, options.tolerance, options.max_iterations, self.state.mean_pressures)
        self.solver = self._rung()

    def _rung(self) -> Newton | Staggered | Once:
        """What solves a load step: the joint Newton method, or what the plan has in its place."""
        options, joint, coupling = self.scene.solver, self.problem.system, self.problem.plan.coupling
        limits = options.tolerance, options.max_iterations, self.state.mean_pressures
        if coupling == "staggered":
            return Staggered(joint, *limits, ACCELERATORS[options.acceleration]())
        return Once(joint, *limits) if coupling == "once" else self.newton

    def load(self, target: Target) -> None:
        """Set the load of everything that is solved."""
        self.solver.load(target)

    @property
    def full_difference(self) -> float | None:
        """p_t - p_b at full load where the pressure may become an unknown, else None."""
        physics = self.problem.system.physics
        return physics.loads.difference if physics.volume_controlled else None

    @property
    def at_rest(self) -> bool:
        """Is this a membrane that nothing has stretched so far?"""
        if self.problem.plan.bending:
            return False
        return not self.steps or abs(self.steps[-1].scalars["stretch_max"] - 1.0) < REST

    @property
    def worn(self) -> bool:
        """Shall the ambient have a new mesh before the next step?"""
        return self._may_remesh and self.problem.system.min_jacobian < WORN

    @property
    def tired(self) -> bool:
        """Is a step that turns elements over worth a new mesh? On a good one such a step is wild, and to be cut."""
        return self._may_remesh and self.problem.system.min_jacobian < TIRED

    @property
    def _may_remesh(self) -> bool:
        once = self.problem.plan.coupling == "once"  # whose forces are those of the undeformed shape
        return bool(self.problem.system.motions) and not once and self._meshed_at != len(self.steps)

    def remesh(self, settle: Callable[[Remeshed], bool]) -> bool:
        """Give the ambient a new mesh around the present shape at the present load, where ``settle`` finds equilibrium
        again; False, and nothing changed, if it does not or there is no such mesh."""
        kept = self.problem, self.state, self.newton, self.solver, self._digest
        settled = False
        try:
            problem = Remeshed(self.problem)
            self._work_on(problem)
            self.newton.clock, self.solver.clock = kept[2].clock, kept[3].clock
            self.load(self.at)
            settled = settle(problem)
            self.no_mesh = "" if settled else "no equilibrium was found on a new mesh of the ambient around this shape"
        except (RemeshingError, SceneError) as error:  # what a scene must not have may come true on the new mesh alone
            self.no_mesh = f"there is no new mesh of the ambient around this shape ({error})"
        finally:
            if not settled:
                self.problem, self.state, self.newton, self.solver, self._digest = kept
                self._stay()
        if not settled:
            return False
        self.remeshings, self._meshed_at = self.remeshings + 1, len(self.steps)
        for listener in self.listeners:
            listener.remeshed(problem)
        return True

    def _stay(self) -> None:
        """Go on with the mesh at hand, and do not try again before the next step."""
        self.load(self.at)
        self._meshed_at = len(self.steps)

    def iterated(self, target: Target, iteration: Iteration) -> None:
        """Count a Newton step towards ``target``, and tell the listeners."""
        self.iterations += 1
        for listener in self.listeners:
            listener.iterated(len(self.steps) + 1, target.report(), iteration)

    def cut(self, fraction: float, reason: str) -> None:
        """Tell the listeners that the present step is tried again, shorter."""
        for listener in self.listeners:
            listener.cut(len(self.steps) + 1, fraction, reason)

    def accept(
        self, stage: str, target: Target, iterations: Sequence[Iteration], started: float, unstable: int | None
    ) -> Result | None:
        """Record the present, converged state as the next step; a reason if it is not to be kept."""
        scalars = self.state.scalars() | self.solver.scalars
        if not self.problem.plan.bending and scalars.get("volume_ratio", 1.0) <= 0.0:
            return Result.STEP_BELOW_MINIMUM  # inside out: no path of a membrane leads there
        if compressed(self.problem, scalars):
            self.detail = region_in_compression(self.problem, self.state)
            return Result.COMPRESSIVE_MEMBRANE
        if self.problem.system.motions:
            scalars["remeshings"] = float(self.remeshings)
        if countable(self.problem.system):
            scalars["unstable_modes"] = math.nan if unstable is None else float(unstable)
        record = StepRecord(
            len(self.steps) + 1, stage, target.mechanical, target.field, tuple(iterations), scalars,
            time.perf_counter() - started,
        )  # fmt: skip
        self.steps.append(record)
        self.at, self.detail, self.no_mesh = target, "", ""
        if self.way is not None:
            self.way.accepted()
        for listener in self.listeners:
            listener.accepted(self.state, record)
        return None

    def passed(self, stage: str, target: Target, found: Critical) -> None:
        """Record the present state as a critical point; the next step is the first behind it."""
        scalars = self.state.scalars()
        mode = found.mode[self.problem.system.unknowns.range("u")].copy()
        number = len(self.steps) + 1
        self.critical.append(
            CriticalPoint(
                found.kind, stage, number, target.mechanical, target.field, scalars, mode, found.unstable
            )
        )

    def go_back(self, saved: Any) -> None:
        """Return to the last good state and its load."""
        self.problem.system.restore(saved)
        self.load(self.at)

    def told(self, result: Result) -> str:
        """The message of a solve that ended with ``result``."""
        done = f"after {len(self.steps)} accepted steps" if self.steps else "before the first step was accepted"
        ramped, passed = self.scene.ramped, ""
        for point in self.critical:
            at = Target(point.factor_mechanical, point.factor_field, None)
            passed += f"; passed a {point.kind} point at {at.told(ramped, 5)}"
        told = self.detail or (self.no_mesh if result is Result.INVERTED_AMBIENT else "")
        detail = f"{told}: " if told else ""
        return f"stopped {done} (last good load: {self.at.told(ramped)}{passed}): {detail}{result.advice}"
