"""A run that starts from the state at the end of another scene's run, its neighbour in a study.

Where the two scenes differ in the size of their loads or of their field alone, or in where their paths end, the
neighbour's state is one of this scene at smaller or larger factors: the run ramps from there to the end of its path, in
one step if that can be. Where they differ otherwise, in stiffness say, Newton's method goes from the neighbour's state
straight to the end; if it does not get there, and where the mesh is another one, the scene is solved from rest.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from embedding.errors import memory_errors
from embedding.scene import Scene
from embedding.solving.arc import ArcStage
from embedding.solving.compression import compressed
from embedding.solving.continuation import at_parameter
from embedding.solving.driver import Run
from embedding.solving.events import Iteration, Listener
from embedding.solving.memory import Kept
from embedding.solving.path import Target, followed, stage_target
from embedding.solving.ramp import Ramp
from embedding.solving.result import Result
from embedding.solving.solution import Solution
from embedding.solving.stability import unstable_modes
from embedding.threads import parallel

NEIGHBOUR = "neighbour"
SAME = 1e-12
MECHANICAL, FIELD = "mechanical", "field"
IGNORED = ("name", "output", "path", "solver")
EXPRESSED = {"loads": MECHANICAL, "ambient": FIELD}
"""What is given there as an expression of the place is multiplied by that factor, too."""


@dataclass(frozen=True)
class Neighbour:
    """Another ``scene`` and what is ``kept`` of its run."""

    scene: Scene
    kept: Kept


def run_from(scene: Scene, neighbour: Neighbour, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve ``scene`` from the last state of a ``neighbour``; ``solution.start`` says "neighbour", or "rest: ..." and
    why it was solved along its path from there instead.

    Raises:
        SceneError: the scene cannot be modelled.
    """
    with parallel(scene.solver.threads), memory_errors():
        session = Continued(scene, listeners)
        reason = session.unfit(neighbour) or session.enter(neighbour)
        if not reason:
            session.start = NEIGHBOUR
            return session.solve()
        cold = Run(scene, listeners)
        cold.start, cold.iterations = f"rest: {reason}", session.iterations
        return cold.solve()


class Continued(Run):
    """A run from the state of a neighbour to the end of its last stage."""

    def __init__(self, scene: Scene, listeners: Sequence[Listener]) -> None:
        super().__init__(scene, listeners)
        self.stage = len(scene.path) - 1
        self._end = stage_target(scene.path[-1], self.full_difference)

    @property
    def at_rest(self) -> bool:
        """Its first state is that of the neighbour."""
        return bool(self.steps) and super().at_rest

    def unfit(self, neighbour: Neighbour) -> str:
        """Why the state of the neighbour is none of this scene; "" where it is."""
        memory = neighbour.kept.memory
        if self.scene.path[-1].branch is not None:
            return "its path ends on a branch"
        if self.scene.path[-1].until is not None:
            return "the load at the end of its path is not known before"
        if self.solver is not self.newton:
            return "field and shell are not solved jointly"
        if neighbour.kept.origins:
            return "its neighbour's space was meshed anew on the way"
        if memory["mesh"] != self._digest or memory["system"]["ranges"] != self.problem.system.memory()["ranges"]:
            return "it has another mesh or other unknowns than its neighbour"
        return ""

    def enter(self, neighbour: Neighbour) -> str:
        """Take the neighbour's state as the one to go on from, at its factors; or go from there to the end of the path
        at once; why that cannot be, or "". Listeners are told of nothing yet."""
        memory, factors = neighbour.kept.memory, common_factors(neighbour.scene, self.scene)
        self._modes = neighbour.kept.steps[-1].scalars.get("unstable_modes", 0.0)
        known = Target(**memory["at"])
        if factors is None:
            self.at = self._end
        else:
            mechanical, field = factors
            self.at = replace(known, mechanical=mechanical * known.mechanical, field=field * known.field)
        self.load(self.at)
        self.problem.system.recall(memory["system"])
        self.load(self.at)
        return "" if factors is not None else self._leap()

    def _leap(self) -> str:
        """Solve for the end of the path from the present state; why what was found is not to be kept, or ""."""
        system, self._begun = self.problem.system, time.perf_counter()
        self.load(self._end)
        self._outcome = outcome = self.newton.solve(self._count)
        if outcome.reason is not None:
            return f"Newton's method does not get there from its neighbour ({outcome.reason.name})"
        if compressed(self.problem, self.state.scalars()):
            return "the state found from its neighbour is compressed"
        self._unstable = unstable_modes(system)
        if self._unstable is not None and self._unstable > self._modes:
            return "the state found from its neighbour is less stable than that"
        return ""

    def _count(self, _: Iteration) -> None:
        self.iterations += 1

    def _stage(self, number: int) -> Result:
        """One step; where that fails, more of them, as the stage goes: by arc length, or ramped."""
        stage, saved = self.scene.path[number], self.problem.system.save()
        if not self._leap():
            reason = self.accept(stage.name, self._end, self._outcome.iterations, self._begun, self._unstable)
            return Result.CONVERGED if reason is None else reason
        self.go_back(saved)
        way: Ramp | ArcStage
        if followed(stage, self.at, self._end, with_field=self.problem.system.physics.field is not None):
            way = ArcStage(self, stage, self.at, self._end, lambda: [at_parameter(1.0)])
        else:
            way = Ramp(self, stage.model_copy(update={"steps": 2}), self.at, self._end)
        self.way = way
        return way.follow()


def common_factors(before: Scene, now: Scene) -> tuple[float, float] | None:
    """(m, f) where the scene ``before`` is ``now`` with m times its mechanical loads and given displacements, and with
    f times its voltages, charges and applied field; None where they differ in more, paths aside."""
    ratios: dict[str, set[float]] = {MECHANICAL: set(), FIELD: set()}
    one, other = (dict(_leaves(scene.model_dump(mode="json"), ())) for scene in (before, now))
    if one.keys() != other.keys():
        return None
    for place, value in other.items():
        kind, known = _kind(place), one[place]
        if place[0] in IGNORED:
            continue
        if kind is None or not isinstance(value, float) or not isinstance(known, float):
            if known != value:
                return None
            if "expression" in place and place[0] in EXPRESSED:
                ratios[EXPRESSED[place[0]]].add(1.0)
        elif value != 0.0:
            ratios[kind].add(known / value)
        elif known != 0.0:
            return None
    if any(max(found) - min(found) > SAME * max(map(abs, found)) for found in ratios.values() if found):
        return None
    mechanical, field = (found.pop() if found else 1.0 for found in ratios.values())
    return mechanical, field


def _leaves(value: Any, place: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Every single value in a table, with the keys that lead to it."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _leaves(item, (*place, key))
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from _leaves(item, (*place, str(number)))
    else:
        yield place, value


def _kind(place: tuple[str, ...]) -> str | None:
    """Which factor of the path a number is multiplied by, by its place in the scene."""
    match place:
        case ("loads", "pressure_top" | "pressure_bottom") | ("loads", "surface_force" | "body_force" | "gravity", _):
            return MECHANICAL
        case ("loads", "edge_tractions" | "line_loads" | "point_loads", _, "traction" | "force", _):
            return MECHANICAL
        case ("loads", "edge_moments", _, "moment") | ("supports", _, "displacement", _):
            return MECHANICAL
        case ("faces", _, "voltage" | "charge") | ("ambient", "applied_field", _):
            return FIELD
        case ("ambient", "bodies", _, "voltage" | "charge" | "potential") | ("ambient", "line_currents", _, "current"):
            return FIELD
    return None
