"""Counting negative eigenvalues by elimination, with multipliers, and what the count means on shells."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sparse

from embedding.solving.stability import SMALL, negative_eigenvalues


def random_symmetric(size: int, seed: int, spread: float = 1.0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    dense = rng.standard_normal((size, size)) * (rng.uniform(size=(size, size)) < 0.1)
    return dense + dense.T + spread * np.diag(rng.standard_normal(size))


@pytest.mark.parametrize("seed", range(5))
def test_as_many_as_there_are(seed: int) -> None:
    matrix = random_symmetric(80, seed, 3.0)
    border = np.zeros(80, bool)
    expected = int((np.linalg.eigvalsh(matrix) < 0).sum())
    assert negative_eigenvalues(sparse.csc_array(matrix), border) == expected
    border[[3, 50, 79]] = True
    assert negative_eigenvalues(sparse.csc_array(matrix), border) == expected
    assert negative_eigenvalues(sparse.csc_array(matrix), border, less=2) == expected - 2


@pytest.mark.parametrize("unstable", [0, 1, 3])
def test_free_motions_held_by_multipliers(unstable: int) -> None:
    """A semidefinite matrix with two free motions, made unstable in some others; the multipliers do not count."""
    rng = np.random.default_rng(1)
    axes, _ = np.linalg.qr(rng.standard_normal((40, 40)))
    values = np.concatenate([[0.0, 0.0], -np.ones(unstable), np.linspace(1.0, 5.0, 38 - unstable)])
    stiffness = axes @ np.diag(values) @ axes.T
    held = axes[:, :2] @ np.array([[2.0, 1.0], [0.5, -1.0]])
    whole = np.block([[stiffness, held], [held.T, np.zeros((2, 2))]])
    border = np.arange(42) >= 40
    assert negative_eigenvalues(sparse.csc_array(whole), border, shift=1e-13, less=2) == unstable


def test_a_pivot_that_vanishes() -> None:
    """[[0, 1], [1, 0]] has the eigenvalues 1 and -1 and no pivot to begin with; of a large one nothing is known."""
    swap = np.array([[0.0, 1.0], [1.0, 0.0]])
    assert negative_eigenvalues(sparse.csc_array(swap), np.zeros(2, bool)) == 1
    many = sparse.csc_array(sparse.block_diag([swap] * (SMALL // 2 + 1)))
    assert negative_eigenvalues(many, np.zeros(many.shape[0], bool)) is None
