"""p_t and p_b on a charged conductor: two numbers in every Newton step, right on both faces at convergence."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from ngsolve import IntegrationRule

from embedding import Listener, Solution
from embedding.scene.scales import EPSILON_0
from embedding.solving.events import Iteration, StepRecord
from embedding.solving.state import State
from problems import charged_balloon, grounded_balloon
from problems.common import Array
from problems.permeable_sphere import FieldTractions

THIRD_ORDER = ("discretisation.order=3", "discretisation.shell_size=1 mm")
FOURTH_ORDER = ("discretisation.order=4",)
STEPS = "path=[{steps = 4}]"
RADIUS = 0.02


@cache
def charged(*changes: str) -> Solution:
    return charged_balloon.run(*changes)


def face_radius(solution: Solution, ratio: float) -> Array:
    """Outer face of the shell, at T lambda / 2 beyond the mid-surface, with lambda = 1 / l^2."""
    stretch = solution["stretch"]
    return RADIUS * (stretch + 0.5 * ratio / stretch**2)


def pull(solution: Solution, face: Array) -> Array:
    """-eps0 (V / b)^2 / 2 on the outer face at b, in free space."""
    return -0.5 * EPSILON_0 * (solution["voltage"] / face) ** 2


@pytest.mark.parametrize("ratio", [0.1, 0.05])
@pytest.mark.parametrize(("mesh", "tolerance"), [(THIRD_ORDER, 1e-5), (FOURTH_ORDER, 1e-6)])
def test_closed_form_on_both_faces(ratio: float, mesh: tuple[str, ...], tolerance: float) -> None:
    solution = charged(*charged_balloon.at(ratio, 1.2), *mesh, STEPS)
    top, bottom = solution.pressures
    assert top == pytest.approx(pull(solution, face_radius(solution, ratio)), rel=tolerance)
    assert np.abs(bottom).max() < 1e-15 * np.abs(top).max(), "no field inside a closed conductor"


def test_second_order_against_the_true_face() -> None:
    """The thick wall's own outer face is where the shell's is up to T^2, and so are the pressures."""
    errors = []
    for ratio in (0.1, 0.05):
        solution = charged(*charged_balloon.at(ratio, 1.2), *FOURTH_ORDER, STEPS)
        shell = charged_balloon.exact(solution.scene)
        faces = np.array([shell.face_radius(float(stretch)) for stretch in solution["stretch"]])
        errors.append(float(np.abs(solution["pressure_top"] / pull(solution, faces) - 1.0).max()))
    assert errors[0] < 1.3e-3
    assert math.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_closed_interface_recovers_the_pressure_from_nodal_forces() -> None:
    solution = charged("model.interface=closed", *FOURTH_ORDER, STEPS)
    top, bottom = solution.pressures
    assert top == pytest.approx(pull(solution, RADIUS * solution["stretch"]), rel=1e-5)
    assert np.abs(bottom).max() < 1e-12 * np.abs(top).max()


def test_grounded() -> None:
    """E = V / (b (1 - b / R_o)): in both modes the face is pulled harder than in free space."""
    solution = grounded_balloon.run(*FOURTH_ORDER)
    face = face_radius(solution, 0.05)
    top, bottom = solution.pressures
    assert top == pytest.approx(pull(solution, face * (1.0 - face / 0.08)), rel=1e-6)
    assert np.abs(bottom).max() < 1e-15 * np.abs(top).max()


class Watch(Listener):
    """Every Newton step as it is told, by load step."""

    def __init__(self) -> None:
        self.told: dict[int, list[Iteration]] = {}

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        self.told.setdefault(step_number, []).append(iteration)


@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_recorded_in_every_newton_step(interface: str) -> None:
    """Also with air inside: the face pressures are total ones, the mechanical part known, the field's found."""
    watch = Watch()
    changes = ("loads.pressure_bottom=600", f"model.interface={interface}", "path=[{steps = 3}]")
    solution = charged_balloon.run(*charged_balloon.at(0.05, 1.1), *changes, listeners=[watch])
    assert len(solution.steps) == 3
    for step in solution.steps:
        assert watch.told[step.number] == list(step.iterations)
        assert len(step.iterations) >= 3
        top = np.array([iteration.pressure_top for iteration in step.iterations])
        bottom = np.array([iteration.pressure_bottom for iteration in step.iterations])
        assert np.all(top < 0.0), "pulled outside"
        assert bottom == pytest.approx(600.0 * step.factor_mechanical, rel=1e-4), "pushed inside"
        assert bottom[-1] == pytest.approx(600.0 * step.factor_mechanical, rel=1e-12)
        # They are unknowns: they settle with the rest of the system, as fast as Newton's method does.
        changes_of_top = np.abs(np.diff(top))
        assert changes_of_top[0] > 1e-3 * abs(top[-1])
        assert changes_of_top[-1] < 1e-6 * abs(top[-1])
        assert (step.scalars["pressure_top"], step.scalars["pressure_bottom"]) == (top[-1], bottom[-1])
    assert solution.pressures[0].tolist() == solution["pressure_top"].tolist()
    assert solution.pressures[1].tolist() == solution["pressure_bottom"].tolist()


class Everywhere(Listener):
    """Extreme values over the shell of the fields p_t and p_b, in Pa, at the last step."""

    def __init__(self) -> None:
        self.extremes: dict[str, tuple[float, float]] = {}

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        ends = IntegrationRule([(0.0,), (0.5,), (1.0,)], [1.0, 1.0, 1.0])  # the poles are ends of elements
        points = problem.mesh.MapToAllElements(ends, problem.blocks["shell"].region)
        for field in state.fields():
            if field.name in ("p_t", "p_b"):
                values = np.asarray(field.values(points))
                self.extremes[field.name] = (float(values.min()), float(values.max()))


@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_pressures_are_uniform_and_normal(interface: str) -> None:
    """A conductor's faces feel no tangential traction, and on a sphere the pressure is the same all over."""
    everywhere, tractions = Everywhere(), FieldTractions()
    changes = (f"model.interface={interface}", *FOURTH_ORDER, "path=[{steps = 2}]")
    solution = charged_balloon.run(*charged_balloon.at(0.05, 1.2), *changes, listeners=[everywhere, tractions])
    mean = solution["pressure_top"][-1]
    assert everywhere.extremes["p_t"] == pytest.approx((mean, mean), rel=2e-3)
    assert everywhere.extremes["p_b"] == pytest.approx((0.0, 0.0), abs=1e-12 * abs(mean))
    assert np.abs(tractions.values["tau_t"]).max() < 2e-3 * abs(mean)
    assert np.sqrt(np.mean(tractions.values["tau_t"] ** 2)) < 2e-4 * abs(mean)


@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_face_forces_sum_to_zero(interface: str) -> None:
    """A lone charge pulls itself nowhere. The scale is the pull on half of it, p pi b^2; the rest is the mesh's."""
    found = []
    for mesh in ((), FOURTH_ORDER):
        solution = charged(f"model.interface={interface}", *mesh, STEPS)
        half = np.abs(solution["pressure_top"]) * math.pi * face_radius(solution, 0.05) ** 2
        found.append(float(np.abs(solution["force_z"] / half).max()))
    assert found[0] < 5e-5
    assert found[1] < 1e-6


@pytest.mark.slow
def test_face_forces_sum_to_zero_in_3d() -> None:
    """Nothing is mirrored here: three components, on a mesh without any symmetry."""
    changes = ("model.reduction=3d", "model.symmetry=none", "discretisation.shell_size=10 mm", "path=[{steps = 2}]")
    solution = charged_balloon.run(*charged_balloon.at(0.1, 1.2), *changes)
    half = np.abs(solution["pressure_top"]) * math.pi * face_radius(solution, 0.1) ** 2
    for axis in "xyz":
        assert np.abs(solution[f"force_{axis}"] / half).max() < 5e-5
