"""The direct solver: accurate or a typed error, with a second, pivoting method where the fast one fails."""

from __future__ import annotations

import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from netgen.geom2d import unit_square
from ngsolve import H1, BilinearForm, GridFunction, InnerProduct, Mesh, dx, grad

from embedding.coupling.linear import ACCURATE, DirectSolver, LinearSolverError
from embedding.geometry.spaces import as_bits


def system(*, symmetric: bool = True, stiffness: float = 1.0, mass: float = 0.0) -> tuple[Any, Any, Any]:
    """Matrix, right side and all unknowns of -stiffness Laplace + mass on the unit square, without conditions."""
    space = H1(Mesh(unit_square.GenerateMesh(maxh=0.3)), order=2)
    u, v = space.TnT()
    form = BilinearForm(space, symmetric=symmetric)
    form += (stiffness * InnerProduct(grad(u), grad(v)) + mass * u * v) * dx
    if not symmetric:
        form += 0.3 * grad(u)[0] * v * dx
    form.Assemble()
    right = GridFunction(space).vec
    right.FV().NumPy()[:] = np.random.default_rng(2).uniform(-1, 1, space.ndof)
    return form.mat, right, np.ones(space.ndof, bool)


def remainder(matrix: Any, right: Any, update: Any, free: Any) -> float:
    rest = right.CreateVector()
    rest.data = right - matrix * update
    return float(np.linalg.norm(rest.FV().NumPy()[free]) / np.linalg.norm(right.FV().NumPy()[free]))


def solved(free: Any, matrix: Any, right: Any, *, symmetric: bool) -> Any:
    solver = DirectSolver(as_bits(free), symmetric=symmetric)
    solver.factor(SimpleNamespace(mat=matrix))
    return solver.solve(right)


@pytest.mark.parametrize("symmetric", [True, False])
def test_a_solve_is_accurate(symmetric: bool) -> None:
    matrix, right, free = system(symmetric=symmetric, mass=1.0)
    update = solved(free, matrix, right, symmetric=symmetric)
    assert remainder(matrix, right, update, free) < 1e-11


def test_held_unknowns_stay_zero() -> None:
    matrix, right, free = system(mass=1.0)
    free[:7] = False
    update = solved(free, matrix, right, symmetric=True)
    assert np.all(update.FV().NumPy()[:7] == 0.0)
    assert remainder(matrix, right, update, free) < 1e-11


def test_no_load_no_answer() -> None:
    """Nothing is factorised for a zero right side: a singular matrix does not matter then."""
    matrix, right, free = system(stiffness=0.0)
    right[:] = 0.0
    update = solved(free, matrix, right, symmetric=True)
    assert np.all(update.FV().NumPy() == 0.0)


class Spoiled:
    """A matrix whose fast factorisation is wrong by a factor, as elimination without pivoting may be."""

    def __init__(self, matrix: Any, spoil: dict[str, float]) -> None:
        self.matrix, self.spoil = matrix, spoil
        self.asked: list[str] = []

    def Inverse(self, free: Any, inverse: str) -> Any:
        self.asked.append(inverse)
        if self.spoil.get(inverse) == 0.0:
            raise RuntimeError("matrix singular")
        return self.spoil.get(inverse, 1.0) * self.matrix.Inverse(free, inverse=inverse)

    def COO(self) -> Any:
        return self.matrix.COO()

    def __mul__(self, vector: Any) -> Any:
        return self.matrix * vector


@pytest.mark.parametrize("factor", [0.0, 3.0, float("nan")], ids=["refused", "wrong", "not a number"])
def test_what_the_fast_method_cannot_do_the_pivoting_one_does(factor: float) -> None:
    matrix, right, free = system(mass=1.0)
    spoiled = Spoiled(matrix, {"sparsecholesky": factor})
    update = solved(free, spoiled, right, symmetric=True)
    assert spoiled.asked == ["sparsecholesky", "umfpack"]
    assert remainder(matrix, right, update, free) < 1e-11


def test_a_slightly_wrong_factor_is_refined() -> None:
    matrix, right, free = system(mass=1.0)
    spoiled = Spoiled(matrix, {"sparsecholesky": 1 + 1e-6})
    update = solved(free, spoiled, right, symmetric=True)
    assert spoiled.asked == ["sparsecholesky"]
    assert remainder(matrix, right, update, free) < ACCURATE


def test_an_unsymmetric_matrix_is_pivoted_at_once() -> None:
    matrix, right, free = system(symmetric=False, mass=1.0)
    spoiled = Spoiled(matrix, {})
    solved(free, spoiled, right, symmetric=False)
    assert spoiled.asked == ["umfpack"]


@pytest.mark.parametrize("broken", ["singular", "not a number"])
def test_what_nobody_can_solve_is_a_typed_error(broken: str, capfd: pytest.CaptureFixture[str]) -> None:
    matrix, right, free = system(stiffness=1.0 if broken == "singular" else float("nan"))
    with pytest.raises(LinearSolverError, match="could not be solved"):
        solved(free, matrix, right, symmetric=True)
    assert capfd.readouterr().out == ""  # the libraries' own warnings stay away from standard output


def test_a_process_without_standard_output_solves() -> None:
    """``python script.py >&-``: the pivoting solver must not be lost with the descriptor it is kept quiet on."""
    code = (
        "import sys; from tests.coupling.test_linear import *; m, r, f = system(symmetric=False, mass=1.0);"
        "u = solved(f, m, r, symmetric=False); sys.exit(0 if remainder(m, r, u, f) < 1e-10 else 5)"
    )
    done = subprocess.run(["/bin/sh", "-c", f'"{sys.executable}" -c "{code}" >&-'], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
