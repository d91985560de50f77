"""The two sides of an interface, and its rims, from the mesh's topology alone.

Around a vertex of the interface walk from element to element through facets that are not part of it: the elements fall
into as many *fans* as there are sides. Two: the interface goes on all around, also where the mesh ends, on a mirror
plane or on the axis. One: a rim, around which one comes from the top to the bottom. Three and more: a junction. The
same around edges in 3D.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Integers = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
TOP, BOTTOM, RIM, AWAY = 1, -1, 2, 0


class JunctionError(ValueError):
    """Three or more sheets of the interface meet."""


class CloseSheetsError(ValueError):
    """An element touches both sides of the interface."""


@dataclass(frozen=True)
class Cut:
    """The interface of ``facets`` (m, d) in the mesh of simplices ``elements`` (n, d + 1), by numbers of vertices."""

    elements: Integers
    facets: Integers

    @cached_property
    def _on(self) -> Mask:
        on = np.zeros(int(self.elements.max()) + 1, bool)
        on[self.facets] = True
        return on

    @cached_property
    def _walls(self) -> Integers:
        """Pairs of elements with a facet between them that is not of the interface, and that facet: (k, 2 + d)."""
        d = self.elements.shape[1] - 1
        corners = list(combinations(range(d + 1), d))
        every = np.sort(np.concatenate([self.elements[:, list(c)] for c in corners]), axis=1)
        owner = np.tile(np.arange(len(self.elements)), len(corners))
        order = np.lexsort(every.T[::-1])
        every, owner = every[order], owner[order]
        pair = np.flatnonzero((every[1:] == every[:-1]).all(axis=1))
        walls = np.column_stack([owner[pair], owner[pair + 1], every[pair]])
        return np.asarray(walls[~_among(walls[:, 2:], np.sort(self.facets, axis=1))])

    @cached_property
    def beside(self) -> tuple[Integers, Integers]:
        """Every (element, facet of the interface) that touch in that facet, as two arrays of numbers."""
        d = self.elements.shape[1] - 1
        facets = np.sort(self.facets, axis=1)
        found: list[Integers] = []
        for c in combinations(range(d + 1), d):
            sides = np.sort(self.elements[:, list(c)], axis=1)
            where = _index(sides, facets)
            hit = np.flatnonzero(where >= 0)
            found.append(np.column_stack([hit, where[hit]]))
        both = np.concatenate(found)
        return both[:, 0], both[:, 1]

    @cached_property
    def _vertex_fans(self) -> tuple[Integers, Integers, Integers]:
        """Element, vertex and fan of every pair of an element and a vertex of the interface that it touches."""
        element, local = np.nonzero(self._on[self.elements])
        vertex = self.elements[element, local]
        number = self._pair_number(element, vertex)
        first, second = [], []
        for column in range(2, self._walls.shape[1]):
            corner = self._walls[:, column]
            on = self._on[corner]
            first.append(self._pair_number(self._walls[on, 0], corner[on]))
            second.append(self._pair_number(self._walls[on, 1], corner[on]))
        return element, vertex, _components(number, np.concatenate(first), np.concatenate(second))

    def _pair_number(self, element: Integers, vertex: Integers) -> Integers:
        return np.asarray(element * (len(self._on)) + vertex)

    @cached_property
    def rim_vertices(self) -> Integers:
        """Vertices of the rims.

        Raises:
            JunctionError: three or more sheets meet.
        """
        _, vertex, fan = self._vertex_fans
        vertices, count = np.unique(np.unique(np.column_stack([vertex, fan]), axis=0)[:, 0], return_counts=True)
        if np.any(count > 2):
            raise JunctionError("three or more sheets of the shell meet")
        return np.asarray(vertices[count == 1])

    @cached_property
    def rim_edges(self) -> Integers:
        """Edges (k, 2) of the rims of a surface, by their vertices; a curve has none."""
        d = self.elements.shape[1] - 1
        if d == 2:
            return np.zeros((0, 2), np.int64)
        edges = np.sort(np.concatenate([self.facets[:, list(c)] for c in combinations(range(3), 2)]), axis=1)
        edges = np.unique(edges, axis=0)
        owned: list[Integers] = []
        for c in combinations(range(4), 2):
            where = _index(np.sort(self.elements[:, list(c)], axis=1), edges)
            hit = np.flatnonzero(where >= 0)
            owned.append(np.column_stack([hit, where[hit]]))
        pairs = np.concatenate(owned)
        first, second = [], []
        for c in combinations(range(3), 2):
            where = _index(np.sort(self._walls[:, [2 + i for i in c]], axis=1), edges)
            hit = np.flatnonzero(where >= 0)
            first.append(self._walls[hit, 0] * len(edges) + where[hit])
            second.append(self._walls[hit, 1] * len(edges) + where[hit])
        fan = _components(
            pairs[:, 0] * len(edges) + pairs[:, 1], np.concatenate(first), np.concatenate(second)
        )
        edge, count = np.unique(np.unique(np.column_stack([pairs[:, 1], fan]), axis=0)[:, 0], return_counts=True)
        if np.any(count > 2):
            raise JunctionError("three or more sheets of the shell meet")
        return np.asarray(edges[edge[count == 1]])

    def sides(self, top: Mask) -> Integers:
        """``TOP``, ``BOTTOM``, ``RIM`` (touches the interface in rims only) or ``AWAY`` for every element; ``top`` says
        of each pair of ``beside`` whether the element lies on the top side.

        Raises:
            CloseSheetsError: an element touches both sides.
        """
        element, vertex, fan = self._vertex_fans
        rim = np.isin(vertex, self.rim_vertices)
        label = np.zeros(int(fan.max()) + 1, np.int64)
        pair = dict(zip(self._pair_number(element, vertex).tolist(), fan.tolist(), strict=True))
        rims = set(self.rim_vertices.tolist())
        for one, facet, up in zip(*self.beside, top, strict=True):
            for corner in self.facets[facet].tolist():
                if corner not in rims:
                    label[pair[one * len(self._on) + corner]] = TOP if up else BOTTOM
        low, high = (np.zeros(len(self.elements), np.int64) for _ in range(2))
        np.minimum.at(low, element[~rim], label[fan[~rim]])
        np.maximum.at(high, element[~rim], label[fan[~rim]])
        if np.any((low < 0) & (high > 0)):
            raise CloseSheetsError("an element touches both sides of the shell")
        side = low + high
        side[np.setdiff1d(element[rim], np.flatnonzero(side))] = RIM
        return np.asarray(side)

    def rooms(self) -> Integers:
        """Number of the connected part of space, parted by the interface, that each element lies in."""
        count = len(self.elements)
        links = coo_array((np.ones(len(self._walls)), (self._walls[:, 0], self._walls[:, 1])), shape=(count, count))
        return np.asarray(connected_components(links, directed=False)[1])


def _components(numbers: Integers, first: Integers, second: Integers) -> Integers:
    """Component of each of ``numbers`` under the links from ``first`` to ``second``, numbered from 0."""
    unique, inverse = np.unique(numbers, return_inverse=True)
    a, b = np.searchsorted(unique, first), np.searchsorted(unique, second)
    links = coo_array((np.ones(len(a)), (a, b)), shape=(len(unique), len(unique)))
    return np.asarray(connected_components(links, directed=False)[1][inverse])


def _key(rows: Integers, base: int) -> Integers:
    key = np.zeros(len(rows), np.int64)
    for column in rows.T:
        key = key * base + column
    return key


def _index(rows: Integers, among: Integers) -> Integers:
    """Where each row stands in ``among`` (distinct rows), -1 where it does not."""
    base = int(max(rows.max(initial=0), among.max(initial=0))) + 1
    keys, wanted = _key(among, base), _key(rows, base)
    order = np.argsort(keys)
    place = np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)
    found = keys[order][place] == wanted
    return np.asarray(np.where(found, order[place], -1))


def _among(rows: Integers, others: Integers) -> Mask:
    return np.asarray(_index(rows, others) >= 0)
