"""The solve itself: stage by stage along the path, step by step with cutbacks, with listeners told of everything."""

from __future__ import annotations

import resource
import time
from collections.abc import Sequence
from typing import Any

from ngsolve import SetNumThreads, TaskManager

from embedding.plan import explain
from embedding.scene import Scene, Stage
from embedding.solving.diagnosis import Landmark, compressed, diagnose
from embedding.solving.estimate import estimate_error
from embedding.solving.events import Iteration, Listener, StepRecord
from embedding.solving.newton import Newton
from embedding.solving.path import Stepper, Target, stage_target
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.solution import Cost, Solution
from embedding.solving.state import State


def run(scene: Scene, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve ``scene`` and return its solution, whatever became of it; ``solution.result`` says.

    Raises:
        SceneError: the scene cannot be modelled.
    """
    SetNumThreads(scene.solver.threads)
    with TaskManager():
        return Run(scene, listeners).solve()


REST = 1e-6
"""A shell that is stretched by less counts as unstressed."""


class Run:
    """One solve in progress."""

    def __init__(self, scene: Scene, listeners: Sequence[Listener]) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()
        self.scene, self.listeners = scene, listeners
        self.problem = Problem(scene, explain(scene))
        self.state = State(self.problem)
        options = scene.solver
        self.newton = Newton(self.problem.system, options.tolerance, options.max_iterations, self.state.mean_pressures)
        self.steps: list[StepRecord] = []
        self.at = Target(0.0, 0.0, None, self._start_pressure)

    @property
    def _full_difference(self) -> float | None:
        """p_t - p_b at full load where the pressure may become an unknown, else None."""
        physics = self.problem.system.physics
        return physics.loads.difference if physics.volume_controlled else None

    @property
    def _start_pressure(self) -> float | None:
        return None if self._full_difference is None else 0.0

    def solve(self) -> Solution:
        """Walk the path to its end or to the first step that cannot be taken."""
        for listener in self.listeners:
            listener.started(self.problem)
        result, message = Result.CONVERGED, Result.CONVERGED.advice
        try:
            for stage in self.scene.path:
                result, message = self._stage(stage)
                if not result.ok:
                    break
            error = estimate_error(self.problem, self.at, self.steps) if result.ok else None
        except KeyboardInterrupt:
            result, message, error = Result.INTERRUPTED, self._told(Result.INTERRUPTED), None
        plan, scales = self.problem.plan, self.problem.scales
        solution = Solution(self.scene, plan, scales, result, message, tuple(self.steps), error, self._cost())
        for listener in self.listeners:
            listener.finished(solution)
        return solution

    def _stage(self, stage: Stage) -> tuple[Result, str]:
        start = self._stage_start(stage)
        end = stage_target(stage, self._full_difference)
        stepper = Stepper(stage.steps, self.scene.solver.min_step)
        landmark: Landmark | None = None
        for fraction in stepper.proposals():
            target = end.between(start, fraction)
            reason = self._try(stage, target)
            if reason is None:
                if landmark is None or stepper.relative_length >= 0.5:
                    landmark = Landmark(self.problem.system.save(), target, fraction)
                stepper.accept()
                self.at = target
            elif not stepper.cut():
                result = diagnose(self.problem, reason, self.at, end, stepper.accepted, landmark)
                return result, self._told(result)
            else:
                for listener in self.listeners:
                    listener.cut(len(self.steps) + 1, stepper.relative_length, reason.name)
        return Result.CONVERGED, Result.CONVERGED.advice

    def _stage_start(self, stage: Stage) -> Target:
        """The present load, with the volume or pressure the stage's control starts from."""
        if stage.volume_ratio is not None:
            volume = self.state.volume / self.problem.system.lagrangian.reference_volume
            return Target(self.at.mechanical, self.at.field, volume, None)
        pressure = None
        if self._full_difference is not None:
            pressure = float(self.problem.system.unknowns.field("pressure").vec[0])
        return Target(self.at.mechanical, self.at.field, None, pressure)

    def _try(self, stage: Stage, target: Target) -> Result | None:
        system, started = self.problem.system, time.perf_counter()
        saved = system.save()
        number = len(self.steps) + 1
        system.load(target.mechanical, target.field, target.volume, target.pressure)

        def watch(iteration: Iteration) -> None:
            for listener in self.listeners:
                listener.iterated(number, target.report(), iteration)

        try:
            outcome = self.newton.solve(watch, at_rest=self._at_rest)
        except KeyboardInterrupt:
            self._go_back(saved)
            raise
        reason: Result | None = outcome.reason
        scalars: dict[str, float] = {}
        if reason is None:
            scalars = self.state.scalars()
            reason = Result.COMPRESSIVE_MEMBRANE if compressed(self.problem, scalars) else None
        if reason is not None:
            self._go_back(saved)
            return reason
        record = StepRecord(
            number, stage.name, target.mechanical, target.field, outcome.iterations, scalars,
            time.perf_counter() - started,
        )  # fmt: skip
        self.steps.append(record)
        for listener in self.listeners:
            listener.accepted(self.state, record)
        return None

    @property
    def _at_rest(self) -> bool:
        """Is this a membrane that nothing has stretched so far?"""
        if self.problem.plan.bending:
            return False
        return not self.steps or abs(self.steps[-1].scalars["stretch_max"] - 1.0) < REST

    def _go_back(self, saved: Any) -> None:
        """Return to the last good state and its load."""
        self.problem.system.restore(saved)
        self.problem.system.load(self.at.mechanical, self.at.field, self.at.volume, self.at.pressure)

    def _told(self, result: Result) -> str:
        done = f"after {len(self.steps)} accepted steps" if self.steps else "before the first step was accepted"
        load = self.at.report()
        if self.problem.system.physics.field is None:
            load.pop("field", None)
        where = ", ".join(f"{name} {value:.4g}" for name, value in load.items())
        return f"stopped {done} (last good load: {where}): {result.advice}"

    def _cost(self) -> Cost:
        unknowns: dict[str, Any] = self.problem.system.unknowns.count
        return Cost(
            wall_seconds=time.perf_counter() - self._wall,
            cpu_seconds=time.process_time() - self._cpu,
            peak_memory_bytes=1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
            unknowns=unknowns,
            parts=dict(self.newton.clock.parts),
        )
