"""Where the entries of a sparse matrix are stored."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from embedding.shell.batched.polynomials import Array

Integers = npt.NDArray[np.int64]


class Pattern:
    """Pairs of row and column, each once and sorted by rows, of a matrix with ``width`` columns."""

    def __init__(self, rows: Integers, columns: Integers, width: int) -> None:
        self._width = width
        keys = np.sort(self._key(rows, columns))
        self._keys = keys[np.diff(keys, prepend=-1) > 0]

    def _key(self, rows: Integers, columns: Integers) -> Integers:
        return np.asarray(np.asarray(rows, np.int64) * self._width + columns)

    @property
    def rows(self) -> Integers:
        """Row of each entry."""
        return np.asarray(self._keys // self._width)

    @property
    def columns(self) -> Integers:
        """Column of each entry."""
        return np.asarray(self._keys % self._width)

    def find(self, rows: Integers, columns: Integers) -> Integers:
        """Numbers of the entries at ``rows`` and ``columns``, which must be there."""
        return np.searchsorted(self._keys, self._key(rows, columns))


class Sum:
    """Adds numbers for entries that occur several times, ``entries`` of any shape, to a vector."""

    def __init__(self, entries: Integers) -> None:
        self._targets, self._into = np.unique(entries, return_inverse=True)
        self._into = self._into.ravel()

    def add(self, values: Array, total: Array) -> None:
        """Add ``values``, of the shape of the entries, to their places in ``total``."""
        total[self._targets] += np.bincount(self._into, values.ravel(), len(self._targets))
