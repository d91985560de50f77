"""Krylov methods end, but for rounding, after as many iterations as the matrix has different eigenvalues (Saad and
Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856; Hestenes and Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409)."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from ngsolve import Projector
from ngsolve.la import SparseMatrixd

from embedding.ambient.krylov import conjugate_gradients, gmres
from embedding.geometry.spaces import as_bits

DIFFERENT = [1.0, 3.0, 10.0, 40.0, 200.0]
SIZE = 60


def unpreconditioned(values: Any, free: Any) -> Any:
    """What stands for a preconditioned matrix: a diagonal of ``values``, and no preconditioner."""
    places = list(range(SIZE))
    matrix = SparseMatrixd.CreateFromCOO(places, places, list(values), SIZE, SIZE)
    projector = Projector(as_bits(free), True)

    def apply(right_side: Any, out: Any) -> None:
        out.data = right_side
        projector.Project(out)

    return SimpleNamespace(matrix=matrix, free=projector, apply=apply)


@pytest.mark.parametrize("count", [1, 3, 5])
def test_conjugate_gradients_end_after_as_many_iterations_as_eigenvalues(count: int) -> None:
    values = np.resize(DIFFERENT[:count], SIZE)
    free = np.arange(SIZE) % 7 != 0
    cycle = unpreconditioned(values, free)
    right, out = cycle.matrix.CreateColVector(), cycle.matrix.CreateColVector()
    right.FV().NumPy()[:] = np.random.default_rng(3).standard_normal(SIZE)
    ending = conjugate_gradients(cycle, right, out, 1e-10, 100)
    assert ending.iterations == count and ending.remainder < 1e-10
    np.testing.assert_allclose(out.FV().NumPy(), free * right.FV().NumPy() / values, rtol=1e-8)


def test_conjugate_gradients_refuse_a_matrix_that_is_not_definite() -> None:
    cycle = unpreconditioned(np.resize([1.0, -1.0], SIZE), np.ones(SIZE, bool))
    right, out = cycle.matrix.CreateColVector(), cycle.matrix.CreateColVector()
    right.FV().NumPy()[:] = np.resize([1.0, 2.0], SIZE)
    assert not conjugate_gradients(cycle, right, out, 1e-10, 100).remainder < 1e-10


@pytest.mark.parametrize("signs", [1.0, [1.0, -1.0]], ids=["definite", "indefinite"])
def test_gmres_ends_after_as_many_iterations_as_eigenvalues(signs: Any) -> None:
    values = np.resize(DIFFERENT[:3], SIZE) * np.resize(signs, SIZE)
    right = np.random.default_rng(4).standard_normal(SIZE)
    found, ending = gmres(lambda x: values * x, lambda x: x, right, 1e-10, 100)
    assert ending.iterations == len(set(values.tolist())) and ending.remainder < 1e-10
    np.testing.assert_allclose(found, right / values, rtol=1e-8)


def test_a_preconditioner_that_is_the_inverse_needs_one_iteration() -> None:
    values = np.linspace(1.0, 500.0, SIZE)
    found, ending = gmres(lambda x: values * x, lambda x: x / values, np.ones(SIZE), 1e-10, 100)
    assert ending.iterations == 1
    np.testing.assert_allclose(found, 1 / values, rtol=1e-12)
