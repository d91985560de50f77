"""Matrices of elements from values at their points.

What differs from point to point and element to element stands between products of shape functions that are the same
for all elements of one orientation, so that a sum over points is one product of large matrices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from embedding.shell.batched.polynomials import Array


@dataclass(frozen=True)
class Matrices:
    """Second derivatives: ``uu`` (n, n, 3, 3, e), half of it, to be added to its transpose; ``mu`` (nm, n, 3, e) and
    ``mm`` (nm, nm, e)."""

    uu: Array
    mu: Array
    mm: Array

    def __add__(self, other: Matrices) -> Matrices:
        return Matrices(self.uu + other.uu, self.mu + other.mu, self.mm + other.mm)


def pairs(first: Array, second: Array) -> Array:
    """Products of two tables (a, p, n) and (b, p, m) at the points, as a matrix (n m, a b p)."""
    n, m = first.shape[2], second.shape[2]
    return np.asarray(np.einsum("api,bpj->ijabp", first, second)).reshape(n * m, -1)


def pair_columns(values: Array) -> Array:
    """Values (3 a, 3 b, p, e) that stand between vectors' derivatives, as columns (a b p, 9 e) for :func:`pairs`."""
    points, count = values.shape[2:]
    split = values.reshape(-1, 3, values.shape[1] // 3, 3, points, count)
    return split.transpose(0, 2, 4, 1, 3, 5).reshape(-1, 9 * count)


def columns(values: Array) -> Array:
    """Values (..., 3, p, e) of vectors as columns (... p, 3 e)."""
    points, count = values.shape[-2:]
    return values.reshape(-1, 3, points, count).transpose(0, 2, 1, 3).reshape(-1, 3 * count)


def gathered(table: Array, values: Array) -> Array:
    """Sum over kinds and points of a ``table`` (d, p, n) times ``values`` (3 d, p, e): shape (n, 3, e)."""
    n = table.shape[2]
    return np.asarray(table.reshape(-1, n).T @ columns(values)).reshape(n, 3, -1)
