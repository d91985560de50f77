"""Small simplices fill the cells they are cut from, and the polynomials on them are exact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from embedding.archive.lagrange import CELL_TYPES, LagrangeBlock, lagrange_nodes
from embedding.view.labels import label, prefixed, quantity, round_length
from embedding.view.tessellation import Tessellation, lagrange_basis, lattice_nodes, lattice_simplices
from tests.archive.made_up_run import octant


@pytest.mark.parametrize("steps", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_small_simplices_fill_the_big_one(dimension: int, steps: int) -> None:
    places = np.array(lattice_nodes(dimension, steps))[:, 1:] / steps
    corners = places[np.array(lattice_simplices(dimension, steps))]
    sizes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / math.factorial(dimension)
    assert len(sizes) == steps**dimension
    np.testing.assert_allclose(sizes, 1 / math.factorial(dimension) / steps**dimension)


@pytest.mark.parametrize("order", [1, 2, 3, 4])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_basis_is_one_at_its_node_and_reproduces_polynomials(dimension: int, order: int) -> None:
    nodes = np.array(lagrange_nodes(dimension, order))
    np.testing.assert_allclose(lagrange_basis(nodes, nodes / order), np.eye(len(nodes)), atol=1e-12)
    weights = np.random.default_rng(3).dirichlet(np.ones(dimension + 1), 20)
    basis = lagrange_basis(nodes, weights)
    np.testing.assert_allclose(basis @ (nodes[:, 0] / order) ** order, weights[:, 0] ** order, atol=1e-12)


def test_fine_cells_share_nodes_and_keep_the_shape() -> None:
    mesh = octant(1.0, 3)
    block = LagrangeBlock(mesh, mesh.Materials("inside"), 3, True, lambda points: points)
    fine = Tessellation(block.cells, block.cell_type, 3, 4)
    points = fine.values(block.points)
    assert len(np.unique(np.round(points, 9), axis=0)) == len(points)
    corners = points[fine.simplices]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6
    assert volume == pytest.approx(math.pi / 6, rel=1e-2)
    np.testing.assert_allclose(fine.values(block.points[:, 0] ** 3), points[:, 0] ** 3, atol=5e-3)
    assert CELL_TYPES[3] == block.cell_type


@pytest.mark.parametrize(
    ("size", "unit", "words"),
    [(6000.0, "V", "6 kV"), (2.5e-7, "C", "250 nC"), (999.0, "Pa", "999 Pa"), (0.02, "m", "20 mm"),
     (1.3, "1", "1.3000"), (0.0, "V", "0 V"), (-4.2e6, "V/m", "-4.2 MV/m"), (1000.0, "Pa", "1 kPa")],
)  # fmt: skip
def test_numbers_with_units(size: float, unit: str, words: str) -> None:
    assert quantity(size, unit) == words


def test_labels() -> None:
    assert prefixed(7e5, "V/m") == (1e-3, "kV/m")
    assert prefixed(math.nan, "V") == (1.0, "V")
    assert label("E", "MV/m") == "electric field $|E|$ [MV/m]"
    assert label("my_field", "") == "my field"
    assert [round_length(x) for x in (0.0237, 1.0, 0.049, 7.0)] == pytest.approx([0.02, 1.0, 0.02, 5.0])
