"""Where the entries of elements are in a sparse matrix of several unknowns, block by block."""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding.ambient.tets import Array, Integers


class Block:
    """The entries of a symmetric ``matrix`` between all components of two unknowns, that stand at ``rows`` and
    ``columns``, of ``row_components`` and ``column_components``; each component of one meets those of the other alike.
    """

    def __init__(
        self, matrix: Any, rows: slice, columns: slice, row_components: int, column_components: int
    ) -> None:
        pattern = _Pattern(*(np.asarray(part) for part in matrix.CSR()[1:]))
        down, across = _split(rows, row_components), _split(columns, column_components)
        self._width = across[0].stop - across[0].start
        self._keys, first = pattern.places(down[0], across[0])
        turned, _ = pattern.places(across[0], down[0])
        length = down[0].stop - down[0].start
        order = np.searchsorted(turned, self._keys % self._width * length + self._keys // self._width)
        own = rows == columns
        self._pairs = [(i, j) for i in range(len(down)) for j in range(i if own else 0, len(across))]
        self._there = [first if i + j == 0 else pattern.places(down[i], across[j])[1] for i, j in self._pairs]
        self._back = [pattern.places(across[j], down[i])[1][order] for i, j in self._pairs]
        self._diagonal = [own and i == j for i, j in self._pairs]

    def find(self, rows: Integers, columns: Integers) -> Integers:
        """For elements with unknowns (n, e) and (m, e) of one component, -1 where there is none, the numbers (n, m, e)
        of their entries."""
        wanted = rows[:, None].astype(np.int64) * self._width + columns[None]
        found = np.asarray(np.searchsorted(self._keys, wanted), np.int64)
        found[np.broadcast_to((rows[:, None] < 0) | (columns[None] < 0), found.shape)] = len(self._keys)
        return found

    def add(self, matrix: Any, where: Integers, values: Array) -> None:
        """Add ``values`` (pairs, entries), by pairs of components (with i <= j between those of one unknown), to the
        entries ``where``, and to those across the diagonal."""
        entries, size = matrix.AsVector().FV().NumPy(), len(self._keys)
        flat = where.ravel()
        for number, block in enumerate(values):
            sums = np.bincount(flat, block.ravel(), size + 1)[:size]
            entries[self._there[number]] += sums
            if not self._diagonal[number]:
                entries[self._back[number]] += sums


def _split(where: slice, components: int) -> list[slice]:
    ends = np.linspace(where.start, where.stop, components + 1).astype(int).tolist()
    return [slice(*pair) for pair in zip(ends, ends[1:], strict=False)]


class _Pattern:
    """The pattern of a matrix, stored by rows: ``columns`` of the entries and where rows start."""

    def __init__(self, columns: Any, starts: Any) -> None:
        self._columns, self._starts = columns, starts

    def places(self, rows: slice, across: slice) -> tuple[Integers, Integers]:
        """Keys (row times width plus column, within the block) and places of the entries of a block, sorted."""
        first, last = int(self._starts[rows.start]), int(self._starts[rows.stop])
        columns = self._columns[first:last]
        inside = np.flatnonzero((columns >= across.start) & (columns < across.stop))
        ends = np.asarray(self._starts[rows.start : rows.stop + 1], np.int64) - first
        row = np.searchsorted(ends, inside, side="right") - 1
        return row * (across.stop - across.start) + columns[inside] - across.start, inside + first
