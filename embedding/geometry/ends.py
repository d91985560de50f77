"""Facets of the shell by number (edges of triangles, vertices where the shell is a curve), and what lives on them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import EDGE, VERTEX, NodeId

from embedding.geometry.facets import Facets, Integers
from embedding.geometry.positions import reference_positions
from embedding.geometry.spaces import ON_PLANE


def facets_named(facets: Facets, names: Iterable[str]) -> Integers:
    """Numbers of the facets on the geometry's edges ``names``."""
    return np.flatnonzero(np.any([np.zeros(facets.count, bool), *(facets.named(name) for name in names)], axis=0))


def facets_on_plane(facets: Facets, axis: int) -> Integers:
    """Numbers of the shell's facets on the coordinate plane number ``axis``."""
    on = np.array([abs(v.point[axis]) < ON_PLANE for v in facets.mesh.vertices])
    if facets.mesh.dim == 2:
        return np.flatnonzero(on & (facets.neighbours > 0))
    used = np.flatnonzero(facets.neighbours > 0)
    ends = np.array([[v.nr for v in facets.mesh[NodeId(EDGE, int(e))].vertices] for e in used])
    return np.asarray(used[on[ends].all(axis=1)])


def directions(facets: Facets, numbers: Integers) -> npt.NDArray[np.float64]:
    """Unit vectors along the chords of mesh edges, shape (n, 3)."""
    mesh, places = facets.mesh, reference_positions(facets.mesh)
    ends = np.array([[v.nr for v in mesh[NodeId(EDGE, int(e))].vertices] for e in numbers], np.int64).reshape(-1, 2)
    along = places[ends[:, 1]] - places[ends[:, 0]]
    return np.asarray(along / np.linalg.norm(along, axis=1, keepdims=True))


def unknowns_on(space: Any, facets: Integers, components: Iterable[int] | None = None) -> Integers:
    """Unknowns of ``space`` on ``facets``; for a space of vectors ``components`` picks some of its three blocks."""
    kind = EDGE if space.mesh.dim == 3 else VERTEX
    numbers = [space.GetDofNrs(NodeId(kind, int(e))) for e in facets]
    if components is not None:
        numbers = [np.array_split(np.array(dofs), 3)[c] for dofs in numbers for c in components]
    return np.array([d for dofs in numbers for d in dofs], np.int64)
