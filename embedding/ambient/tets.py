"""Tets of a mesh, many at once, each with its vertices in the order of their numbers in the mesh.

NGSolve's basis functions of an element depend on that order alone. Seen in it, all elements have the same shape
functions at the same points, and sums over points are products of large matrices with the elements along the last axis.
"""

from __future__ import annotations

from itertools import combinations, permutations
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import ET, VOL, ElementId, IntegrationRule

from embedding.geometry.domain import Domain

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

EDGES = ((3, 0), (3, 1), (3, 2), (0, 1), (0, 2), (1, 2))
"""Local vertices of NGSolve's edges of a tet; a face has the number of the vertex across from it."""


class Tets:
    """The tets of some ``materials`` (pattern); ``numbers`` are theirs in the mesh."""

    def __init__(self, domain: Domain, materials: str) -> None:
        elements = list(domain.mesh.Materials(materials).Elements())
        self.numbers = np.array([element.nr for element in elements], np.int64)
        corners = np.array([[v.nr for v in element.vertices] for element in elements], np.int64).reshape(-1, 4)
        self._domain, self._materials = domain, materials
        self._local = corners.argsort(axis=1)  # by place in the order of numbers
        self._place = self._local.argsort(axis=1)

    def dofs(self, space: Any, degree: int) -> Integers:
        """Unknowns (n, e) of a ``space`` whose functions are those of H1 of the ``degree``, by components; -1 where
        the space has none. Beyond degree 4 only for spaces without functions of cells, which then depend on more than
        the order of numbers."""
        table = np.array([space.GetDofNrs(ElementId(VOL, int(number))) for number in self.numbers], np.int64)
        arranged, count = self._arrangement(degree), _count(degree)
        parts = [np.take_along_axis(part, arranged, 1) for part in np.split(table, table.shape[1] // count, 1)]
        return np.maximum(np.concatenate(parts, axis=1).T, -1)

    def _arrangement(self, degree: int) -> Integers:
        """Where the functions, those of vertices, edges, faces and the cell in order, are in NGSolve's list, (e, n)."""
        edge = np.zeros((4, 4), np.int64)
        for number, (a, b) in enumerate(EDGES):
            edge[a, b] = edge[b, a] = number
        on_edge, on_face, inside = degree - 1, (degree - 1) * (degree - 2) // 2, _count(degree - 4) if degree > 3 else 0
        parts = [self._local]
        for a, b in combinations(range(4), 2):
            first = 4 + on_edge * edge[self._local[:, a], self._local[:, b]]
            parts.append(first[:, None] + np.arange(on_edge))
        for vertex in range(4):
            parts.append((4 + 6 * on_edge + on_face * self._local[:, vertex])[:, None] + np.arange(on_face))
        parts.append(np.tile(4 + 6 * on_edge + 4 * on_face + np.arange(inside), (len(self._local), 1)))
        return np.concatenate(parts, axis=1)

    def shapes(self, space: Any, degree: int, points: Array) -> tuple[Array, Array]:
        """Values (p, n) and derivatives (3, p, n) of the functions of a scalar ``space`` at ``points`` (p, 3)."""
        place, element = self._place[0], space.GetFE(ElementId(VOL, int(self.numbers[0])))
        local = _barycentric(points)[:, place][:, :3].tolist()
        values = np.array([element.CalcShape(*point) for point in local])
        slopes = np.array([np.array(element.CalcDShape(*point)) for point in local])
        chain = (place[:3, None] == np.arange(3)) * 1.0 - (place[:3, None] == 3)
        arranged = self._arrangement(degree)[0]
        return values[:, arranged], np.moveaxis(slopes @ chain, 2, 0)[:, :, arranged]

    def places(self, space: Any, degree: int) -> Array:
        """Coefficients (n, 3, e) of the position in the functions of a scalar ``space`` of the ``degree``."""
        lattice = np.array([p for p in np.ndindex(*(4 * [degree + 1])) if sum(p) == degree])
        points = lattice[:, :3] / degree
        mesh = self._domain.mesh
        rule = IntegrationRule(points.tolist(), [0.0] * len(points))
        mapped = mesh.MapToAllElements({ET.TET: rule}, mesh.Materials(self._materials))
        values = np.asarray(self._domain.reduction.position(mapped)).reshape(len(self.numbers), len(points), 3)
        key = (degree + 1) ** np.arange(4)
        number = np.zeros(int(key.sum()) * degree + 1, np.int64)
        number[lattice @ key] = np.arange(len(points))
        where = number[np.stack([lattice[:, place] @ key for place in self._place])]
        values = np.take_along_axis(values, where[:, :, None], 1)
        basis = np.linalg.inv(self.shapes(space, degree, points)[0])
        return np.ascontiguousarray(np.tensordot(basis, values, axes=(1, 1)).transpose(0, 2, 1))


def invariant(rule: IntegrationRule) -> bool:
    """Is a quadrature on tets the same for any order of their vertices? NGSolve's are up to degree 8. Only then are
    sums over :class:`Tets` those of symbolic forms, where integrands are no polynomials."""
    points = np.column_stack([_barycentric(np.array(rule.points)), np.array(rule.weights)])
    known = _sorted(points)
    turns = (np.array([*turn, 4]) for turn in permutations(range(4)))
    return all(np.allclose(_sorted(points[:, turn]), known, rtol=0.0, atol=1e-12) for turn in turns)


def _sorted(points: Array) -> Array:
    return points[np.lexsort(np.round(points, 9).T)]


def _count(degree: int) -> int:
    return (degree + 1) * (degree + 2) * (degree + 3) // 6


def _barycentric(points: Array) -> Array:
    return np.column_stack([points, 1.0 - points.sum(axis=1)])
