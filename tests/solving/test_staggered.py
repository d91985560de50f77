"""Field and shell solved in turn, or one after the other: the joint answer, the factor of a turn, and where it ends."""

from __future__ import annotations

import io
import math
import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from embedding import Listener, Result, Scene, SceneError, Solution, explain, open_archive, solve
from embedding.coupling.system import System
from embedding.geometry.spaces import as_mask
from embedding.progress import ProgressDisplay
from embedding.scene.scales import EPSILON_0
from embedding.solving.events import StepRecord
from embedding.solving.partition import FieldPart, ShellAlone
from embedding.solving.state import State
from problems import charged_balloon, grounded_balloon, permeable_sphere
from problems.exact.roots import bracketed_root
from tests.coupling.scenes import coupled
from tests.unestimated import unestimated

pytestmark = pytest.mark.usefixtures("unestimated")

TURNS = "model.coupling=staggered"
ONCE = "model.coupling=once"
PLAIN, AITKEN = "solver.acceleration=none", "solver.acceleration=aitken"
COARSE = ("discretisation.order=2", "discretisation.shell_size=8 mm")
MAGNETISED = "path=[{name = 'inflating', steps = 2, field = 0.0}, {name = 'magnetising', steps = 2}]"
SCENES: dict[str, tuple[Any, tuple[str, ...]]] = {
    "charged": (charged_balloon, ("path=[{steps = 4}]",)),
    "charged, closed": (charged_balloon, ("path=[{steps = 4}]", "model.interface=closed")),
    "charged, bending": (charged_balloon, ("path=[{steps = 4}]", "model.theory=bending")),
    "charged, 3d": (charged_balloon, ("path=[{steps = 2}]", "model.reduction=3d", "discretisation.shell_size=12 mm")),
    "grounded": (grounded_balloon, ("path=[{steps = 4}]", *grounded_balloon.at_voltage(340e3))),
    "permeable": (permeable_sphere, (MAGNETISED,)),
}


@cache
def solved_jointly(name: str) -> Solution:
    problem, changes = SCENES[name]
    found: Solution = problem.run(*changes)
    return found


class JointUpdate(Listener):
    """What one joint Newton step would still change, root mean square in shell sizes, at every accepted step."""

    def __init__(self) -> None:
        self.updates: list[float] = []

    def accepted(self, state: State, record: StepRecord) -> None:
        system = state.problem.system
        step, _ = system.newton_update()
        self.updates.append(system.displacement_norm(step))


@pytest.mark.parametrize(
    ("name", "acceleration"),
    [
        *((name, "iqn-ils") for name in SCENES if "3d" not in name),
        pytest.param("charged, 3d", "iqn-ils", marks=pytest.mark.slow),
        ("grounded", "aitken"),
        ("permeable", "aitken"),
        ("permeable", "none"),
    ],
)
def test_the_answer_is_the_joint_one(name: str, acceleration: str) -> None:
    """Joint and staggered meshes of the ambient may move differently, so that answers agree to its error; and at the
    staggered state itself the joint system has nothing left to do."""
    problem, changes = SCENES[name]
    left = JointUpdate()
    joint = solved_jointly(name)
    turns = problem.run(*changes, TURNS, f"solver.acceleration={acceleration}", listeners=[left])
    assert turns["stretch"] == pytest.approx(joint["stretch"], abs=1e-6)
    assert max(left.updates) < 1e-8
    assert len(turns.steps) == len(joint.steps)


@pytest.mark.parametrize("faces", ["film", "top", "bottom", "bare"])
@pytest.mark.parametrize("reduction", ["axisymmetric", "plane-strain"])
def test_every_kind_of_electrode(reduction: str, faces: str) -> None:
    """Fields inside the shell, jumps that are unknown, with the volume controlled in the film's case."""
    stated = coupled(reduction, faces, controlled=faces == "film").scene
    left = JointUpdate()
    half = stated.path[0].model_copy(update={"mechanical": 0.6, "field": 0.6, "steps": 3})
    turns = stated.model.model_copy(update={"coupling": "staggered"})
    scene = stated.model_copy(update={"model": turns, "path": (half,)})
    assert solve(scene, listeners=[left]).result is Result.CONVERGED
    assert max(left.updates) < 1e-8


def test_factor_of_a_breathing_sphere() -> None:
    """Closed, in a grounded sphere of four radii, force and resistance per reference area are w / (1 - l / 4)^2 and
    l - l^-5: one turn multiplies an error by (l - l^-5) / (2 (1 - l / 4) (1 + 5 l^-6)), 1 at pull-in."""
    changes = (*grounded_balloon.at_voltage(333e3), "model.interface=closed", "path=[{steps = 1}]", PLAIN)
    solution = grounded_balloon.run(*changes, TURNS)
    stretch = float(solution["stretch"][-1])
    known = (stretch - stretch**-5) / (2 * (1 - stretch / 4) * (1 + 5 * stretch**-6))
    updates = [iteration.update for iteration in solution.steps[-1].iterations]
    ratios = [after / before for before, after in zip(updates, updates[1:], strict=False) if 1e-6 < after < 1e-4]
    assert len(ratios) >= 2
    assert ratios == pytest.approx([known] * len(ratios), rel=5e-3)
    pull_in = bracketed_root(lambda s: s - s**-5 - 2 * (1 - s / 4) * (1 + 5 * s**-6), 1.2, 2.0)
    assert pull_in == pytest.approx(1.616, abs=1e-3)


class Factor(Listener):
    """The largest eigenvalue of 1 - K_shell^-1 K_joint at the last step, K_joint with all else eliminated."""

    value = math.nan

    def accepted(self, state: State, record: StepRecord) -> None:
        joint = state.problem.system
        shell = ShellAlone(joint.domain, joint.physics)
        FieldPart.hand_over(joint, shell)
        shell.load(record.factor_mechanical, 0.0, None)
        ratio = np.linalg.solve(self.stiffness(shell, shell), self.stiffness(joint, shell))
        values = np.linalg.eigvals(np.eye(len(ratio)) - ratio)
        self.value = float(values[np.argmax(np.abs(values))].real)

    @staticmethod
    def stiffness(system: System, shell: System) -> Any:
        system.linearise()
        matrix = system.tangent()[0].toarray()
        kept = np.zeros(system.unknowns.space.ndof, bool)
        for name in shell.unknowns.names:
            kept[system.unknowns.range(name)] = True
        kept = kept[as_mask(system.unknowns.free())]
        inner = matrix[np.ix_(~kept, ~kept)]
        schur = matrix[np.ix_(kept, ~kept)] @ np.linalg.solve(inner, matrix[np.ix_(~kept, kept)]) if len(inner) else 0.0
        return matrix[np.ix_(kept, kept)] - schur


@pytest.mark.parametrize(
    ("problem", "path", "low", "high"),
    [(grounded_balloon, "path=[{steps = 5}]", 0.7, 0.9), (permeable_sphere, MAGNETISED, -0.7, -0.5)],
)
def test_factor_is_that_of_the_stiffnesses(problem: Any, path: str, low: float, high: float) -> None:
    """Measured on the turns, and computed from the tangents of the joint system and of the shell; a field that holds
    the shell gives a negative one."""
    known = Factor()
    solution = problem.run(*COARSE, path, TURNS, PLAIN, listeners=[known])
    measured = float(solution["contraction"][-1])
    assert low < known.value < high
    assert measured == pytest.approx(known.value, rel=3e-3)
    updates = [iteration.update for iteration in solution.steps[-1].iterations]
    assert updates[-1] / updates[-2] == pytest.approx(abs(known.value), rel=0.02)


def test_divergence_is_named_and_cured() -> None:
    """At 1.5 times the scene's field a turn multiplies errors by -1.3: the shell swings."""
    changes = (*COARSE, "ambient.applied_field=[0, 0, 60e3]", "solver.min_step=1", MAGNETISED)
    swinging = permeable_sphere.scene(*changes, TURNS, PLAIN)
    failed = solve(swinging, throw=False)
    assert failed.result is Result.STAGGERED_DIVERGED
    assert "multiplies the worst error by -1." in failed.message
    assert 'model.coupling = "joint"' in failed.message and "iqn-ils" in failed.message
    joint = permeable_sphere.run(*changes)
    for cure in ("solver.acceleration=iqn-ils", AITKEN):
        cured = permeable_sphere.run(*changes, TURNS, cure)
        assert cured["contraction"][-1] < -1.0
        assert cured["stretch"] == pytest.approx(joint["stretch"], abs=1e-5)


def test_turns_grow_towards_pull_in_and_end_there() -> None:
    limit = grounded_balloon.exact(grounded_balloon.scene()).pull_in()
    assert limit is not None
    changes = (*grounded_balloon.at_voltage(400e3), "path=[{steps = 5}]", "solver.min_step=0.02")
    solution = grounded_balloon.run(*changes, TURNS, throw=False)
    assert solution.result is Result.PULL_IN
    assert solution["voltage"][-1] == pytest.approx(limit.load, rel=5e-3)
    turns = solution["coupling_iterations"]
    assert turns[-1] > 2.5 * turns[0]
    assert 0.85 < solution["contraction"][-1] < 1.0


def stretch_under(force: float) -> float:
    """l of a neo-Hookean membrane sphere under the dead outward force l - l^-5 = ``force`` per reference area."""
    return float(bracketed_root(lambda s: s - s**-5 - force, 1.0, 2.0))


def test_once_in_free_space_is_exact_for_a_sphere() -> None:
    """At a given voltage the pull per reference area, eps V^2 / (2 R^2), is the same at every radius."""
    solution = charged_balloon.run(ONCE, "model.interface=closed", "path=[{steps = 3}]", "discretisation.order=4")
    loads = EPSILON_0 * solution["voltage"] ** 2 / (4.0 * 30e3 * 1e-3 * 0.02)
    assert solution["stretch"] == pytest.approx([stretch_under(load) for load in loads], abs=1e-5)
    assert max(solution["coupling_gap"]) < 1e-3


@pytest.mark.estimated
def test_once_in_a_grounded_sphere() -> None:
    """The pull stays that of the undeformed sphere, w / (1 - 1/4)^2: too small by what the gap says."""
    changes = ("model.interface=closed", "path=[{steps = 4}]", "discretisation.order=4")
    solution = grounded_balloon.run(ONCE, *changes)
    loads = EPSILON_0 * solution["voltage"] ** 2 / (4.0 * 30e3 * 1e-3 * 0.02) / 0.75**2
    stretches = np.array([stretch_under(load) for load in loads])
    assert solution["stretch"] == pytest.approx(stretches, abs=1e-5)
    assert solution["coupling_gap"] == pytest.approx((0.75 / (1 - stretches / 4)) ** 2 - 1, rel=1e-3)
    with unestimated():
        joint = grounded_balloon.run(*changes)
    short = (joint["stretch"][-1] - solution["stretch"][-1]) / joint["stretch"][-1]
    assert solution.errors["stretch"].parts["ambient and coupling"] == pytest.approx(short, rel=0.5)


def test_archive_and_screen_tell_the_turns(tmp_path: Path) -> None:
    screen = io.StringIO()
    with ProgressDisplay(Console(file=screen, width=200)) as display:
        solution: Solution = charged_balloon.run(
            TURNS, *COARSE, "path=[{steps = 2}]", archive=tmp_path / "run.vtkhdf", listeners=[display]
        )
    archive = open_archive(tmp_path / "run.vtkhdf")
    assert archive.scalars["coupling_iterations"] == pytest.approx(solution["coupling_iterations"])
    assert archive.scalars["contraction"] == pytest.approx(solution["contraction"])
    assert f"{len(solution.steps[0].iterations)} turns" in screen.getvalue()


@pytest.mark.parametrize("rung", ["joint", "staggered", "once"])
def test_the_plan_says_the_rung(rung: str) -> None:
    decisions = {one.topic: one for one in explain(charged_balloon.scene(f"model.coupling={rung}")).decisions}
    assert decisions["coupling"].choice == rung
    assert "pinned" in decisions["coupling"].reason


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ((TURNS, "path=[{control = 'arc-length'}]"), "path.0.control: not allowed: with model.coupling"),
        ((ONCE, "path=[{until = {where = [0, 0, 0.02], axis = 'z', value = 1e-3}}]"), "path.0.until: not allowed"),
    ],
)
def test_what_needs_the_joint_tangent_is_refused(changes: tuple[str, ...], words: str) -> None:
    with pytest.raises(SceneError, match="allowed") as refused:
        explain(charged_balloon.scene(*changes))
    assert words in str(refused.value)


def test_without_a_field_there_is_nothing_to_couple() -> None:
    table = tomllib.loads(charged_balloon.scene(TURNS).to_toml())
    bare = Scene.from_table({key: value for key, value in table.items() if key not in ("ambient", "faces")})
    assert "coupling" not in {one.topic for one in explain(bare).decisions}
