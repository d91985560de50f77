"""Where the entries of vector-valued elements are in a sparse matrix whose components are blocks of one pattern."""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding.ambient.tets import Array, Integers


class Entries:
    """The entries of a symmetric ``matrix`` for three components of ``count`` unknowns each, all coupled alike.

    Blocks of elements are added to components i <= j; :meth:`write` puts the sums into the matrix, on both sides of its
    diagonal.
    """

    def __init__(self, matrix: Any, count: int) -> None:
        self._values = matrix.AsVector().FV().NumPy()
        rows, columns = (np.asarray(part, np.int64) for part in matrix.COO()[:2])
        self._row_count = count
        inside = (rows < count) & (columns < count)
        self._keys = rows[inside] * count + columns[inside]
        kind = 3 * (rows // count) + columns // count
        self._places = [np.flatnonzero(kind == number) for number in range(9)]
        self._across = np.searchsorted(self._keys, columns[inside] * count + rows[inside])
        self._sums = np.zeros((3, 3, len(self._keys)))

    def find(self, own: Integers) -> Integers:
        """For elements with the unknowns ``own`` (n, e) of one component, the numbers (n, n, e) of their entries."""
        return np.searchsorted(self._keys, own[:, None] * self._row_count + own[None])

    def clear(self) -> None:
        """Start from zero."""
        self._sums[:] = 0.0

    def add(self, i: int, j: int, where: Integers, blocks: Array) -> None:
        """Add ``blocks`` to the components i <= j at the entries ``where``, of as many numbers."""
        self._sums[i, j] += np.bincount(where.ravel(), blocks.ravel(), len(self._keys))

    def write(self) -> None:
        """Put the sums into the matrix."""
        for i in range(3):
            for j in range(3):
                known = self._sums[i, j] if i <= j else self._sums[j, i][self._across]
                self._values[self._places[3 * i + j]] = known
