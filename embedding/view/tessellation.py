"""Lagrange cells cut into small straight ones, on which every filter of a viewer is right.

VTK's own filters treat most of a high-order cell as straight. Here the cell's polynomials are evaluated on
a lattice of n steps an edge, and the lattice is split into segments, triangles or tetrahedra; neighbouring
cells share their nodes.
"""

from __future__ import annotations

from itertools import product

import numpy as np
import numpy.typing as npt

from embedding.archive.lagrange import CELL_TYPES, lagrange_nodes, shared_nodes

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Weights = tuple[int, ...]


class Tessellation:
    """The cells of a block of ``cell_type`` and ``order``, cut into straight simplices.

    ``simplices`` (cells, d + 1) index the fine nodes; ``values`` carries nodal values of the block to them.
    """

    def __init__(self, cells: Integers, cell_type: int, order: int, steps: int) -> None:
        dimension = next(d for d, kind in CELL_TYPES.items() if kind == cell_type)
        lattice = lattice_nodes(dimension, steps)
        fine, first = shared_nodes(cells[:, : dimension + 1], np.array(lattice, np.int64))
        small = np.array(lattice_simplices(dimension, steps), np.int64)
        self.simplices: Integers = fine[:, small].reshape(-1, dimension + 1)
        self._cells, self._cell, self._place = cells, first // len(lattice), first % len(lattice)
        self._basis = lagrange_basis(np.array(lagrange_nodes(dimension, order)), np.array(lattice) / steps)

    def values(self, nodal: npt.NDArray[np.floating]) -> Floats:
        """Values at the fine nodes of a field that is given at the nodes of the block."""
        local = nodal[self._cells[self._cell]]
        return np.asarray(np.einsum("pn,pn...->p...", self._basis[self._place], local), float)


def lattice_nodes(dimension: int, steps: int) -> list[Weights]:
    """Integer barycentric coordinates of sum ``steps``, in lexicographic order."""
    ranges = product(range(steps + 1), repeat=dimension)
    return [(steps - sum(rest), *rest) for rest in ranges if sum(rest) <= steps]


def lattice_simplices(dimension: int, steps: int) -> list[list[int]]:
    """The small simplices of the lattice as places in ``lattice_nodes``.

    Between upright copies of the big simplex are inverted ones; between tetrahedra also octahedra, split
    along a diagonal into four.
    """
    place = {node: number for number, node in enumerate(lattice_nodes(dimension, steps))}
    corners = dimension + 1

    def moved(node: Weights, *directions: int) -> int:
        return place[tuple(weight + directions.count(axis) for axis, weight in enumerate(node))]

    out = [[moved(p, axis) for axis in range(corners)] for p in lattice_nodes(dimension, steps - 1)]
    if dimension == 2 and steps > 1:
        for p in lattice_nodes(2, steps - 2):
            out.append([moved(p, 0, 1), moved(p, 1, 2), moved(p, 2, 0)])
    if dimension == 3 and steps > 1:
        for p in lattice_nodes(3, steps - 2):
            ring = [moved(p, a, b) for a, b in ((0, 2), (1, 2), (1, 3), (0, 3))]
            axis = [moved(p, 0, 1), moved(p, 2, 3)]
            out += [[*axis, ring[i], ring[(i + 1) % 4]] for i in range(4)]
    if dimension == 3 and steps > 2:
        for p in lattice_nodes(3, steps - 3):
            out.append([moved(p, *(axis for axis in range(4) if axis != left)) for left in range(4)])
    return out


def lagrange_basis(nodes: Integers, points: Floats) -> Floats:
    """Lagrange polynomials of equally spaced ``nodes`` (n, corners) at barycentric ``points`` (p, corners):
    (p, n).

    The polynomial of node a is the product over corners i and j < a_i of (k lambda_i - j) / (j + 1), with
    the order k.
    """
    order = int(nodes[0].sum())
    values = np.ones((len(points), len(nodes)))
    for step in range(order):
        factors = (order * points - step) / (step + 1)
        for corner in range(nodes.shape[1]):
            values *= np.where(nodes[None, :, corner] > step, factors[:, None, corner], 1.0)
    return values
