"""Permeable sphere in a uniform field: exact tractions on a rigid shell; balances of energy and force on a soft one."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF, IfPos, InnerProduct, Integrate, ds, sqrt

from embedding import Listener, Solution
from embedding.scene.scales import MU_0
from embedding.shell.kinematics import surface_gradient
from embedding.solving.events import StepRecord
from embedding.solving.problem import Problem
from embedding.solving.state import State
from problems import permeable_sphere
from problems.common import thickness_ratio
from problems.exact.permeable_sphere import PermeableSphere
from problems.exact.permeable_sphere import permeable_sphere as exact_sphere
from problems.permeable_sphere import COMPONENTS, FINE, FieldTractions, rigid, rigid_error
from tests.problems.measures import orders
from tests.problems.shared_runs import permeable_in_3d

FLOOR = 1e-5  # of the discretisation, with FINE
HELD = "supports=[{where = 'surface', fix = ['x', 'y', 'z']}]"


# -- a shell too stiff to deform, against the exact solution


class PotentialJump(Listener):
    """phi_t - phi_b over phi's scale H0 R at the pole, read from the unknowns of the system."""

    def __init__(self) -> None:
        self.at_pole = math.nan

    def accepted(self, state: State, record: StepRecord) -> None:
        system = state.problem.system
        assert system.physics.field is not None
        pole = state.problem.mesh(0.0, 1.0, 0.0, BND)
        self.at_pole = system.unknowns.field("jump")(pole) / system.physics.field.applied[-1]


@cache
def finely_solved(ratio: float, permeability: float) -> tuple[Solution, FieldTractions, PotentialJump]:
    found, jump = FieldTractions(), PotentialJump()
    return permeable_sphere.run(*rigid(ratio, permeability), *FINE, listeners=[found, jump]), found, jump


def fine_error(ratio: float, permeability: float) -> dict[str, float]:
    solution, found, _ = finely_solved(ratio, permeability)
    return permeable_sphere.error(solution.scene, found)


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3])
@pytest.mark.parametrize("component", COMPONENTS)
def test_tractions_are_of_second_order(permeability: float, component: str) -> None:
    coarse, fine = (fine_error(ratio, permeability)[component] for ratio in (0.1, 0.05))
    assert coarse < 4e-3
    if (permeability, component) == (1e3, "p_t"):
        # Close to the ideal body, p_t = -9/2 mu0 H0^2 cos^2 whatever T. Only the deviation from it, R / (mu_r T), has
        # an error of relative order T^2: together T / (mu_r R), very small and of first order.
        assert coarse < 0.4 * 0.1 / permeability
        assert fine < 0.4 * 0.05 / permeability
    else:
        assert fine < max(0.3 * coarse, FLOOR)


def test_second_order_goes_on() -> None:
    ratios = (0.1, 0.05, 0.025)
    errors = [max(fine_error(ratio, 10.0).values()) for ratio in ratios]
    assert min(orders(ratios, errors)) > 1.9


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3])
def test_the_faces_are_told_apart(permeability: float) -> None:
    found = FieldTractions()
    permeable_sphere.run(*rigid(0.05, permeability), listeners=[found])
    top, bottom = found.values["p_t"], found.values["p_b"]
    assert np.sqrt(np.mean((top - bottom) ** 2)) > 0.1 * np.sqrt(np.mean(top**2))
    assert np.abs(found.values["tau_t"]).max() > 1e-3 * np.abs(top).max(), "more than a pressure"


@pytest.mark.parametrize("permeability", [2.0, 10.0])
def test_a_held_shell_feels_the_same(permeability: float) -> None:
    stiff, held = FieldTractions(), FieldTractions()
    permeable_sphere.run(*rigid(0.05, permeability), listeners=[stiff])
    permeable_sphere.run(*rigid(0.05, permeability), "shell.material.shear_modulus=30 kPa", HELD, listeners=[held])
    for name in COMPONENTS:
        scale = np.abs(stiff.values[name]).max()
        assert held.values[name] == pytest.approx(stiff.values[name], abs=1e-5 * scale)


def test_a_nearly_ideal_shield() -> None:
    """mu_r = 1e6: the cavity's field, 1e-5 of the applied one, and the tractions it brings are of second order. On the
    outside the tangential traction is 1e-5 of the normal one; there both are at the floor of the mesh."""
    errors: list[dict[str, float]] = []
    for ratio in (0.1, 0.05):
        found = FieldTractions()
        changes = (*rigid(ratio, 1e6), "shell.material.shear_modulus=30 kPa", HELD, *FINE)
        stated = permeable_sphere.run(*changes, listeners=[found]).scene
        exact = permeable_sphere.reference(stated, found.theta)
        tangential = np.sqrt(np.mean((found.values["tau_t"] - exact["tau_t"]) ** 2) / np.mean(exact["p_t"] ** 2))
        inner = permeable_sphere.inner_field(found) / permeable_sphere.exact(stated).inner_field - 1.0
        errors.append(permeable_sphere.error(stated, found) | {"tau_t": float(tangential), "inner field": abs(inner)})
    coarse, fine = errors
    assert max(error[name] for error in errors for name in ("p_t", "tau_t")) < 1e-6
    for name in ("p_b", "tau_b", "inner field"):
        assert coarse[name] < 4e-3 and fine[name] < 0.3 * coarse[name]


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3])
def test_the_potential_jumps_by_what_the_shell_holds(permeability: float) -> None:
    """Second order while mu_r T is small against R.

    Where it is large, B_n grows through the wall from nothing to its outer value instead of being constant: by the
    curvature that changes the jump by T / (3 R) of itself. The jump is then so small that the tractions do not see it.
    """
    ratios, errors = (0.1, 0.05), []
    for ratio in ratios:
        jump = finely_solved(ratio, permeability)[2]
        shell = exact_sphere(ratio, permeability)
        known = shell.potential(shell.outer_radius, 0.0) - shell.potential(shell.inner_radius, 0.0)
        errors.append(abs(jump.at_pole / known - 1.0))
        assert errors[-1] < 0.35 * ratio
    assert permeability > 2.0 or orders(ratios, errors)[0] > 1.85


@pytest.mark.slow
def test_tractions_in_3d() -> None:
    coarse, fine = (rigid_error(0.1, 10.0, "model.reduction=3d", f"discretisation.shell_size={h} mm") for h in (8, 5))
    assert max(fine.values()) < 3e-3
    assert all(fine[name] < 0.4 * coarse[name] for name in COMPONENTS)


# -- the soft balloon


class Balance(Listener):
    """What enters the balances, dimensionless (mu0 = 1, lengths in R, stresses in mu), one entry a step."""

    def __init__(self) -> None:
        self.columns: dict[str, list[float]] = {}

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        field = problem.system.physics.field
        assert field is not None
        row = {
            "applied": record.factor_field * field.applied[-1],
            "elastic": record.scalars["elastic_energy"] / problem.scales.energy,
            "pressure": record.scalars["pressure_difference"] / problem.scales.stress,
            "volume": state.volume,
        }
        row |= {"moment": moment(problem, row["applied"]), "pull": pull_on_upper_half(problem)}
        for name, value in (row | equator(state)).items():
            self.columns.setdefault(name, []).append(value)

    def __getitem__(self, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
        return np.array(self.columns[name])


def moment(problem: Problem, applied: float) -> float:
    """Magnetic moment m from the far field, phi = -H0 z + m cos(theta) / (4 pi r^2) on the outer boundary."""
    domain = problem.domain
    height = domain.reduction.position[domain.mesh.dim - 1]
    excess = problem.system.unknowns.field("phi") + applied * height
    density = domain.reduction.measure * excess * height / domain.sizes.radius
    return 3.0 * float(Integrate(density * ds("outer", bonus_intorder=4), domain.mesh))


def pull_on_upper_half(problem: Problem) -> float:
    """Force along z of the field on both faces above the equator."""
    domain = problem.domain
    axis = domain.mesh.dim - 1
    above = IfPos(domain.reduction.position[axis], 1.0, 0.0)
    density = sum(domain.reduction.measure * above * face.tau[axis] for face in problem.system.tractions.values())
    return -float(Integrate(density * ds("shell", bonus_intorder=60), domain.mesh))


def equator(state: State) -> dict[str, float]:
    """At the equator: hoop and meridian stretch, H^2 in the shell, mean pressure of the field weighted by area."""
    system, k = state.problem.system, state.mid_surface
    top, bottom = system.tractions["t"].tau, system.tractions["b"].tau
    mean_gradient = surface_gradient(system.unknowns.field("phi")) + 0.5 * surface_gradient(
        system.unknowns.field("jump")
    )
    inside = k.inverse_transpose * mean_gradient
    values = {
        "hoop": k.hoop,
        "meridian": sqrt(InnerProduct(k.deformation_gradient, k.deformation_gradient)),
        "squared_field": InnerProduct(inside, inside),
        "mean_pressure": 0.5 * k.thickness_stretch * InnerProduct(top - bottom, k.normal),
    }
    point = state.problem.mesh(1.0, 0.0, 0.0, BND)
    return {name: float(CF(value)(point)) for name, value in values.items()}


@cache
def soft(*changes: str) -> tuple[Solution, Balance]:
    found = Balance()
    return permeable_sphere.run(*changes, listeners=[found]), found


@pytest.mark.parametrize(("mesh", "tolerance"), [((), 2.5e-5), (FINE, 3e-7)])
def test_energy_balance(mesh: tuple[str, ...], tolerance: float) -> None:
    """The elastic energy is the work of the air and of the field, and the latter is seen from far away.

    In a field H0 of fixed sources the energy of a linear body is U = -mu0 m H0 / 2 at its moment m, and the work of
    the field's forces is -dU at held H0 (Landau and Lifshitz, Electrodynamics of Continuous Media, sec. 11 and 32).
    At held shape U goes with H0^2, so dU/dH0 = -mu0 m and on the path d(work) = -dU - mu0 m dH0:

        E_elastic - E_start - p (V - V_start) = mu0 m H0 / 2 - mu0 int m dH0.

    m comes from the potential on the outer boundary alone; m / H0 is even in H0, so it is integrated as a polynomial
    of H0^2 through the steps.
    """
    _, found = soft(*mesh)
    start = int(np.flatnonzero(found["applied"] == 0.0)[-1])
    applied, m = found["applied"][start + 1 :], found["moment"][start + 1 :]
    elastic, volume = found["elastic"][start:], found["volume"][start:]
    stored = elastic[1:] - elastic[0] - found["pressure"][start] * (volume[1:] - volume[0])
    fit = np.polynomial.Polynomial.fit(applied**2, m / applied, len(applied) - 1)
    # int m dH0 = int (m / H0) d(H0^2) / 2
    integral = fit.integ(lbnd=0.0)
    work = 0.5 * m * applied - 0.5 * integral(applied**2)
    assert stored[-1] > 5e-3, "there is something to balance"
    assert stored == pytest.approx(work, abs=tolerance * work[-1])


@pytest.mark.parametrize(("mesh", "tolerance"), [((), 1e-4), (FINE, 1e-5)])
def test_balance_of_forces_on_the_upper_half(mesh: tuple[str, ...], tolerance: float) -> None:
    """Cut along the equator: the tension of the cut carries the field's pull on the upper half and the air's push.

    At the equator the field is tangential (phi is odd in z), so the stress of the field inside the shell is mu_r mu0
    H^2 / 2 along the meridian and minus that across the thickness, where the total stress is minus the mean pressure
    p_m on the faces. With the membrane's mu (l_m^2 - l_3^2) the total along the meridian is

        s = mu (l_m^2 - l_3^2) + mu_r mu0 H^2 - p_m,          pull + p pi r^2 = 2 pi r (l_3 T) s.

    The air's part of p_m and its push on the true bottom face, pi (r - l_3 T / 2)^2, make pi r^2 to the shell's order.
    """
    solution, found = soft(*mesh)
    ratio = thickness_ratio(solution.scene)
    permeability = solution.scene.shell.relative_permeability
    assert permeability is not None
    hoop, meridian = found["hoop"], found["meridian"]
    thin = 1.0 / (hoop * meridian)
    stress = meridian**2 - thin**2 + permeability * found["squared_field"] - found["mean_pressure"]
    tension = 2.0 * math.pi * hoop * thin * ratio * stress
    push = found["pressure"] * math.pi * hoop**2
    assert found["pull"][-1] > 0.3 * tension[-1], "the field does much of it"
    assert found["pull"] + push == pytest.approx(tension, rel=tolerance)


def test_no_force_on_the_whole_shell() -> None:
    """A uniform field pulls on both halves alike; the tractions of the two faces add up to no force."""
    coarse, fine = soft()[0], soft(*FINE)[0]
    pull = soft(*FINE)[1]["pull"][-1] * fine.scales.force
    assert abs(coarse["force_z"][-1]) < 1e-5 * pull
    assert abs(fine["force_z"][-1]) < 3e-7 * pull


def test_the_field_draws_the_balloon_out() -> None:
    solution, found = soft(*FINE)
    assert found["hoop"][-1] < 1.08 < 1.13 < found["hoop"][3], "thinner at the equator"
    assert solution["stretch_max"][-1] > 1.24
    assert solution["pressure_difference"][3:] == pytest.approx(1400.0)
    assert np.all(np.abs(solution["pressure_top"] - solution["pressure_bottom"]) > 300.0)


@pytest.mark.slow
def test_soft_balloon_in_3d() -> None:
    """Fewer steps end in the same state; mean pressures are compared on the scale of the air's."""
    flat, solid = soft(*FINE)[0], permeable_in_3d()
    for name, tolerance in {"stretch": 2e-5, "volume_ratio": 1e-4, "stretch_max": 5e-4, "stretch_min": 5e-4}.items():
        assert solid[name][-1] == pytest.approx(flat[name][-1], abs=tolerance)
    for name in ("pressure_top", "pressure_bottom"):
        assert solid[name][-1] == pytest.approx(flat[name][-1], abs=1e-4 * 1400.0)


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3, 1e6])
def test_field_in_the_cavity(permeability: float) -> None:
    """Second order in the thickness, down to a shielding of which the mesh and the solver leave 1e-5 of H0."""
    ratios, errors = (0.1, 0.05), []
    for ratio in ratios:
        solution, found, _ = finely_solved(ratio, permeability)
        ambient = solution.scene.ambient
        assert ambient is not None
        applied, exact = ambient.uniform_field[2], exact_sphere(ratio, permeability).inner_field
        errors.append(abs(permeable_sphere.inner_field(found) / applied - exact))
        assert errors[-1] < max(0.3 * ratio**2 * exact, 1e-5)
    assert permeability == 1e6 or errors[1] < 0.5 * errors[0]


GRADIENT = "ambient.applied_field={expression=['-0.5e6*x', '-0.5e6*y', '4e4 + 1e6*z'], unit='A/m'}"


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3])
def test_force_in_a_field_gradient(permeability: float) -> None:
    """mu0 m dH/dz with the moment m in the uniform part of the field, exactly: a linear part has no moment."""
    ratios, errors = (0.1, 0.05), []
    for ratio in ratios:
        solution = permeable_sphere.run(*rigid(ratio, permeability), GRADIENT, "ambient.radius=160 mm", *FINE)
        radius = solution.scene.shell.shape.size
        sphere = PermeableSphere(radius * (1 - ratio / 2), radius * (1 + ratio / 2), permeability, 4e4, MU_0)
        errors.append(abs(solution["force_z"][-1] / (MU_0 * sphere.moment * 1e6) - 1.0))
    assert errors[0] < 1e-3
    assert errors[1] < 3e-4
