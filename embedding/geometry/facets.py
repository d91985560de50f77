"""How the elements of the mid-surface hang together: over edges of triangles, or over the ends of segments.

A *facet* is an edge of the mesh in 3D and a vertex in two dimensions. Masks over facets are numbered like those.
"""

from __future__ import annotations

from collections import deque
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BBND, CF, IntegrationRule, Mesh

from embedding.geometry.positions import reference_positions

Mask = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

INNER = "between elements"
"""Name of what only looks like an edge of the geometry: a facet of a mesh that another mesh is made around."""
KINK = np.radians(1.0)
"""Smallest angle, in rad, that counts as a kink where faces of the geometry meet."""
Local = tuple[tuple[tuple[int, ...], tuple[float, ...]], ...]
_TRIANGLE: Local = (((0, 1), (0.5, 0.5)), ((1, 2), (0.0, 0.5)), ((0, 2), (0.5, 0.0)))
_SEGMENT: Local = (((0,), (1.0,)), ((1,), (0.0,)))
"""Local facets of the reference elements: their local vertices and their middle (NGSolve's vertices are 1, 0 and
(1, 0), (0, 1), (0, 0))."""


class OneSidedError(ValueError):
    """The surface has only one side, like a Moebius strip."""


class Facets:
    """Neighbourhood of the elements of ``region``, a boundary region of ``mesh``.

    Arrays over the elements follow the order of ``region.Elements()``, which is that of ``MapToAllElements``.
    """

    def __init__(self, mesh: Mesh, region: Any) -> None:
        self.mesh, self.region = mesh, region
        self.local = _TRIANGLE if mesh.dim == 3 else _SEGMENT
        elements = list(region.Elements())
        self.numbers: Integers = np.array([element.nr for element in elements])
        self.corners: Integers = np.array([[v.nr for v in element.vertices] for element in elements])
        self.of_element: Integers = np.array([self._facets(element) for element in elements])
        self.points: Floats = reference_positions(mesh)[self.corners]

    def _facets(self, element: Any) -> list[int]:
        """Numbers of the facets of one element, in the order of ``local``."""
        if self.mesh.dim == 2:
            return [element.vertices[local[0]].nr for local, _ in self.local]
        ends = {frozenset(v.nr for v in self.mesh[edge].vertices): edge.nr for edge in element.edges}
        return [ends[frozenset(element.vertices[i].nr for i in local)] for local, _ in self.local]

    @cached_property
    def count(self) -> int:
        """Number of facets of the whole mesh."""
        return int(self.mesh.nedge if self.mesh.dim == 3 else self.mesh.nv)

    @cached_property
    def neighbours(self) -> Integers:
        """How many elements of the region meet in each facet of the mesh."""
        return np.bincount(self.of_element.ravel(), minlength=self.count)

    @cached_property
    def pairs(self) -> Integers:
        """Rows (facet, element, its local facet, other element, its local facet) where just two elements meet."""
        sides = self.of_element.shape[1]
        order = np.argsort(self.of_element.ravel(), kind="stable")
        facets = self.of_element.ravel()[order]
        first = np.flatnonzero((facets[:-1] == facets[1:]) & (self.neighbours[facets[:-1]] == 2))
        one, other = order[first], order[first + 1]
        return np.stack([facets[first], one // sides, one % sides, other // sides, other % sides], axis=1)

    @cached_property
    def corner_normals(self) -> Floats:
        """Normals given by the order of the corners, as long as the element is large; shape (n, d)."""
        along = self.points[:, 1:] - self.points[:, :1]
        if self.mesh.dim == 3:
            return np.asarray(np.cross(along[:, 0], along[:, 1]) / 2)
        return np.stack([along[:, 0, 1], -along[:, 0, 0]], axis=1)

    @cached_property
    def parts(self) -> Integers:
        """Number of the part each element belongs to: parts are joined by facets of just two elements."""
        return self._walked[0]

    @cached_property
    def turns(self) -> Integers:
        """+1 or -1 for each element: times it, the ``corner_normals`` of a part are on one and the same side.

        Raises:
            OneSidedError: there is no such side.
        """
        return self._walked[1]

    @cached_property
    def _walked(self) -> tuple[Integers, Integers]:
        _, one, local_one, other, local_other = self.pairs.T
        starts = np.array([vertices[0] for vertices, _ in self.local])
        same = self.corners[one, starts[local_one]] == self.corners[other, starts[local_other]]
        if self.mesh.dim == 3:  # the local facet (0, 2) runs against the order of the corners
            same ^= (local_one == 2) != (local_other == 2)
        else:  # head to head or tail to tail
            same = local_one == local_other
        links: list[list[tuple[int, int]]] = [[] for _ in self.numbers]
        for a, b, turned in zip(one.tolist(), other.tolist(), np.where(same, -1, 1).tolist(), strict=True):
            links[a].append((b, turned))
            links[b].append((a, turned))
        part, turn = np.full(len(links), -1), np.ones(len(links), np.int64)
        for seed in range(len(links)):
            if part[seed] >= 0:
                continue
            part[seed] = part.max() + 1
            queue = deque([seed])
            while queue:
                here = queue.popleft()
                for there, turned in links[here]:
                    if part[there] < 0:
                        part[there], turn[there] = part[here], turn[here] * turned
                        queue.append(there)
        if np.any(turn[one] * turn[other] != np.where(same, -1, 1)):
            raise OneSidedError("the surface has only one side")
        return part, turn

    def at_facets(self, values: Any) -> Floats:
        """A vector function at the middles of every element's facets, shape (n, local facets, d)."""
        rule = IntegrationRule([middle for _, middle in self.local], [1.0] * len(self.local))
        points = self.mesh.MapToAllElements(rule, self.region)
        return np.asarray(CF(values)(points)).reshape(len(self.numbers), len(self.local), -1)

    def at_centres(self, values: Any) -> Floats:
        """A vector function at the centre of every element, shape (n, d)."""
        rule = IntegrationRule([(1 / 3, 1 / 3)], [0.5]) if self.mesh.dim == 3 else IntegrationRule([(0.5,)], [1.0])
        points = self.mesh.MapToAllElements(rule, self.region)
        return np.asarray(CF(values)(points)).reshape(len(self.numbers), -1)

    @cached_property
    def on_edges(self) -> Mask:
        """Facets on edges of the geometry (in two dimensions: points where its curves end)."""
        mask = np.zeros(self.count, bool)
        for element in (one for one in self.mesh.Elements(BBND) if one.mat != INNER):
            mask[[edge.nr for edge in element.edges] if self.mesh.dim == 3 else [v.nr for v in element.vertices]] = True
        return mask

    def named(self, name: str) -> Mask:
        """Facets on the edges of the geometry with this name."""
        mask = np.zeros(self.count, bool)
        for element in self.mesh.BBoundaries(name).Elements():
            mask[[edge.nr for edge in element.edges] if self.mesh.dim == 3 else [v.nr for v in element.vertices]] = True
        return mask

    def kinks(self, normal: Any, least: float = KINK) -> Mask:
        """Facets between two elements across which the unit ``normal`` jumps.

        Within a smooth face the normals of curved elements jump a little as well, by the error of the geometry. A kink
        lies on an edge of the geometry, is at least the angle ``least`` and twice as large as the largest of those
        jumps.
        """
        facet, angle = self._jumps(normal)
        mask = np.zeros(self.count, bool)
        mask[facet[self._kinked(facet, angle, least)]] = True
        return mask

    def sharpest(self, normal: Any) -> float:
        """The largest angle of the kinks, in rad; 0 without any."""
        facet, angle = self._jumps(normal)
        return float(angle[self._kinked(facet, angle, KINK)].max(initial=0.0))

    def _kinked(self, facet: Integers, angle: Floats, least: float) -> Mask:
        """Which of the jumps by an ``angle`` at each ``facet`` are kinks."""
        candidates = self.on_edges[facet]
        return np.asarray(candidates & (angle > max(least, 2 * angle[~candidates].max(initial=0.0))))

    def _jumps(self, normal: Any) -> tuple[Integers, Floats]:
        """Facets between two elements, and the angle by which the unit ``normal`` jumps there."""
        facet, one, local_one, other, local_other = self.pairs.T
        normals = self.at_facets(normal)
        gap = np.linalg.norm(normals[one, local_one] - normals[other, local_other], axis=1)
        return facet, 2 * np.arcsin(np.minimum(gap / 2, 1.0))
