"""What a solve goes through step by step: stages, control, cuts, and the state when something stops it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from embedding import (
    Ambient,
    Disc,
    Discretisation,
    Electrode,
    Faces,
    InfiniteCylinder,
    Listener,
    Loads,
    NeoHookean,
    Result,
    Scene,
    SceneError,
    Shell,
    Solver,
    Sphere,
    Stage,
    Support,
)
from embedding.coupling.linear import DirectSolver, LinearSolverError
from embedding.solving import Iteration, Solution, StepRecord, run
from embedding.solving.driver import Run
from embedding.solving.newton import LARGEST_UPDATE, Newton
from embedding.solving.state import State
from problems.exact import cylinder, sphere

pytestmark = pytest.mark.usefixtures("unestimated")

R, MU = 0.02, 1e5


def balloon(*stages: Stage, shape: Any = None, charged: bool = False, **parts: Any) -> Scene:
    """A pressurised shell, with a small voltage if ``charged``."""
    electrode = Electrode(voltage=2e3)
    field = {"ambient": Ambient(field="electric"), "faces": Faces(top=electrode, bottom=electrode)}
    return Scene(
        shell=Shell(shape=shape or Sphere(radius=R), thickness=0.05 * R, material=NeoHookean(shear_modulus=MU)),
        path=stages or (Stage(steps=3),),
        **((field if charged else {}) | {"loads": Loads(pressure_bottom=4e3)} | parts),
    )


class Diary(Listener):
    """Everything a listener is told."""

    def __init__(self) -> None:
        self.told: list[str] = []
        self.records: list[StepRecord] = []
        self.iterations: list[tuple[int, Iteration]] = []
        self.cuts: list[tuple[int, float, str]] = []
        self.state: State | None = None

    def started(self, problem: Any) -> None:
        self.told.append("started")

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        self.told.append("iterated")
        self.iterations.append((step_number, iteration))

    def accepted(self, state: State, record: StepRecord) -> None:
        self.told.append("accepted")
        self.records.append(record)
        self.state = state

    def cut(self, step_number: int, fraction: float, reason: str) -> None:
        self.told.append("cut")
        self.cuts.append((step_number, fraction, reason))

    def finished(self, solution: Solution) -> None:
        self.told.append("finished")


def test_stages_follow_one_another() -> None:
    """Inflated, held while the field comes, let go again: factors run from where they were."""
    scene = balloon(
        Stage(name="inflate", steps=2, field=0.0),
        Stage(name="charge", steps=2),
        Stage(name="half", steps=1, mechanical=0.5, field=0.5),
        charged=True,
    )
    solution = run(scene)
    assert solution.result is Result.CONVERGED
    assert [s.stage for s in solution.steps] == ["inflate", "inflate", "charge", "charge", "half"]
    assert [s.factor_mechanical for s in solution.steps] == [0.5, 1.0, 1.0, 1.0, 0.5]
    assert [s.factor_field for s in solution.steps] == [0.0, 0.0, 0.5, 1.0, 0.5]
    assert [s.number for s in solution.steps] == [1, 2, 3, 4, 5]
    stretch = solution["stretch"]
    assert stretch[0] < stretch[1] < stretch[2] < stretch[3] > stretch[4]


def test_the_way_does_not_matter() -> None:
    """Elastic: the same end in one step, in many, and by way of a larger load."""
    ends = [
        run(balloon(*stages))["stretch"][-1]
        for stages in ((Stage(steps=1),), (Stage(steps=7),), (Stage(steps=3, mechanical=1.4), Stage(steps=2)))
    ]
    assert ends == pytest.approx([ends[0]] * 3, rel=1e-9)


@pytest.mark.parametrize(
    "shape", [Sphere(radius=R), InfiniteCylinder(radius=R), InfiniteCylinder(radius=R, axial_stretch=1.2)]
)
def test_volume_control_from_rest(shape: Any) -> None:
    """A volume is prescribed and the pressure found, beyond the limit point of the sphere as well."""
    end = 2.0
    solution = run(balloon(Stage(steps=4, volume_ratio=end), shape=shape, loads=Loads()))
    assert solution.result is Result.CONVERGED, solution.message
    assert solution["volume_ratio"][-1] == pytest.approx(end, rel=1e-9)
    if isinstance(shape, Sphere):
        expected = sphere.membrane_pressure(end ** (1 / 3), 0.05)
    else:
        stretch = (end / shape.axial_stretch) ** 0.5
        expected = cylinder.membrane_pressure(stretch, 0.05, axial_stretch=shape.axial_stretch)
    assert solution["pressure_difference"][-1] == pytest.approx(MU * expected, rel=1e-4)


def test_volume_then_pressure_control() -> None:
    """The pressure goes on from what the volume needed to what the loads state; top pressure rides along."""
    scene = balloon(
        Stage(name="volume", steps=2, volume_ratio=1.5),
        Stage(name="pressure", steps=2),
        loads=Loads(pressure_bottom=4.6e3, pressure_top=600.0),
    )
    solution = run(scene)
    assert solution.result is Result.CONVERGED, solution.message
    assert solution["volume_ratio"][1] == pytest.approx(1.5, rel=1e-9)
    assert solution["pressure_difference"][-1] == pytest.approx(4e3, rel=1e-12)
    assert solution["stretch"][-1] == pytest.approx(sphere.stretch_at(4e3 / MU, 0.05, theory="membrane"), rel=1e-5)
    top, bottom = solution.pressures
    assert top[-1] == pytest.approx(600.0) and bottom[-1] == pytest.approx(4.6e3)


def test_listeners_are_told_in_order() -> None:
    diary = Diary()
    solution = run(balloon(Stage(steps=2)), [diary])
    assert diary.told[0] == "started" and diary.told[-1] == "finished"
    assert diary.told.count("accepted") == 2 and "cut" not in diary.told
    assert tuple(diary.records) == solution.steps
    for record in diary.records:
        own = tuple(i for number, i in diary.iterations if number == record.number)
        assert own[-len(record.iterations) :] == record.iterations
        assert max(record.iterations[-1].update, record.iterations[-1].residual) < 1e-9
        assert [i.number for i in record.iterations] == list(range(1, len(record.iterations) + 1))


def test_newton_converges_quadratically() -> None:
    """Charged, in the last step, with the ambient at rest: each update is about the square of the one before."""
    record = run(balloon(Stage(steps=3), charged=True)).steps[-1]
    updates = [i.update for i in record.iterations]
    assert len(updates) <= 7
    assert updates[-1] < 50 * updates[-2] ** 2 + 1e-12
    assert updates[-2] < 50 * updates[-3] ** 2 + 1e-12


def test_a_step_that_fails_leaves_the_last_good_state() -> None:
    """Beyond the limit pressure: every cut starts again from what was accepted, and so does who looks at the end."""
    diary = Diary()
    made = Run(balloon(loads=Loads(pressure_bottom=8e3), solver=Solver(min_step=0.05)), [diary])
    solution = made.solve()
    assert solution.result is Result.LIMIT_POINT
    assert diary.cuts and all(0 < fraction < 1 for _, fraction, _ in diary.cuts)
    last = solution.steps[-1].scalars
    assert made.state.scalars()["stretch"] == pytest.approx(last["stretch"], rel=1e-12)
    assert made.state.scalars()["pressure_bottom"] == pytest.approx(last["pressure_bottom"], rel=1e-12)


class Interrupt(Listener):
    """Ctrl-C in the middle of the second step."""

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        if (step_number, iteration.number) == (2, 2):
            raise KeyboardInterrupt


@pytest.mark.estimated
@pytest.mark.parametrize("charged", [False, True])
def test_an_interrupt_leaves_the_last_good_state(charged: bool) -> None:
    made = Run(balloon(Stage(steps=3), charged=charged), [Interrupt()])
    solution = made.solve()
    assert solution.result is Result.INTERRUPTED and len(solution.steps) == 1
    assert solution.error is None and "after 1 accepted step" in solution.message
    assert made.state.scalars()["stretch"] == pytest.approx(solution.steps[0].scalars["stretch"], rel=1e-12)


def test_a_linear_solver_that_fails_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the second step on nothing can be factorised: the first step is kept, the reason is the solver's."""
    solve = DirectSolver.solve
    diary = Diary()

    def fails(self: DirectSolver, right_side: Any, enough: float = 0.0) -> Any:
        if diary.records:
            raise LinearSolverError("the linear system could not be solved (a test)")
        return solve(self, right_side, enough)

    monkeypatch.setattr(DirectSolver, "solve", fails)
    solution = run(balloon(Stage(steps=3), solver=Solver(min_step=0.3)), [diary])
    assert solution.result is Result.LINEAR_SOLVER_FAILED
    assert len(solution.steps) == 1
    assert [reason for _, _, reason in diary.cuts] == ["LINEAR_SOLVER_FAILED"]


def test_too_few_iterations_are_named() -> None:
    solution = run(balloon(Stage(steps=1), solver=Solver(max_iterations=2, min_step=0.5)))
    assert solution.result is Result.STEP_BELOW_MINIMUM
    assert solution.steps == () and "before the first step" in solution.message


def test_wild_updates_are_cut_short() -> None:
    """No update of one iteration is larger than half the shell's size, whatever the matrix says."""
    made = Run(balloon(Stage(steps=1)), ())
    system = made.problem.system
    newton = Newton(system, 1e-9, 1, lambda: (0.0, 0.0))
    system.load(1.0, 0.0, None)
    before = system.unknowns.state.vec.FV().NumPy().copy()
    update = system.newton_update

    def wild(enough: float) -> tuple[Any, float]:
        step, size = update(enough)
        step *= 1e3
        return step, size

    system.newton_update = wild  # type: ignore[method-assign]
    newton.solve(lambda iteration: None)
    taken = system.unknowns.state.vec.CreateVector()
    taken.FV().NumPy()[:] = system.unknowns.state.vec.FV().NumPy() - before
    assert system.displacement_norm(taken) == pytest.approx(LARGEST_UPDATE, rel=1e-9)


def test_nothing_to_do() -> None:
    """No load, no field: the membrane rests, and that is an answer."""
    solution = run(balloon(Stage(steps=2), loads=Loads()))
    assert solution.result is Result.CONVERGED
    assert solution["stretch"] == pytest.approx([1.0, 1.0], abs=1e-12)
    assert solution["elastic_energy"] == pytest.approx([0.0, 0.0], abs=1e-15)


def test_a_rest_before_the_load() -> None:
    """A first stage without load accepts the stress-free state; the load after it must still be found."""
    path = (Stage(name="rest", steps=1, mechanical=0.0), Stage(name="load", steps=4))
    held, loads = (Support(where="rim", fix=("x", "y", "z")),), Loads(pressure_bottom=1e3)
    direct, rested = (
        run(balloon(*stages, shape=Disc(radius=R), supports=held, loads=loads)) for stages in (path[1:], path)
    )
    assert direct.result is Result.CONVERGED
    assert rested.result is Result.CONVERGED, rested.message
    assert rested["stretch"][-1] == pytest.approx(direct["stretch"][-1], rel=1e-9)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"shape": InfiniteCylinder(radius=R, axial="free"), "stages": (Stage(volume_ratio=2.0),)}, 'axial = "free"'),
        ({"stages": (Stage(volume_ratio=2.0),), "loads": Loads(variant="as-published")}, "as-published"),
    ],
)
def test_what_is_not_modelled_is_refused(parts: dict[str, Any], words: str) -> None:
    stages = parts.pop("stages")
    with pytest.raises(SceneError, match=words):
        run(balloon(*stages, **parts))


def test_scalars_have_histories() -> None:
    solution = run(balloon(Stage(steps=3)))
    assert isinstance(solution["stretch"], np.ndarray) and solution["stretch"].shape == (3,)
    with pytest.raises(KeyError, match="there are stretch"):
        _ = solution["strech"]


def test_the_cost_is_stated() -> None:
    cost = run(balloon(Stage(steps=1), charged=True, discretisation=Discretisation(order=2))).cost
    assert cost.wall_seconds > 0 and cost.cpu_seconds > 0 and cost.peak_memory_bytes > 1e6
    assert set(cost.parts) == {"ambient motion", "potential", "joint"}
    assert cost.unknowns["u"] > 0 and cost.unknowns["phi"] > 0
