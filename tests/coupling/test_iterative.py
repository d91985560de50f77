"""Iterative solvers: the answers of the direct ones, in a number of iterations that neither mesh, order, contrast nor
deformation changes much; what they cannot do is a typed error with numbers."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from netgen.geom2d import unit_square
from ngsolve import H1, BilinearForm, InnerProduct, Mesh, dx, grad

from embedding import Solver
from embedding.ambient.inverse import LARGE, Inverter, iterates
from embedding.ambient.krylov import gmres
from embedding.coupling.iterative import JointSolver, PotentialSolver
from embedding.coupling.linear import DirectSolver, LinearSolverError
from embedding.coupling.system import System
from embedding.solving.problem import Problem
from tests.coupling.scenes import coupled, distort

FEW = 16
"""Iterations of conjugate gradients that gain ten digits: as many as a condition number of 2.6 takes (Saad, Iterative
Methods for Sparse Linear Systems, 2003, equation 6.128)."""


def iterating(*arguments: Any, **options: Any) -> Problem:
    return coupled(*arguments, solver=Solver(linear="iterative"), **options)


def with_matter(problem: Problem, contrast: float, thickness: float) -> System:
    physics = problem.system.physics
    assert physics.field is not None
    field = replace(physics.field, matter=replace(physics.field.matter, contrast=contrast))
    return System(problem.domain, replace(physics, field=field, thickness=thickness), "iterative")


def potential_iterations(system: System) -> int:
    assert system.potential is not None
    system.load(1.0, 1.0, None)
    system.potential.solve()
    return system.iterations[0]


def test_the_software_chooses_by_size_and_can_be_told() -> None:
    for dimension, large in LARGE.items():
        assert [iterates("auto", n, dimension) for n in (large, large + 1)] == [False, True]
    assert iterates("iterative", 1, 2) and not iterates("direct", 10**7, 3)
    for problem, kind in ((iterating(), JointSolver), (coupled(), DirectSolver)):
        assert isinstance(problem.system._linear_solver(()), kind)


@pytest.mark.parametrize(("order", "size"), [(1, 0.6), (2, 0.6), (3, 0.6), (4, 0.6), (2, 0.25)])
def test_iterations_depend_neither_on_order_nor_on_mesh(order: int, size: float) -> None:
    assert potential_iterations(iterating("3d", "bare", order=order, size=size).system) <= FEW


def test_iterations_do_not_depend_on_contrast() -> None:
    """From a shell that keeps the field out, over one that guides it, to one that is as good as a conductor."""
    problem = iterating("3d", "bare", size=0.4)
    for contrast, thickness in ((1e-3, 0.1), (1e-3, 1e-4), (1e4, 0.1), (1e8, 0.1), (1e8, 1e-4)):
        assert potential_iterations(with_matter(problem, contrast, thickness)) <= FEW, (contrast, thickness)


@pytest.mark.parametrize(
    ("reduction", "faces"),
    [
        ("3d", "conductor"),
        pytest.param("3d", "bare", marks=pytest.mark.slow),
        ("axisymmetric", "film"),
        ("axisymmetric", "bare"),
        ("plane-strain", "top"),
    ],
)
def test_potential_and_update_are_those_of_the_direct_solvers(reduction: str, faces: str) -> None:
    direct, iterative = coupled(reduction, faces), iterating(reduction, faces)
    for problem in (direct, iterative):
        distort(problem)
    (found, _), (known, _) = (problem.system.newton_update() for problem in (iterative, direct))
    alone, together = iterative.system.iterations
    assert 0 < alone <= FEW
    assert 0 < together <= FEW
    names = iterative.system.unknowns
    potentials = [
        np.concatenate([_values(p, name) for name in ("phi", "jump") if name in names]) for p in (iterative, direct)
    ]
    assert np.abs(potentials[0] - potentials[1]).max() < 1e-8 * np.abs(potentials[1]).max()
    # the update's residual is a thousand-millionth of the load; soft motions of the shell amplify it
    values, others = (vector.FV().NumPy() for vector in (found, known))
    for part in (names.range("u"), names.range("phi")):
        assert np.abs(values[part] - others[part]).max() < 1e-6 * np.abs(others[part]).max()


def _values(problem: Problem, name: str) -> Any:
    return np.array(problem.system.unknowns.field(name).vec.FV().NumPy())


def test_a_load_without_a_potential() -> None:
    """The pivoting solver eliminates, GMRES does not need symmetry."""
    direct, iterative = coupled("3d", "conductor", varying=True), iterating("3d", "conductor", varying=True)
    assert not iterative.system.symmetric
    for problem in (direct, iterative):
        distort(problem, 0.05)
    found, known = (np.array(p.system.newton_update()[0].FV().NumPy()) for p in (iterative, direct))
    assert np.linalg.norm(found - known) < 1e-6 * np.linalg.norm(known)


def test_small_loads_are_solved_as_well_as_large_ones() -> None:
    """A linear solver does not know units: the last residuals of Newton's method are 1e-12 of the first."""
    problem = iterating("3d", "conductor")
    distort(problem)
    load = problem.system.residual()
    problem.system.linearise()
    large = np.array(problem.system.solve(load).FV().NumPy())
    load *= 1e-10
    small = 1e10 * problem.system.solve(load).FV().NumPy()
    assert np.linalg.norm(small - large) < 1e-7 * np.linalg.norm(large)


def test_the_charge_of_a_sphere_in_free_space() -> None:
    """Q = 4 pi R V (eps0 = 1) of a sphere of radius R, counted over the whole sphere. Robin's condition is exact for a
    net charge, what is left is the mesh's error."""
    charges = []
    for problem in (coupled("3d", "conductor", "closed", order=3), iterating("3d", "conductor", "closed", order=3)):
        system = problem.system
        potential = system.potential
        assert potential is not None
        system.load(0.0, 1.0, None)
        potential.solve()
        base = potential.conductors[0]
        charges.append(potential.charge(base) / (4 * math.pi * potential.voltage(base)))
    assert charges[0] == pytest.approx(1.0, abs=1e-3)
    assert charges[1] == pytest.approx(charges[0], abs=1e-9)


def test_the_ambient_moves_alike() -> None:
    direct, iterative = coupled("3d", "conductor", size=0.4), iterating("3d", "conductor", size=0.4)
    for problem in (direct, iterative):
        distort(problem, 0.3)
    moved = [problem.system.motions["outside"].w.vec.FV().NumPy() for problem in (iterative, direct)]
    assert np.abs(moved[0] - moved[1]).max() < 1e-6 * np.abs(moved[1]).max()


# -- on a matrix of its own


def laplace(mass: float) -> tuple[Any, Any]:
    space = H1(Mesh(unit_square.GenerateMesh(maxh=0.1)), order=3, dirichlet=".*")
    u, v = space.TnT()
    form = BilinearForm(space, symmetric=True)
    form += (InnerProduct(grad(u), grad(v)) + mass * u * v) * dx
    form.Assemble()
    return space, form


def loaded(form: Any) -> Any:
    load = form.mat.CreateColVector()
    load.FV().NumPy()[:] = np.random.default_rng(5).uniform(-1, 1, form.mat.height)
    return load


@pytest.mark.parametrize("mass", [-60.0, float("nan")], ids=["indefinite", "not a number"])
def test_what_cannot_be_solved_is_an_error_with_numbers(mass: float) -> None:
    """The lowest eigenvalues of the unit square are 2 pi^2 = 19.7 and 5 pi^2 = 49.3."""
    space, form = laplace(mass)
    free = np.array([bool(bit) for bit in space.FreeDofs()])
    solver = PotentialSolver(space, free)
    solver.factor(SimpleNamespace(mat=form.mat))
    with pytest.raises(LinearSolverError, match="could not be solved"):
        solver.solve(loaded(form))


def test_an_inverse_is_an_operator() -> None:
    space, form = laplace(1.0)
    direct, iterative = (Inverter(space, space.FreeDofs(), kind)(form.mat) for kind in ("direct", "iterative"))
    load = loaded(form)
    known, found, twice = (load.CreateVector() for _ in range(3))
    known.data = direct * load
    found.data = iterative * load
    twice.data = found + 2 * iterative * load
    assert np.linalg.norm(found.FV().NumPy() - known.FV().NumPy()) < 1e-9 * np.linalg.norm(known.FV().NumPy())
    assert np.linalg.norm(twice.FV().NumPy() - 3 * known.FV().NumPy()) < 1e-8 * np.linalg.norm(known.FV().NumPy())


def test_gmres_solves_any_matrix() -> None:
    rng = np.random.default_rng(3)
    matrix, known = rng.uniform(-1, 1, (30, 30)), rng.uniform(-1, 1, 30)
    found, ending = gmres(lambda x: matrix @ x, lambda x: x.copy(), matrix @ known, 1e-12, 30)
    assert ending.iterations <= 30
    assert found == pytest.approx(known, rel=1e-8)


def test_gmres_ends_where_nothing_is_left() -> None:
    """Two eigenvalues, two iterations, and an answer although more were asked for; nothing for nothing."""
    matrix, right = np.diag([1.0, -2.0] * 4), np.ones(8)
    found, ending = gmres(lambda x: matrix @ x, lambda x: x.copy(), right, 1e-14, 8)
    assert ending.iterations == 2
    assert found == pytest.approx(np.linalg.solve(matrix, right))
    assert gmres(lambda x: matrix @ x, lambda x: x.copy(), 0 * right, 1e-9, 8)[1].iterations == 0


def test_gmres_says_how_far_it_came() -> None:
    shift = np.roll(np.eye(20), 1, axis=0)  # the classical case that stands still until the last iteration
    found, ending = gmres(lambda x: shift @ x, lambda x: x.copy(), np.eye(20)[0], 1e-10, 10)
    assert ending.iterations == 10
    assert ending.remainder == pytest.approx(1.0)
    assert np.all(np.isfinite(found))
