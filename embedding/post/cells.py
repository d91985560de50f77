"""Lagrange cells of any order: their polynomials, their edges or faces, and quadrature on them.

Places in a cell are barycentric coordinates (d + 1 of them, d the dimension of the cell), in the order of VTK's
corners. The polynomial of the node with integer coordinates a is the product over the corners i and the integers
j < a_i of (k lambda_i - j) / (j + 1), with the order k.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import numpy.typing as npt

from embedding.archive.lagrange import CELL_TYPES, lagrange_nodes

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]


def dimension_of(cell_type: int) -> int:
    """Dimension of VTK's Lagrange curve, triangle or tetrahedron: 1, 2 or 3."""
    return next(dimension for dimension, kind in CELL_TYPES.items() if kind == cell_type)


def lagrange_basis(nodes: Integers, places: Floats) -> Floats:
    """Polynomials of ``nodes`` (n, corners), integers of equal sum, at ``places`` (p, corners): (p, n)."""
    values, _ = _factors(nodes, places)
    return np.asarray(values.prod(axis=2))


def lagrange_slopes(nodes: Integers, places: Floats) -> Floats:
    """Derivatives of :func:`lagrange_basis` by the coordinates of all corners but the first, which gives way:
    (p, n, d)."""
    values, slopes = _factors(nodes, places)
    corners = nodes.shape[1]
    by_corner = [
        slopes[:, :, corner] * np.delete(values, corner, axis=2).prod(axis=2) for corner in range(corners)
    ]
    return np.stack([by_corner[corner] - by_corner[0] for corner in range(1, corners)], axis=2)


def _factors(nodes: Integers, places: Floats) -> tuple[Floats, Floats]:
    """The factor of every corner and its derivative, each (p, n, corners)."""
    order = int(nodes[0].sum())
    factor, slope = np.ones(places.shape), np.zeros(places.shape)
    factors, slopes = [factor], [slope]
    for step in range(order):
        rise = (order * places - step) / (step + 1)
        factor, slope = factor * rise, slope * rise + factor * order / (step + 1)
        factors.append(factor)
        slopes.append(slope)
    corners = np.arange(nodes.shape[1])
    table, rates = np.stack(factors, axis=1), np.stack(slopes, axis=1)  # (p, power, corner)
    return table[:, nodes, corners], rates[:, nodes, corners]


@cache
def nodes_of(dimension: int, order: int) -> Integers:
    """Integer coordinates of a cell's nodes, (n, d + 1), in VTK's order."""
    return np.array(lagrange_nodes(dimension, order), np.int64)


@cache
def facet_nodes(dimension: int, order: int) -> Integers:
    """Which nodes of a cell are those of its edges or faces, (d + 1, nodes of a facet), each in VTK's order.

    Facet i lies opposite corner i.
    """
    number = {tuple(node): place for place, node in enumerate(lagrange_nodes(dimension, order))}
    small = lagrange_nodes(dimension - 1, order) if dimension > 1 else [(order,)]
    return np.array(
        [[number[(*node[:corner], 0, *node[corner:])] for node in small] for corner in range(dimension + 1)]
    )


def boundary_facets(cells: Integers, cell_type: int, order: int) -> Integers:
    """The edges or faces that belong to one cell only, as cells of one dimension less (facets, nodes)."""
    dimension = dimension_of(cell_type)
    facets = cells[:, facet_nodes(dimension, order)].reshape(-1, facet_nodes(dimension, order).shape[1])
    corners = np.sort(facets[:, :dimension], axis=1)
    _, first, count = np.unique(corners, axis=0, return_index=True, return_counts=True)
    return np.asarray(facets[np.sort(first[count == 1])])


@cache
def quadrature(dimension: int, degree: int) -> tuple[Floats, Floats]:
    """Places (p, d + 1) and weights (p,) that integrate polynomials of ``degree`` over a cell exactly.

    The weights add up to the volume of the simplex with unit edges along the axes. Products of Gauss rules, by the
    map of a cube on the simplex (A. Stroud, Approximate Calculation of Multiple Integrals, 1971).
    """
    count = degree // 2 + 1 + (dimension > 1)
    x, w = np.polynomial.legendre.leggauss(count)
    x, w = (x + 1) / 2, w / 2
    axes = np.stack([axis.ravel() for axis in np.meshgrid(*[x] * dimension, indexing="ij")], axis=1)
    weights = np.stack([axis.ravel() for axis in np.meshgrid(*[w] * dimension, indexing="ij")], axis=1).prod(axis=1)
    places, left = np.empty((len(axes), dimension)), np.ones(len(axes))
    for axis in range(dimension):
        places[:, axis] = left * axes[:, axis]
        weights = weights * (left if axis else 1.0)  # the Jacobian: what is left, once for every later axis
        left = left - places[:, axis]
    return np.column_stack([1 - places.sum(axis=1), places]), weights
