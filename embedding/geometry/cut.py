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
    def _fans(self) -> tuple[_Fans, ...]:
        """Around the vertices of the interface, in space also around its edges."""
        sizes = range(1, self.facets.shape[1])
        return tuple(_Fans.around(self.elements, self.facets, self._walls, size) for size in sizes)

    @property
    def rim_vertices(self) -> Integers:
        """Vertices of the rims.

        Raises:
            JunctionError: three or more sheets meet.
        """
        fans = self._fans[0]
        return np.asarray(fans.nodes[fans.rim, 0])

    @property
    def rim_edges(self) -> Integers:
        """Edges (k, 2) of the rims of a surface, by their vertices; a curve has none.

        Raises:
            JunctionError: three or more sheets meet.
        """
        if len(self._fans) == 1:
            return np.zeros((0, 2), np.int64)
        fans = self._fans[1]
        return np.asarray(fans.nodes[fans.rim])

    def sides(self, top: Mask) -> Integers:
        """``TOP``, ``BOTTOM``, ``RIM`` (touches the interface in rims only) or ``AWAY`` for every element; ``top`` says
        of each pair of ``beside`` whether the element lies on the top side.

        Raises:
            CloseSheetsError: an element touches both sides.
        """
        element, facet = self.beside
        found = np.where(top, TOP, BOTTOM)
        touching, label = [element], [found]
        for fans in self._fans:
            inner = ~fans.rim[fans.node]
            touching.append(fans.element[inner])
            label.append(fans.labels(element, self.facets[facet], found)[fans.fan[inner]])
        low, high = (np.zeros(len(self.elements), np.int64) for _ in range(2))
        np.minimum.at(low, np.concatenate(touching), np.concatenate(label))
        np.maximum.at(high, np.concatenate(touching), np.concatenate(label))
        if np.any((low < 0) & (high > 0)):
            raise CloseSheetsError("an element touches both sides of the shell")
        side = low + high
        side[np.setdiff1d(self._fans[0].element, np.flatnonzero(side))] = RIM
        return np.asarray(side)

    def rooms(self) -> Integers:
        """Number of the connected part of space, parted by the interface, that each element lies in."""
        return _connected(len(self.elements), self._walls[:, 0], self._walls[:, 1])


@dataclass(frozen=True)
class _Fans:
    """Fans around the vertices or edges of the interface, its ``nodes`` (n, 1 or 2).

    ``element``, ``node`` and ``fan`` are of every pair of an element and a node that it has; ``rim`` is of the nodes.
    """

    nodes: Integers
    element: Integers
    node: Integers
    fan: Integers
    rim: Mask

    @classmethod
    def around(cls, elements: Integers, facets: Integers, walls: Integers, size: int) -> _Fans:
        """Fans around the nodes of ``size`` vertices; ``walls`` are those of the ``Cut``.

        Raises:
            JunctionError: three or more sheets meet in a node.
        """
        nodes = np.unique(np.concatenate(_parts(facets, size)), axis=0)
        element, node = _on(elements, nodes, size)
        wall, shared = _on(walls[:, 2:], nodes, size)
        first, second = (walls[wall, k] * len(nodes) + shared for k in range(2))
        fan = _components(element * len(nodes) + node, first, second)
        count = np.bincount(np.unique(np.column_stack([node, fan]), axis=0)[:, 0], minlength=len(nodes))
        if np.any(count > 2):
            raise JunctionError("three or more sheets of the shell meet")
        return cls(nodes, element, node, fan, count == 1)

    def labels(self, element: Integers, facets: Integers, found: Integers) -> Integers:
        """What was ``found`` for the pairs of ``element`` and one of the ``facets`` of it, for every fan."""
        label = np.zeros(int(self.fan.max()) + 1, np.int64)
        pair, node = _on(facets, self.nodes, self.nodes.shape[1])
        known = np.column_stack([element[pair], node])
        label[self.fan[_index(known, np.column_stack([self.element, self.node]))]] = found[pair]
        return label


def _parts(rows: Integers, size: int) -> list[Integers]:
    """Vertices or edges of simplices, sorted within."""
    return [np.sort(rows[:, list(c)], axis=1) for c in combinations(range(rows.shape[1]), size)]


def _on(rows: Integers, nodes: Integers, size: int) -> tuple[Integers, Integers]:
    """Every (row, node) where the node is a vertex or edge of that simplex."""
    where = np.stack([_index(part, nodes) for part in _parts(rows, size)], axis=1)
    row, column = np.nonzero(where >= 0)
    return row, where[row, column]


def _components(numbers: Integers, first: Integers, second: Integers) -> Integers:
    """Component of each of ``numbers`` under the links from ``first`` to ``second``, numbered from 0."""
    unique, inverse = np.unique(numbers, return_inverse=True)
    a, b = np.searchsorted(unique, first), np.searchsorted(unique, second)
    return np.asarray(_connected(len(unique), a, b)[inverse])


def _connected(count: int, first: Integers, second: Integers) -> Integers:
    """Component of each of 0 ... ``count`` - 1 under the links from ``first`` to ``second``, numbered from 0.

    Trees of labels are hooked under each other and flattened (Y. Shiloach, U. Vishkin, J. Algorithms 3 (1982) 57); the
    sparse graphs of SciPy do the same, but take a third of the import of ngsolve to load.
    """
    label = np.arange(count)
    while True:
        a, b = label[first], label[second]
        apart = a != b
        if not apart.any():
            return np.unique(label, return_inverse=True)[1]
        first, second, a, b = first[apart], second[apart], a[apart], b[apart]
        np.minimum.at(label, np.maximum(a, b), np.minimum(a, b))
        while np.any(label != (flat := label[label])):
            label = flat


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
