"""The joint form: its residual is a gradient, its matrix the derivative of the residual, in every kind of scene."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import BilinearForm, InnerProduct, Variation

from embedding.coupling.lagrangian import ANCHOR, OFFSET
from embedding.geometry.spaces import Mask
from embedding.solving.problem import Problem
from tests.coupling.scenes import FACES, coupled, distort
from tests.forms import Taylor, close_to, random_directions

CASES = [
    *(("axisymmetric", faces, interface) for faces in FACES for interface in ("opened", "closed")),
    *(("3d", faces, "auto") for faces in ("conductor", "film", "bare")),
    *(("plane-strain", faces, "auto") for faces in ("conductor", "top", "bare")),
]


def taylor_of(problem: Problem, size: float = 0.003, count: int = 3) -> tuple[Taylor, Mask]:
    system = problem.system
    free = np.asarray(system._solver.mask)
    return Taylor(system.form, system.unknowns.state.vec, random_directions(free, size, count=count)), free


@pytest.mark.parametrize(("reduction", "faces", "interface"), CASES)
def test_the_matrix_is_the_derivative_of_the_residual(reduction: str, faces: str, interface: str) -> None:
    problem = coupled(reduction, faces, interface)
    distort(problem)
    taylor, free = taylor_of(problem)
    assert np.linalg.norm(taylor.gradient[free]) > 1e-3
    assert close_to(taylor.tangent_orders(rows=free), 2)


@pytest.mark.parametrize("controlled", [True, False])
def test_volume_control(controlled: bool) -> None:
    """With the pressure as an unknown, free or held."""
    problem = coupled("axisymmetric", "conductor", controlled=True)
    distort(problem, volume=1.4 if controlled else None)
    taylor, free = taylor_of(problem)
    assert close_to(taylor.tangent_orders(rows=free), 2)


@pytest.mark.parametrize("reduction", ["axisymmetric", "plane-strain"])
def test_loads_without_a_potential(reduction: str) -> None:
    """Pressures that vary over the surface make the matrix unsymmetric, and it is still the derivative."""
    problem = coupled(reduction, varying=True)
    assert not problem.system.symmetric
    distort(problem)
    taylor, free = taylor_of(problem)
    assert close_to(taylor.tangent_orders(rows=free), 2)


@pytest.mark.parametrize(("reduction", "faces", "interface"), CASES)
def test_the_residual_is_a_gradient(reduction: str, faces: str, interface: str) -> None:
    """The matrix is symmetric: a . K b = b . K a, K applied as the derivative of the residual."""
    problem = coupled(reduction, faces, interface)
    assert problem.system.symmetric
    distort(problem)
    taylor, free = taylor_of(problem, size=1e-4, count=2)
    (a, b), kicks = taylor.directions, []
    for direction in (a, b):
        kicks.append(0.5 * (taylor.residual(direction) - taylor.residual(-direction)))
    assert float(a @ kicks[1]) == pytest.approx(float(b @ kicks[0]), rel=1e-5)


@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_the_residual_is_the_gradient_of_the_written_lagrangian(interface: str) -> None:
    """L put together again from its parts: elastic energy, pressure times volume, faces, field; then differentiated.

    Everything but the anchors and the rigid motions is written out here.
    """
    problem = coupled("axisymmetric", "bare", interface)
    distort(problem)
    system, lagrangian = problem.system, problem.system.lagrangian
    unknowns, physics, measure = system.unknowns, system.physics, problem.reduction.measure
    trial = unknowns.trial
    surface = problem.domain.surface()
    kinematics = lagrangian.kinematics(trial)
    u = trial["u"].Trace()
    form = BilinearForm(unknowns.space)
    form += Variation(measure * physics.thickness * physics.law.energy(kinematics) * surface)
    pressure = 0.6 * (physics.loads.pressure_top - physics.loads.pressure_bottom)
    volume = InnerProduct(problem.reduction.position + u, kinematics.area_vector) / 3
    form += Variation(measure * pressure * volume * surface)
    for face, offset in OFFSET.items() if interface == "opened" else ():
        place = u + offset * physics.thickness * kinematics.director - trial[f"y_{face}"].Trace()
        form += Variation(measure * InnerProduct(trial[f"tau_{face}"].Trace(), place) * surface)
    for term in lagrangian.field_energies(trial):
        form += Variation(-1 * term)
    for i, motion in enumerate(unknowns.rigid):
        form += Variation(measure * trial[f"rigid{i}"] * InnerProduct(motion, u) * surface)
    written, ours = taylor_of(problem)[0], Taylor(form, unknowns.state.vec, taylor_of(problem)[0].directions)
    assert close_to(ours.gradient_orders(), 2)
    free = np.asarray(system._solver.mask)
    scale = np.abs(ours.gradient[free]).max()
    assert np.abs((written.gradient - ours.gradient)[free]).max() < 1e-12 * scale


def test_the_anchors_are_in_the_matrix_alone() -> None:
    """At the state's own vector they are no force; in the matrix they are ANCHOR times the mass on the faces."""
    problem = coupled("axisymmetric", "conductor", "opened")
    distort(problem)
    system, unknowns = problem.system, problem.system.unknowns
    form = BilinearForm(unknowns.space)
    measure = problem.reduction.measure
    for face in ("t", "b"):
        for name, sign in ((f"tau_{face}", 1.0), (f"y_{face}", -1.0)):
            product = InnerProduct(unknowns.trial[name].Trace(), unknowns.test[name].Trace())
            form += sign * ANCHOR * measure * product * problem.domain.surface()
    direction = random_directions(np.asarray(system._solver.mask), 0.01, count=1)
    own = Taylor(system.form, unknowns.state.vec, direction)
    # Moved to the displaced state, with the state itself moved along, the anchors vanish: only then is the residual
    # the physical one.
    h = 1e-4
    state = unknowns.state.vec.FV().NumPy()
    start = state.copy()
    state[:] = start + h * direction[0]
    physical = own.residual(h * direction[0])
    state[:] = start
    with_anchor = own.residual(h * direction[0])
    anchors = Taylor(form, unknowns.state.vec, direction)
    expected = h * anchors.curvatures[0]
    assert np.linalg.norm(expected) > 0
    assert np.abs(with_anchor - physical - expected).max() < 1e-6 * np.abs(expected).max() + 1e-15


def test_faces_lie_half_a_thickness_away() -> None:
    """After ``place_faces``: y - u = +- (T/2) lambda n, to the accuracy of the interpolation."""
    problem = coupled("axisymmetric", "film", "opened", order=4, size=0.2)
    distort(problem)
    system, domain = problem.system, problem.domain
    values: dict[str, Any] = {name: system.unknowns.field(name) for name in system.unknowns.names}
    director = system.lagrangian.kinematics(values).director
    for face, sign in (("t", 0.5), ("b", -0.5)):
        gap = values[f"y_{face}"] - values["u"] - sign * 0.1 * director
        assert domain.shell_integral(InnerProduct(gap, gap)) ** 0.5 < 1e-4 * 0.05 * domain.shell_integral(1.0) ** 0.5
