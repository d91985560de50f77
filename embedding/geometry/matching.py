"""Two meshes with the same shell: which of their elements are one, and fields carried from one to the other."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, ElementId, IntegrationRule

from embedding.geometry.facets import Facets, Integers

Floats = npt.NDArray[np.float64]
SAME = 1e-7
"""Vertices closer than this, in shell sizes, are one."""


@dataclass(frozen=True)
class Matching:
    """For every element of the ``new`` shell the ``row`` (n,) of the same one in the ``old``, and for each of its
    corners the one of the old element (n, d)."""

    old: Facets
    new: Facets
    row: Integers
    corner: Integers

    @classmethod
    def of(cls, old: Facets, places: Floats, new: Facets) -> Matching:
        """Match elements by their corners; ``places`` (n, d, d) are where those of the old shell lie now.

        Raises:
            ValueError: the shells are not the same.
        """
        nearest = nearest_of(places.reshape(-1, places.shape[2]), new.points.reshape(-1, new.mesh.dim), SAME)
        if len(old.numbers) != len(new.numbers) or nearest.min() < 0:
            raise ValueError("the shells have not the same elements")
        vertices: Integers = old.corners.ravel()[nearest].reshape(new.corners.shape)
        rows = {frozenset(corners): row for row, corners in enumerate(old.corners.tolist())}
        row = np.array([rows.get(frozenset(corners), -1) for corners in vertices.tolist()])
        if row.min() < 0:
            raise ValueError("the shells have not the same elements")
        corner = np.argmax(old.corners[row][:, None, :] == vertices[:, :, None], axis=2)
        return cls(old, new, row, corner)

    def after(self, other: Matching) -> Matching:
        """How the new elements are those of the old shell of ``other``, whose new shell is the old one here."""
        corner = np.take_along_axis(other.corner[self.row], self.corner, axis=1)
        return Matching(other.old, self.new, other.row[self.row], corner)

    def turns(self) -> Integers:
        """-1 where the corners of an element run the other way than in the old mesh, else 1."""
        return np.array([round(np.linalg.det(np.eye(len(order))[order])) for order in self.corner], np.int64)

    def sampled(self, values: Any, order: int) -> Floats:
        """A function on the old shell at the points of :func:`lattice` in the elements of the new one, (n, points,
        components)."""
        grid, known = lattice(self.old.corners.shape[1], order), on_lattice(self.old, values, order)
        out = np.empty_like(known)
        for turned in np.unique(self.corner, axis=0):
            # Weights of the new element's corners, put where the old element has these corners.
            there = np.empty_like(grid)
            there[:, turned] = grid
            rows = np.flatnonzero((self.corner == turned).all(axis=1))
            out[rows] = known[self.row[rows]][:, nearest_of(grid, there)]
        return out


def nearest_of(places: Floats, points: Floats, within: float = np.inf) -> Integers:
    """Number of the one of ``places`` (m, d) nearest to each of ``points`` (n, d), -1 where none is ``within``."""
    from scipy.spatial import cKDTree  # slow to load, and few runs come here

    distance, number = cKDTree(places).query(points)
    return np.where(np.asarray(distance) <= within, number, -1).astype(np.int64)


def on_lattice(facets: Facets, values: Any, order: int) -> Floats:
    """A function at the points of :func:`lattice` in all elements of a shell, shape (n, points, components)."""
    rule = [tuple(map(float, weights[:-1])) for weights in lattice(facets.corners.shape[1], order)]
    points = facets.mesh.MapToAllElements(IntegrationRule(rule, [0.0] * len(rule)), facets.region)
    return np.asarray(CF(values)(points)).reshape(len(facets.numbers), len(rule), -1)


def lattice(corners: int, order: int) -> Floats:
    """Weights (points, corners) of equally spaced points of a simplex, which determine a polynomial of ``order``; of
    order 1 the corners. NGSolve's local coordinates are the weights of all corners but the last."""
    counts = [c for c in product(range(order, -1, -1), repeat=corners) if sum(c) == order]
    return np.array(counts, dtype=np.float64) / order


def put(space: Any, facets: Facets, samples: Floats) -> Floats:
    """Unknowns (components, space.ndof) of a scalar ``space`` on the shell's elements that have the ``samples``
    (n, points, components) on their lattice, polynomials of the space's order; zero elsewhere."""
    corners = facets.corners.shape[1]
    grid = lattice(corners, space.globalorder)
    unknowns = np.zeros((samples.shape[2], space.ndof))
    for number, values in zip(facets.numbers, samples, strict=True):
        element = ElementId(BND, int(number))
        finite = space.GetFE(element)
        shapes = np.array([np.array(finite.CalcShape(*point[:-1])).ravel() for point in grid])
        unknowns[:, list(space.GetDofNrs(element))] = np.linalg.solve(shapes, values).T
    return unknowns
