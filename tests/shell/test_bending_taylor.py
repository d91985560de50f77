"""Gradients and Hessians of the energies of bending and of the membrane beside it, from distorted states."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from ngsolve import BilinearForm, GridFunction, InnerProduct, Variation

from embedding.shell.kinematics import surface_gradient
from embedding.solving.problem import Problem
from tests.bent import DISC, RUBBER, Table, clamped, mesh, metal, problem_of
from tests.forms import Array, Taylor, close_to, random_directions, set_on_shell, smooth

STRIP: Table = {"kind": "strip", "length": 1.0}
SPHERE: Table = {"kind": "sphere", "radius": 1.0}
MOMENT: Table = {"edge_moments": [{"edge": "rim", "moment": 3e-3}]}
BODIES: dict[str, tuple[Table, str, Table]] = {
    "disc": (DISC, "3d", {"loads": MOMENT}),
    "whole disc": (DISC, "3d", {"model": {"symmetry": "none"}, "supports": clamped("rim")}),
    "octant": (SPHERE, "3d", {}),
    "open cylinder": ({"kind": "cylinder", "radius": 1.0, "length": 1.5}, "3d", {}),
    "branches": ({"kind": "t-section", "length": 1.0}, "3d", {"supports": clamped("bottom")}),
    "axisymmetric disc": (DISC, "axisymmetric", {"loads": MOMENT}),
    "axisymmetric sphere": (SPHERE, "axisymmetric", {}),
    "capped": ({"kind": "cylinder", "radius": 1.0, "length": 2.0, "ends": "capped"}, "axisymmetric", {}),
    "ring": ({"kind": "infinite-cylinder", "radius": 1.0}, "plane-strain", {"model": {"symmetry": "none"}}),
    "strip": (STRIP, "plane-strain", {"loads": {"edge_moments": [{"edge": "x1", "moment": 3e-3}]}}),
}
LAWS: dict[str, Table] = {
    "neo-hookean": RUBBER,
    "mooney-rivlin": {"law": "mooney-rivlin", "c1": 0.4, "c2": 0.1},
    "yeoh": {"law": "yeoh", "c1": 0.5, "c2": -0.005, "c3": 0.2},
    "gent": {"law": "gent", "shear_modulus": 1.0, "limit": 5.0},
    "ogden": {"law": "ogden", "moduli": [1.5, 0.003, -0.025], "exponents": [1.3, 5.0, -2.0]},
    "metal": metal(0.3),
}


def distorted(name: str, material: Table = RUBBER, amount: float = 0.15, **parts: Any) -> Problem:
    """A body that is bent, stretched and given moments of every kind, at 0.7 of its load."""
    shape, reduction, own = BODIES[name]
    parts = {"discretisation": mesh(2, 0.7)} | own | parts
    parts["model"] = {"reduction": reduction} | parts.get("model", {})
    problem = problem_of(shape, 0.1, material, **parts)
    system, unknowns = problem.system, problem.system.unknowns
    system.load(0.7, 1.0, None)
    set_on_shell(unknowns.field("u"), smooth(problem.domain, amount), unknowns.trace.free, problem.domain)
    system.residual()  # rotations are counted from here
    rng = np.random.default_rng(5)
    for part in ("moment", "rotation"):
        if part in unknowns:
            values = unknowns.field(part).vec.FV().NumPy()
            values[:] = 2e-3 * rng.uniform(-1, 1, len(values))
    return problem


def taylor_of(problem: Problem, form: BilinearForm, size: float = 4e-3) -> tuple[Taylor, Any]:
    """Taylor's test of ``form``; moments, which are of the size T^3, move by T^2 of what displacements do."""
    free = np.array(list(problem.system.unknowns.free()))
    directions = random_directions(free, size, count=3)
    if "moment" in problem.system.unknowns:
        directions[:, problem.system.unknowns.range("moment")] *= 0.01
    return Taylor(form, problem.system.unknowns.state.vec, directions), free


def form_of(problem: Problem, terms: list[Any]) -> BilinearForm:
    form = BilinearForm(problem.system.unknowns.space, symmetric=True)
    for term in terms:
        form += Variation(term).Compile()
    return form


def bending_terms(problem: Problem) -> list[Any]:
    system = problem.system
    trial = system.unknowns.trial
    return system.unknowns.bending.energies(trial, system.lagrangian.kinematics(trial), system.factors.mechanical)


def membrane_terms(problem: Problem) -> list[Any]:
    lagrangian, unknowns = problem.system.lagrangian, problem.system.unknowns
    state = lagrangian.kinematics({name: unknowns.field(name) for name in unknowns.names})
    membrane = lagrangian.membrane
    return [lagrangian.measure * membrane.energy(lagrangian.kinematics(unknowns.trial), state) * membrane.integral]


def assert_derivatives(problem: Problem, terms: list[Any]) -> None:
    taylor, free = taylor_of(problem, form_of(problem, terms))
    assert np.linalg.norm(taylor.gradient[free]) > 1e-4
    assert close_to(taylor.gradient_orders(), 2)
    assert close_to(taylor.hessian_orders(), 3)
    assert close_to(taylor.tangent_orders(rows=free), 2)


@pytest.mark.parametrize("name", BODIES)
def test_bending(name: str) -> None:
    """Elements, edges, kinks, branches, moments on edges: of the rubber, whose stiffness depends on the state."""
    problem = distorted(name)
    assert_derivatives(problem, bending_terms(problem))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", ["octant", "axisymmetric sphere", "ring"])
def test_bending_of_every_law(name: str, law: str) -> None:
    problem = distorted(name, LAWS[law])
    assert_derivatives(problem, bending_terms(problem))


@pytest.mark.parametrize("locking", ["cured", "as it is"])
@pytest.mark.parametrize("law", ["neo-hookean", "ogden", "metal"])
@pytest.mark.parametrize("name", ["octant", "axisymmetric sphere", "ring"])
def test_membrane(name: str, law: str, locking: str) -> None:
    problem = distorted(name, LAWS[law], discretisation=mesh(2, 0.7, locking=locking))
    assert_derivatives(problem, membrane_terms(problem))


@pytest.mark.parametrize("name", ["disc", "axisymmetric disc", "strip"])
def test_the_matrix_of_a_shell_under_moments(name: str) -> None:
    """Residual and matrix of everything together, at rotations counted from one state."""
    problem = distorted(name)
    system = problem.system
    system.unknowns.condensed = None
    taylor, free = taylor_of(problem, system.lagrangian.joint_form())
    assert system.symmetric == (name != "disc")
    assert close_to(taylor.tangent_orders(rows=free), 2)


def matrix_of(problem: Problem, update: Array) -> Any:
    """v -> v . K v of the membrane's tangent alone, its stress extrapolated over ``update``."""
    form, state = form_of(problem, membrane_terms(problem)), problem.system.unknowns.state.vec
    with problem.system.lagrangian.membrane.extrapolating(update):
        form.AssembleLinearization(state)
    vector, product = state.CreateVector(), state.CreateVector()

    def curvature(direction: Array) -> float:
        vector.FV().NumPy()[:] = direction
        product.data = form.mat * vector
        return float(direction @ product.FV().NumPy())

    return curvature


@pytest.mark.parametrize("name", ["disc", "octant", "axisymmetric sphere", "ring"])
def test_the_extrapolated_stress_is_that_of_the_second_order_strain(name: str) -> None:
    """v . (K_d - K_0) v = - 1/2 T int D[Grad d^T Grad d] : Grad v^T Grad v, written out for Hooke's law, nu = 0."""
    problem = distorted(name, metal(0.0), discretisation=mesh(2, 0.7, locking="as it is"))
    unknowns = problem.system.unknowns
    rows = unknowns.range("u")
    d, v = random_directions(np.array(list(unknowns.free())), 0.01, count=2, seed=8)
    changed = matrix_of(problem, d[rows])(v) - matrix_of(problem, 0 * d[rows])(v)
    fields = []
    for direction in (d, v):
        field = GridFunction(unknowns.trace.space)
        field.vec.FV().NumPy()[:] = direction[rows]
        fields.append(field)
    squares = [surface_gradient(f).trans * surface_gradient(f) for f in fields]
    work = InnerProduct(*squares)
    if problem.reduction.name == "axisymmetric":
        work = work + problem.reduction.hoop_change(fields[0]) ** 2 * problem.reduction.hoop_change(fields[1]) ** 2
    youngs = problem.system.physics.law.youngs
    expected = -0.5 * youngs * 0.1 * problem.domain.shell_integral(work)
    assert changed == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("name", ["disc", "octant", "axisymmetric disc", "ring"])
def test_the_extrapolated_stress_is_in_the_matrix_alone(name: str) -> None:
    """No residual knows of it, and without an update there is none."""
    problem = distorted(name, discretisation=mesh(2, 0.7, locking="cured"))
    system = problem.system
    rows = system.unknowns.range("u")
    before = np.array(system.residual().FV().NumPy())
    system.forget()
    system.linearise()
    plain = system.form.mat.AsVector().FV().NumPy().copy()
    system._linearised = system._linearised + 0.01 * random_directions(np.ones(rows.stop - rows.start, bool), 1.0)[0]
    system.linearise()
    moved = system.form.mat.AsVector().FV().NumPy().copy()
    system.linearise()
    again = system.form.mat.AsVector().FV().NumPy().copy()
    assert np.abs(moved - plain).max() > 1e-9 * np.abs(plain).max()
    assert np.array_equal(again, plain)
    assert np.array_equal(np.array(system.residual().FV().NumPy()), before)
