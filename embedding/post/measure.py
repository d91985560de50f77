"""Integrals over the cells of a patch, in the deformed configuration of the whole body."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import numpy.typing as npt

from embedding.post.cells import lagrange_basis, lagrange_slopes, nodes_of, quadrature
from embedding.post.patches import Patch

Floats = npt.NDArray[np.float64]


@cache
def shapes(dimension: int, order: int, lowered: bool) -> tuple[Floats, Floats, Floats]:
    """Values (p, n) and slopes (p, n, d) of a cell's polynomials at quadrature places, and the weights (p,).

    ``lowered`` reads the nodes as a polynomial of one order less, its values at that order's own nodes.
    """
    places, weights = quadrature(dimension, 4 * order)
    nodes = nodes_of(dimension, order)
    if not lowered:
        return lagrange_basis(nodes, places), lagrange_slopes(nodes, places), weights
    fewer = nodes_of(dimension, order - 1)
    down = lagrange_basis(nodes, fewer / (order - 1))
    return lagrange_basis(fewer, places) @ down, np.einsum(
        "pmd,mn->pnd", lagrange_slopes(fewer, places), down
    ), weights


@dataclass(frozen=True)
class Measure:
    """Quadrature over ``patch``; with ``lowered`` both the cells and the fields have one order less.

    The whole body is meant: mirror copies and the turn about the axis are in the weights (plane strain: per metre).
    """

    patch: Patch
    lowered: bool = False

    @cached_property
    def _shapes(self) -> tuple[Floats, Floats, Floats]:
        dimension = self.patch.corners.shape[2] - (not self.patch.fills)
        return shapes(dimension, self.patch.block.order, self.lowered)

    def at_points(self, nodal: npt.NDArray[np.floating]) -> Floats:
        """Nodal values of the block (nodes, ...) at the quadrature points, (cells, p, ...)."""
        return np.asarray(np.einsum("pn,cn...->cp...", self._shapes[0], np.asarray(nodal, float)[self.patch.cells]))

    @cached_property
    def points(self) -> Floats:
        """The quadrature points, (cells, p, 3)."""
        return self.at_points(self.patch.nodes)

    @cached_property
    def _tangents(self) -> Floats:
        return np.asarray(np.einsum("pnd,cnx->cpxd", self._shapes[1], self.patch.corners))

    @cached_property
    def weights(self) -> Floats:
        """Volume or area of every point, (cells, p)."""
        tangents, space = self._tangents, self.patch.space
        square = np.linalg.det(np.einsum("cpxd,cpxe->cpde", tangents, tangents))
        size = np.sqrt(np.maximum(square, 0.0)) * self._shapes[2]
        around = 2 * math.pi * self.points[:, :, 0] if space.reduction == "axisymmetric" else 1.0
        return np.asarray(size * around * space.copies)

    @cached_property
    def normals(self) -> Floats:
        """Unit normals of a patch that is a curve or a surface, (cells, p, 3); their sign is that of the cells."""
        tangents, axes = self._tangents, self.patch.space.axes
        normal = np.zeros((*tangents.shape[:2], 3))
        if len(axes) == 3:
            normal = np.cross(tangents[..., 0], tangents[..., 1])
        else:
            normal[..., axes[0]], normal[..., axes[1]] = -tangents[..., 1, 0], tangents[..., 0, 0]
        return np.asarray(normal / np.linalg.norm(normal, axis=2, keepdims=True))

    def gradient(self, nodal: npt.NDArray[np.floating]) -> Floats:
        """Spatial gradient (cells, p, 3) of a nodal scalar of a patch that fills space."""
        axes = self.patch.space.axes
        local = np.einsum("pnd,cn->cpd", self._shapes[1], np.asarray(nodal, float)[self.patch.cells])
        flat = np.linalg.solve(np.swapaxes(self._tangents, 2, 3), local[..., None])[..., 0]
        out = np.zeros((*flat.shape[:2], 3))
        out[..., axes] = flat
        return out

    def by_cell(self, values: Floats | float) -> Floats:
        """Integrals over every cell of values at the points (cells, p)."""
        return np.asarray(np.sum(values * self.weights, axis=1))


def estimated(patch: Patch, integral: Callable[[Measure], Floats]) -> tuple[float, float]:
    """The sum of an integral by cells, and by how much it changes when everything is read one order lower.

    The changes of all cells count in size, so that none hides another; for cells of order 1 the error is nan.
    """
    cells = integral(Measure(patch))
    if patch.block.order == 1:
        return float(cells.sum()), math.nan
    return float(cells.sum()), float(np.abs(cells - integral(Measure(patch, lowered=True))).sum())
