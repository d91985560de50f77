"""Pictures of finite element fields on VTK's Lagrange cells: node tables and sampling.

VTK cells of arbitrary order (curve, triangle, tetrahedron) are interpolated from equally spaced nodes,
numbered by vertices, edges, faces, interior. Node positions are kept as integer barycentric coordinates, so
that shared nodes are recognised exactly, by topology and not by distance. Order of the nodes: W. Schroeder
et al., VTK file formats, section "Lagrange cells"; classes ``vtkHigherOrderCurve``,
``vtkHigherOrderTriangle``, ``vtkLagrangeTetra``.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, VOL, IntegrationRule, x, y, z

from embedding.errors import ArchiveError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Node = tuple[int, ...]

ROUNDING = 1e-12
CELL_TYPES = {1: 68, 2: 69, 3: 71}  # VTK_LAGRANGE_CURVE, _TRIANGLE, _TETRAHEDRON by dimension of the cell
EDGES = {1: ((0, 1),), 2: ((0, 1), (1, 2), (2, 0)), 3: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))}
TETRAHEDRON_FACES = ((0, 1, 3), (2, 3, 1), (0, 3, 2), (0, 2, 1))
TOWARDS_CENTRE = 1e-4  # a field that is singular at a node (hoop stretch on the axis) is read this far inside


def lagrange_nodes(dimension: int, order: int) -> list[Node]:
    """Integer barycentric coordinates (their sum is ``order``) of a cell's nodes in VTK's numbering.

    ``dimension`` is 1 (curve), 2 (triangle) or 3 (tetrahedron). The nodes inside a face or a cell are those
    of a smaller cell of the same kind, shifted by one.
    """
    corners = dimension + 1
    if order == 0:
        return [(0,) * corners]
    nodes = [_node(corners, {corner: order}) for corner in range(corners)]
    for a, b in EDGES[dimension]:
        nodes += [_node(corners, {a: order - i, b: i}) for i in range(1, order)]
    if dimension == 3 and order > 2:
        for face in TETRAHEDRON_FACES:
            inner = lagrange_nodes(2, order - 3)
            nodes += [_node(4, dict(zip(face, (w + 1 for w in weights), strict=True))) for weights in inner]
    if 1 < dimension < order:
        nodes += [tuple(w + 1 for w in weights) for weights in lagrange_nodes(dimension, order - corners)]
    return nodes


def _node(corners: int, weights: dict[int, int]) -> Node:
    return tuple(weights.get(corner, 0) for corner in range(corners))


def shared_nodes(vertices: Integers, nodes: Integers) -> tuple[Integers, Integers]:
    """Number the nodes of many cells so that cells share those on common vertices, edges and faces.

    ``vertices`` (cells, corners) are numbers of mesh vertices, ``nodes`` (nodes, corners) barycentric
    coordinates. Returns the connectivity (cells, nodes) and, for every shared node, its first place in the
    flattened connectivity. Two nodes are the same if their sets of (vertex, weight) pairs with nonzero
    weight are.
    """
    corners = nodes.shape[1]
    base = int(nodes.max()) + 1
    pairs = np.where(nodes[None] > 0, (vertices[:, None, :] + 1) * base + nodes[None], 0).reshape(-1, corners)
    pairs.sort(axis=1)
    key = np.zeros((len(pairs), 2), np.int64)  # two pairs of 31 bits in each of two words
    for column in range(corners):
        key[:, column // 2] = (key[:, column // 2] << 31) | pairs[:, column]
    order = np.lexsort((key[:, 1], key[:, 0]))
    fresh = np.ones(len(key), bool)
    fresh[1:] = (key[order[1:]] != key[order[:-1]]).any(axis=1)
    group = np.empty(len(key), np.int64)
    group[order] = np.cumsum(fresh) - 1
    first = order[fresh]
    by_place = np.argsort(first)  # neighbours in the mesh stay neighbours in the file
    rank = np.empty(len(first), np.int64)
    rank[by_place] = np.arange(len(first))
    return rank[group].reshape(len(vertices), len(nodes)), first[by_place]


class LagrangeBlock:
    """One region of a mesh as VTK Lagrange cells, and the sampling of coefficient functions on their nodes.

    Parameters: ``mesh`` of dimension 2 or 3 made of segments, triangles and tetrahedra; ``region`` of
    codimension 0 or 1 (an NGSolve ``Region``); ``order`` of the cells; ``continuous`` merges the nodes that
    cells share (a field that jumps between cells is then averaged there), else every cell has its own;
    ``embed`` maps mesh coordinates (n, d) to three-dimensional space (n, 3); functions are evaluated inside
    the context that ``within`` makes.

    Attributes: ``points`` (n, 3), ``cells`` (cells, nodes of a cell), ``cell_type`` (VTK's number),
    ``order``. Raises ArchiveError if the region has no elements or other than simplicial ones.
    """

    def __init__(
        self,
        mesh: Any,
        region: Any,
        order: int,
        continuous: bool,
        embed: Callable[[Floats], Floats],
        within: Callable[[], AbstractContextManager[None]] = nullcontext,
    ) -> None:
        self.mesh, self.region, self.order, self._within = mesh, region, order, within
        codimension = {VOL: 0, BND: 1}.get(region.VB())
        if codimension is None:
            raise ArchiveError(f"a block needs a region of codimension 0 or 1, not {region.VB()}")
        self.dimension = mesh.dim - codimension
        self.cell_type = CELL_TYPES[self.dimension]
        self._nodes = np.array(lagrange_nodes(self.dimension, order), np.int64)
        count = len(self._nodes)
        self._places = self._map(self._nodes / order)
        if len(self._places) == 0:
            raise ArchiveError("a block's region has no elements in this mesh")
        vertices = self._vertices(self._places["nr"][::count])
        if continuous:
            self.cells, self._first = shared_nodes(vertices, self._nodes)
        else:
            self.cells = np.arange(len(vertices) * count, dtype=np.int64).reshape(-1, count)
            self._first = self.cells.ravel()
        self._sharing = np.bincount(self.cells.ravel()).astype(float)
        position = CF((x, y, z)) if mesh.dim == 3 else CF((x, y))
        with within():
            places = np.asarray(position(self._places[self._first]))
        # A plane must be one for viewers, too: VTK's cleaning of points does not end on one with rounding across it.
        rounding = ROUNDING * np.abs(places).max(initial=0.0)
        self.points = embed(np.where(np.abs(places) < rounding, 0.0, places))

    @property
    def point_count(self) -> int:
        """Number of nodes."""
        return len(self._first)

    def sample(self, values: Any, average: bool = True) -> Floats:
        """Values of a real coefficient function at the nodes, (n,) for a scalar and (n, components) for a
        vector.

        With ``average`` a shared node gets the mean over its cells; without, the value of one of them,
        which is the same for a continuous field and several times cheaper. Where the function is not finite
        at a node it is read a little inside the cell instead.
        """
        with self._within():
            sampled = self._evaluate(values, slice(None) if average else self._first)
        if average and len(self._first) < len(self._places):
            nodes = self.cells.ravel()
            sums = [np.bincount(nodes, column, len(self._first)) for column in sampled.T]
            sampled = np.stack(sums, axis=1) / self._sharing[:, None]
        return sampled[:, 0] if values.dim == 1 else sampled

    def _evaluate(self, values: Any, rows: slice | Integers) -> Floats:
        sampled = np.asarray(values(self._places[rows]), dtype=float).reshape(-1, values.dim)
        bad = np.flatnonzero(~np.isfinite(sampled).all(axis=1))
        if len(bad):
            sampled = sampled.copy()
            sampled[bad] = np.asarray(values(self._inside[rows][bad]), dtype=float).reshape(-1, values.dim)
        return sampled

    @cached_property
    def _inside(self) -> Any:
        weights = self._nodes / self.order
        return self._map((1 - TOWARDS_CENTRE) * weights + TOWARDS_CENTRE / (self.dimension + 1))

    def _map(self, weights: Floats) -> Any:
        """Mesh points of barycentric ``weights`` (nodes, corners) in all elements of the region.

        NGSolve's reference simplex has the coordinate x_i as the weight of vertex i and its last vertex at
        the origin, VTK's has its first vertex there: VTK's vertices are NGSolve's, with the last one moved
        to the front.
        """
        reference = np.zeros((len(weights), 3))
        reference[:, : self.dimension] = weights[:, 1:]
        rule = IntegrationRule([tuple(map(float, point)) for point in reference], [0.0] * len(reference))
        return self.mesh.MapToAllElements(rule, self.region)

    def _vertices(self, elements: Integers) -> Integers:
        by_number = {}
        for element in self.region.Elements():
            if len(element.vertices) != self.dimension + 1:
                raise ArchiveError(f"a block takes simplicial elements only, not {element.type}")
            by_number[element.nr] = [vertex.nr for vertex in element.vertices]
        vertices = np.array([by_number[int(number)] for number in elements], np.int64)
        return np.roll(vertices, 1, axis=1)
