"""Blocks of elements of one orientation, and the reference geometry at points in them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import CF

from embedding.geometry.domain import Domain
from embedding.shell.batched.algebra import cross, determinant, determinant_slope, dot, metric
from embedding.shell.batched.polynomials import GRADIENT, HESSIAN, Array, as_rule, lattice, monomials
from embedding.shell.batched.reference import Orientation, displacement_basis

Integers = npt.NDArray[np.int64]

BLOCK = 192
"""Most elements of a block: the arrays of one then stay in the cache."""


@dataclass(frozen=True)
class Block:
    """``elements`` (e,), numbered within the shell, whose vertices' numbers have the same ``orientation``.

    ``shapes`` are the coefficients (monomials, n) of their shape functions of ``order``, ``places`` those of the
    reference position in terms of them (n, 3, e), and ``sign`` (e,) turns X_1 x X_2 to the top side.
    """

    domain: Domain
    elements: Integers
    orientation: Orientation
    order: int
    shapes: Array
    places: Array
    sign: Array

    @property
    def copies(self) -> float:
        """How many mirror images make up the whole body."""
        return float(self.domain.reduction.copies)

    def at(self, points: Array, value: Any) -> Array:
        """A number or coefficient function at reference ``points`` (p, 2), shape (p, e)."""
        if isinstance(value, int | float):
            return np.full((len(points), len(self.elements)), float(value))
        return at_all(self.domain, points, value)[self.elements, :, 0].T.copy()

    def gradients(self, points: Array) -> Array:
        """Both derivatives of the shape functions at ``points``, shape (2, p, n)."""
        return np.stack([monomials(self.order, points, d) @ self.shapes for d in GRADIENT])

    def hessians(self, points: Array) -> Array:
        """The second derivatives 11, 12, 22 of the shape functions at ``points``, shape (3, p, n)."""
        return np.stack([monomials(self.order, points, d) @ self.shapes for d in HESSIAN])


@dataclass(frozen=True)
class Surface:
    """The reference surface at points of a block, arrays (..., p, e).

    ``area`` is |X_1 x X_2|, ``inverse`` the inverse metric with its 12 component doubled, ``metric`` the metric, and
    ``curvature`` N . X_ab.
    """

    area: Array
    metric: Array
    inverse: Array
    curvature: Array

    @classmethod
    def of(cls, block: Block, points: Array) -> Surface:
        """At reference ``points`` (p, 2)."""
        first, second = derivatives(block.gradients(points), block.places)
        tensor, normal = metric(first, second), cross(first, second)
        square = determinant(tensor)
        area = np.sqrt(square)
        bend = np.stack([dot(v, normal) for v in derivatives(block.hessians(points), block.places)])
        return cls(area, tensor, determinant_slope(tensor) / square, block.sign * bend / area)


def derivatives(table: Array, coefficients: Array) -> Array:
    """Derivatives (d, 3, p, e) from a ``table`` (d, p, n) of the shape functions' and ``coefficients`` (n, 3, e)."""
    kinds, points, count = table.shape
    product = table.reshape(-1, count) @ coefficients.reshape(count, -1)
    return np.swapaxes(product.reshape(kinds, points, 3, -1), 1, 2)


def at_all(domain: Domain, points: Array, value: Any) -> Array:
    """A coefficient function at reference ``points`` of all elements, shape (elements, p, components)."""
    mapped = domain.mesh.MapToAllElements(as_rule(points), domain.shell)
    return np.asarray(CF(value)(mapped)).reshape(len(domain.facets.numbers), len(points), -1)


def blocks(domain: Domain) -> Iterator[Block]:
    """All elements of the shell, in blocks."""
    order, points = domain.sizes.order, lattice(domain.sizes.order)
    places = at_all(domain, points, domain.reduction.position)
    sign = at_all(domain, lattice(0), domain.sign)[:, 0, 0]
    ranks = domain.facets.corners.argsort(axis=1).argsort(axis=1)
    for row in np.unique(ranks, axis=0):
        first, second, third = row.tolist()
        shapes = displacement_basis((first, second, third), order)
        basis = np.linalg.inv(monomials(order, points) @ shapes)
        alike = np.flatnonzero((ranks == row).all(axis=1))
        for elements in np.array_split(alike, -(-len(alike) // BLOCK)):
            nodes = np.tensordot(basis, places[elements], axes=(1, 1)).transpose(0, 2, 1)
            yield Block(
                domain, elements, (first, second, third), order, shapes, np.ascontiguousarray(nodes), sign[elements]
            )
