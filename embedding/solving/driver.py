"""The solve itself: stage by stage along the path, each by the control it asks for."""

from __future__ import annotations

import resource
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from embedding.blas import numpy_ready
from embedding.errors import Problem as SceneProblem
from embedding.errors import SceneError, memory_errors, out_of_memory
from embedding.scene import Scene, Stage
from embedding.scene.messages import nearest
from embedding.solving.arc import ArcStage
from embedding.solving.assumptions import check_assumptions
from embedding.solving.branches import BranchAsked
from embedding.solving.continuation import Condition, at_parameter
from embedding.solving.diagnosis import out_of_theory
from embedding.solving.estimate import Ending, default_quantity, estimate_errors
from embedding.solving.estimate.estimate import COUNTED
from embedding.solving.events import Listener
from embedding.solving.health import check_health
from embedding.solving.memory import Kept
from embedding.solving.path import DEFAULT_STEPS, Target, followed, stage_target
from embedding.solving.places import displacement_row, refuse_held
from embedding.solving.ramp import Ramp
from embedding.solving.result import Result
from embedding.solving.session import Session
from embedding.solving.solution import Check, Cost, ErrorEstimate, Solution
from embedding.threads import parallel
from embedding.timing import part


def run(scene: Scene, listeners: Sequence[Listener] = (), kept: Kept | None = None) -> Solution:
    """Solve ``scene`` and return its solution, whatever became of it; ``solution.result`` says.

    With ``kept`` go on from the last step of a run of the same scene that ended early.

    Raises:
        SceneError: the scene cannot be modelled.
        OtherMeshError: the meshes that the earlier run was on do not come out the same again.
    """
    with parallel(scene.solver.threads), memory_errors():
        numpy_ready()
        return Run(scene, listeners, kept).solve()


class Run(Session):
    """One solve in progress."""

    def __init__(self, scene: Scene, listeners: Sequence[Listener], kept: Kept | None = None) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()
        super().__init__(scene, listeners)
        for number, stage in enumerate(scene.path):
            self._goals(number, stage)  # refuses what cannot be met before anything is solved
        self._refuse_unknown_scalars()
        if kept is not None:
            self.recall(kept)
        self._way = kept.memory["way"] if kept is not None else None

    def solve(self) -> Solution:
        """Walk the path to its end or to the first step that cannot be taken."""
        for listener in self.listeners:
            listener.started(self.problem)
        result, errors, health = Result.CONVERGED, dict[str, ErrorEstimate](), tuple[Check, ...]()
        try:
            for number in range(self.stage, len(self.scene.path)):
                result = out_of_theory(self.problem, self._stage(number))
                if not result.ok:
                    break
            with part("estimate"):
                if result.ok:
                    estimates = estimate_errors(self.problem, self.at, self.steps, self._ending)
                    errors = estimates.errors
                    health = check_health(self.problem, estimates, self.steps, self.branches)
        except KeyboardInterrupt:
            result, errors = Result.INTERRUPTED, {}
        except Exception as failure:
            if not out_of_memory(failure):
                raise
            result, errors = Result.OUT_OF_MEMORY, {}
        message = result.advice if result.ok else self.told(result)
        error = self._worst(errors)
        answers = self._asked or ((error.quantity,) if error is not None else ())
        assumptions = check_assumptions(self.problem, self.steps, result, answers)
        solution = Solution(
            self.scene, self.problem.plan, self.problem.scales, result, message, tuple(self.steps), error,
            self._cost(), errors=errors, critical_points=tuple(self.critical), iterations=self.iterations,
            start=self.start, assumptions=assumptions, health=health,
        )  # fmt: skip
        for listener in self.listeners:
            listener.finished(solution)
        return solution

    @property
    def _asked(self) -> tuple[str, ...]:
        """The scalars whose accuracy the scene states."""
        return self.scene.accuracy.of if self.scene.accuracy is not None else ()

    def _worst(self, errors: dict[str, ErrorEstimate]) -> ErrorEstimate | None:
        """The largest error of the scalars that count as the answer."""
        if not errors:
            return None
        scalars = self.steps[-1].scalars
        names = self._asked or (default_quantity(self.problem, scalars, self.at, self._ending),)
        found = [errors[name] for name in names if name in errors]
        return max(found, key=lambda error: error.value, default=None)

    def _refuse_unknown_scalars(self) -> None:
        """Refuse an accuracy of scalars that no step of this scene has, or that have none."""
        there = [name for name in self.state.scalars() if name not in COUNTED] if self._asked else []
        problems = []
        for number, name in enumerate(self._asked):
            if name not in there:
                guess = nearest(name, there)
                hint = f'did you mean "{guess}"?' if guess else f"this scene has {', '.join(there)}"
                if name in COUNTED:
                    hint = f"it describes the run and not the answer; this scene has {', '.join(there)}"
                problems.append(SceneProblem(f"accuracy.of.{number}", f"{name} is not allowed: {hint}"))
        if problems:
            raise SceneError(problems)

    def _stage(self, number: int) -> Result:
        self.stage, stage, memory = number, self.scene.path[number], self._way
        if memory is None:
            start, end = self._stage_start(stage), stage_target(stage, self.full_difference)
            if stage.branch is not None:
                self.branches.append(BranchAsked(stage.name, stage.branch.number))
        else:
            start, end = (Target(**memory[name]) for name in ("start", "end"))
        with_field, joint = self.problem.system.physics.field is not None, self.solver is self.newton
        way: Ramp | ArcStage
        if followed(stage, start, end, with_field=with_field, joint=joint):
            way = ArcStage(self, stage, start, end, lambda: self._goals(number, stage))
        else:
            way = Ramp(self, stage, start, end)
        if memory is not None:
            way.recall(memory)
        self.way, self._way = way, None
        return way.follow()

    def _goals(self, number: int, stage: Stage) -> list[Condition]:
        """What a stage that follows its path is to meet, one after the other."""
        if stage.until is None:
            return [at_parameter(1.0)]
        row = np.zeros(self.problem.system.unknowns.space.ndof)
        weights = displacement_row(self.problem, stage.until, number)
        refuse_held(self.problem, weights, stage.until, number)
        row[self.problem.system.unknowns.range("u")] = weights
        value = stage.until.value / self.problem.scales.length
        if stage.control != "displacement":
            return [Condition(row, 0.0, value)]
        steps = stage.steps or DEFAULT_STEPS
        return [Condition(row, 0.0, float(part)) for part in np.linspace(0.0, value, steps + 1)[1:]]

    @property
    def _ending(self) -> Ending | None:
        """Where the last stage ended, if at a displacement."""
        way, number = self.way, len(self.scene.path) - 1
        until = self.scene.path[number].until
        if until is None or not isinstance(way, ArcStage):
            return None
        return Ending(until, number, way.begin, way.end, way.path.parameter)

    def _stage_start(self, stage: Stage) -> Target:
        """The present load, with the volume or pressure the stage's control starts from."""
        if stage.volume_ratio is not None:
            volume = self.state.volume / self.problem.system.lagrangian.reference_volume
            return Target(self.at.mechanical, self.at.field, volume, None)
        pressure = None
        if self.full_difference is not None:
            pressure = float(self.problem.system.unknowns.field("pressure").vec[0])
        return Target(self.at.mechanical, self.at.field, None, pressure)

    def _cost(self) -> Cost:
        unknowns: dict[str, Any] = self.problem.system.unknowns.count
        return Cost(
            wall_seconds=time.perf_counter() - self._wall,
            cpu_seconds=time.process_time() - self._cpu,
            peak_memory_bytes=1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
            unknowns=unknowns,
            parts=dict(self.solver.clock.parts),
        )
