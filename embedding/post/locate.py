"""Where a point lies in curved cells: the cell and the place in it, by Newton's method on the cell's own map."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from embedding.post.cells import lagrange_basis, lagrange_slopes, nodes_of

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
WIDER = 0.15  # by which part a box around a cell's nodes is widened: a curved cell bulges between them
STEPS = 25
LARGEST = 0.5  # of a Newton step, in barycentric coordinates
WITHIN = 2e-5  # how far beside a cell, in barycentric coordinates, still counts as in it: float32 has no more
CHUNK = 4_000_000  # pairs of point and box compared at once
NEAREST = 24  # facets that are tried for the nearest point


@dataclass(frozen=True)
class Found:
    """For every point: its cell (-1 if there is none), its place there (n, corners), and how far beside it is (m)."""

    cell: Integers
    place: Floats
    distance: Floats

    @property
    def hit(self) -> npt.NDArray[np.bool_]:
        """Which points were found."""
        return np.asarray(self.cell >= 0)


def containing(corners: Floats, order: int, points: Floats) -> Found:
    """The cells of ``corners`` (cells, nodes, d), nodes of cells that fill space of d dimensions, that hold
    ``points`` (n, d)."""
    dimension = corners.shape[2]
    cell, best = np.full(len(points), -1), np.full(len(points), -np.inf)
    place = np.zeros((len(points), dimension + 1))
    pairs = _boxed(corners, points)
    at = _solved(corners[pairs[:, 1]], order, points[pairs[:, 0]])
    inside = at.min(axis=1, initial=np.inf)
    for row in np.argsort(inside):  # the deepest one comes last and stays
        point = pairs[row, 0]
        if inside[row] > max(-WITHIN, best[point]):
            cell[point], place[point], best[point] = pairs[row, 1], at[row], inside[row]
    return Found(cell, place, np.where(cell >= 0, 0.0, np.inf))


def nearest(corners: Floats, order: int, points: Floats) -> Found:
    """The nearest places of a curve or surface, ``corners`` (cells, nodes, D), to ``points`` (n, D)."""
    from scipy.spatial import cKDTree

    count, nodes, space = corners.shape
    _, close = cKDTree(corners.reshape(-1, space)).query(points, k=min(NEAREST, count * nodes))
    rows = np.repeat(np.arange(len(points)), close.size // max(1, len(points)))
    pairs = np.unique(np.column_stack([rows, np.ravel(close) // nodes]), axis=0)
    row, tried = pairs.T
    at = _projected(corners[tried], order, points[row])
    basis = lagrange_basis(nodes_of(at.shape[1] - 1, order), at)
    apart = np.linalg.norm(np.einsum("pn,pnx->px", basis, corners[tried]) - points[row], axis=1)
    best = np.lexsort((apart, row))[np.searchsorted(row, np.arange(len(points)))]  # the first of every point's
    return Found(tried[best], at[best], apart[best])


def interpolated(nodal: npt.NDArray[np.floating], cells: Integers, order: int, found: Found) -> Floats:
    """Values of nodal data (nodes, ...) of a block at the places ``found``; nan where there is none."""
    basis = lagrange_basis(nodes_of(found.place.shape[1] - 1, order), found.place)
    values = np.einsum("pn,pn...->p...", basis, np.asarray(nodal, float)[cells[found.cell]])
    values[~found.hit] = np.nan
    return np.asarray(values)


def _boxed(corners: Floats, points: Floats) -> Integers:
    """Pairs (point, cell) where the point lies in the widened box around the cell."""
    low, high = corners.min(axis=1), corners.max(axis=1)
    margin = WIDER * (high - low).max(axis=1, keepdims=True)
    low, high = low - margin, high + margin
    chunk = max(1, CHUNK // max(1, len(corners)))
    pairs = []
    for begin in range(0, len(points), chunk):
        some = points[begin : begin + chunk, None]
        near = ((some >= low) & (some <= high)).all(axis=2)
        pairs.append(np.argwhere(near) + (begin, 0))
    return np.concatenate(pairs) if pairs else np.zeros((0, 2), np.int64)


def _solved(corners: Floats, order: int, points: Floats) -> Floats:
    """Barycentric coordinates (pairs, d + 1) of points in the maps of their cells, also outside them."""
    dimension = corners.shape[2]
    nodes = nodes_of(dimension, order)
    place = np.full((len(points), dimension + 1), 1 / (dimension + 1))
    for _ in range(STEPS):
        gap = points - np.einsum("pn,pnx->px", lagrange_basis(nodes, place), corners)
        jacobian = np.einsum("pnd,pnx->pxd", lagrange_slopes(nodes, place), corners)
        step = _bounded(_least_squares(jacobian, gap))
        place[:, 1:] += step
        place[:, 0] = 1 - place[:, 1:].sum(axis=1)
        if not (np.abs(step) > 1e-12).any():
            break
    return place


def _projected(corners: Floats, order: int, points: Floats) -> Floats:
    """Barycentric coordinates of the nearest places in each cell: Gauss-Newton steps, kept within the cell."""
    dimension = next(d for d in (1, 2) if len(nodes_of(d, order)) == corners.shape[1])
    nodes = nodes_of(dimension, order)
    weights = nodes / order
    at_nodes = np.linalg.norm(corners - points[:, None], axis=2).argmin(axis=1)
    place = np.array(weights[at_nodes], float) * 0.98 + 0.02 / (dimension + 1)
    for _ in range(STEPS):
        gap = points - np.einsum("pn,pnx->px", lagrange_basis(nodes, place), corners)
        jacobian = np.einsum("pnd,pnx->pxd", lagrange_slopes(nodes, place), corners)
        before = place.copy()
        place[:, 1:] += _bounded(_least_squares(jacobian, gap))
        place[:, 0] = 1 - place[:, 1:].sum(axis=1)
        place = np.clip(place, 0.0, None)
        place /= place.sum(axis=1, keepdims=True)
        if not (np.abs(place - before) > 1e-12).any():
            break
    return place


def _least_squares(jacobian: Floats, gap: Floats) -> Floats:
    square = np.einsum("pxd,pxe->pde", jacobian, jacobian)
    size = np.trace(square, axis1=1, axis2=2)[:, None, None]
    square = square + 1e-14 * size * np.eye(square.shape[1])
    return np.asarray(np.linalg.solve(square, np.einsum("pxd,px->pd", jacobian, gap)[..., None])[..., 0])


def _bounded(step: Floats) -> Floats:
    largest = np.abs(step).max(axis=1, keepdims=True, initial=0.0)
    return np.asarray(step * np.minimum(1.0, LARGEST / np.maximum(largest, 1e-300)))
