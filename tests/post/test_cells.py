"""Polynomials, facets and quadrature of Lagrange cells, and finding points in curved ones."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from embedding.archive.lagrange import CELL_TYPES
from embedding.post.cells import (
    boundary_facets,
    facet_nodes,
    lagrange_basis,
    lagrange_slopes,
    nodes_of,
    quadrature,
)
from embedding.post.locate import containing, interpolated, nearest

CELLS = list(product((1, 2, 3), (1, 2, 3, 4)))


@pytest.mark.parametrize(("dimension", "order"), CELLS)
def test_polynomials_and_slopes(dimension: int, order: int) -> None:
    nodes = nodes_of(dimension, order)
    np.testing.assert_allclose(lagrange_basis(nodes, nodes / order), np.eye(len(nodes)), atol=1e-13)
    places = np.random.default_rng(0).dirichlet(np.ones(dimension + 1), 7)
    exponents = [e for e in product(range(order + 1), repeat=dimension) if sum(e) <= order]
    for exponent in exponents:
        nodal = np.prod((nodes[:, 1:] / order) ** exponent, axis=1)
        exact = np.prod(places[:, 1:] ** exponent, axis=1)
        np.testing.assert_allclose(lagrange_basis(nodes, places) @ nodal, exact, atol=1e-12)
        slopes = np.einsum("pnd,n->pd", lagrange_slopes(nodes, places), nodal)
        for axis in range(dimension):
            lower = [e - (i == axis) for i, e in enumerate(exponent)]
            slope = exponent[axis] * np.prod(places[:, 1:] ** np.maximum(lower, 0), axis=1)
            np.testing.assert_allclose(slopes[:, axis], slope, atol=1e-11)


@pytest.mark.parametrize(("dimension", "degree"), list(product((1, 2, 3), (1, 2, 5, 8, 12))))
def test_quadrature_is_exact(dimension: int, degree: int) -> None:
    """The integral of x^a y^b z^c over the simplex is a! b! c! / (a + b + c + d)!."""
    places, weights = quadrature(dimension, degree)
    for exponent in product(range(degree + 1), repeat=dimension):
        if sum(exponent) == degree:
            exact = math.prod(map(math.factorial, exponent)) / math.factorial(degree + dimension)
            assert weights @ np.prod(places[:, 1:] ** exponent, axis=1) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize(("dimension", "order"), CELLS)
def test_facets_lie_opposite_their_corner(dimension: int, order: int) -> None:
    nodes, facets = nodes_of(dimension, order), facet_nodes(dimension, order)
    for corner, facet in enumerate(facets):
        there = np.delete(nodes[facet], corner, axis=1)
        assert not nodes[facet][:, corner].any()
        np.testing.assert_array_equal(there, nodes_of(dimension - 1, order) if dimension > 1 else [[order]])
    cell = np.arange(len(nodes))[None]
    assert len(boundary_facets(cell, CELL_TYPES[dimension], order)) == dimension + 1


def curved(order: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two triangles of the unit square bent by a quadratic map: nodes, cells, corners."""
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    weights = nodes_of(2, order) / order
    flat = np.concatenate([weights @ square[[0, 1, 2]], weights @ square[[0, 2, 3]]])
    bent = flat + 0.2 * np.column_stack([flat[:, 1] ** 2, -flat[:, 0] * flat[:, 1]])
    cells = np.arange(len(bent)).reshape(2, -1)
    return bent, cells, flat


def test_points_in_curved_cells() -> None:
    bent, cells, flat = curved(2)
    at = np.random.default_rng(1).uniform(0.02, 0.98, (50, 2))
    moved = at + 0.2 * np.column_stack([at[:, 1] ** 2, -at[:, 0] * at[:, 1]])
    found = containing(bent[cells], 2, moved)
    assert found.hit.all()
    np.testing.assert_allclose(interpolated(flat, cells, 2, found), at, atol=1e-10)
    outside = containing(bent[cells], 2, np.array([[1.5, 0.5], [-0.1, 0.5]]))
    assert not outside.hit.any()
    assert np.isnan(interpolated(flat, cells, 2, outside)).all()


def test_nearest_place_of_a_curve() -> None:
    """A parabola y = x^2 as one curve of order 2: the nearest place to (x - 2 x h, x^2 + h) is (x, x^2)."""
    x = nodes_of(1, 2)[:, 1] / 2
    corners = np.column_stack([x, x**2])[None]
    at, height = np.array([0.2, 0.5, 0.7]), 0.05
    found = nearest(corners, 2, np.column_stack([at - 2 * at * height, at**2 + height]))
    np.testing.assert_allclose(found.place[:, 1], at, atol=1e-6)
    np.testing.assert_allclose(found.distance, height * np.sqrt(1 + 4 * at**2), rtol=1e-9)
