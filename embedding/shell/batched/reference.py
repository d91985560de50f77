"""NGSolve's bases on the reference triangle, one for each order of the numbers of its vertices.

A basis function of an element depends on the mesh only through the order of its vertices' numbers, which directs edges.
The functions are read from meshes of one triangle, numbered in each of the six ways.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from netgen.meshing import Element2D, FaceDescriptor, MeshPoint, Pnt
from netgen.meshing import Mesh as NetgenMesh
from ngsolve import BND, CF, H1, ElementId, GridFunction, HCurlCurl, HDivDivSurface, Mesh, VectorFacetSurface, x, y

from embedding.shell.batched.polynomials import Array, as_rule, exponents, lattice, monomials, segment_rule, through

Orientation = tuple[int, int, int]
"""Ranks of the three vertices' numbers."""

CORNERS = ((1.0, 0.0), (0.0, 1.0), (0.0, 0.0))
EDGES = ((0, 2), (2, 1), (1, 0))
"""NGSolve's edges, each against the order of the corners: a quarter turn takes such a tangent to the outward side."""
COMPONENTS = ((0, 0), (0, 1), (1, 1))
"""The components that determine a symmetric tensor."""


@cache
def _triangle(orientation: Orientation) -> tuple[Mesh, Any]:
    """The reference triangle as a mesh, and its region."""
    mesh = NetgenMesh(dim=3)
    numbers = {corner: mesh.Add(MeshPoint(Pnt(*CORNERS[corner], 0.0))) for corner in np.argsort(orientation).tolist()}
    mesh.Add(FaceDescriptor(bc=1, domin=1, domout=0, surfnr=1))
    mesh.Add(Element2D(1, [numbers[corner] for corner in range(3)]))
    whole = Mesh(mesh)
    return whole, whole.Boundaries(".*")


def displacement_basis(orientation: Orientation, order: int) -> Array:
    """Coefficients (monomials, n) of the shape functions of ``H1``."""
    mesh, _ = _triangle(orientation)
    element = H1(mesh, order=order).GetFE(ElementId(BND, 0))
    return through(order, np.array([np.array(element.CalcShape(*point)) for point in lattice(order)]))


def moment_basis(orientation: Orientation, order: int) -> Array:
    """Coefficients (monomials, 3, n) of the shape functions of ``HDivDivSurface``: components 11, 12 and 22."""
    mesh, region = _triangle(orientation)
    field = GridFunction(HDivDivSurface(mesh, order=order, discontinuous=True))
    points = mesh.MapToAllElements(as_rule(lattice(order)), region)
    columns = []
    for number in range(field.space.ndof):
        field.vec[:] = 0.0
        field.vec[number] = 1.0
        columns.append(_components(field, points))
    return through(order, np.stack(columns, axis=2))


def frame_basis(orientation: Orientation, order: int, degree: int) -> Array:
    """Shape functions (3, p, n) of one component of ``VectorFacetSurface`` on the three edges, at the Gauss points of
    ``degree``.

    Found from the unknowns of given polynomials.
    """
    mesh, region = _triangle(orientation)
    field = GridFunction(VectorFacetSurface(mesh, order=order))
    unknowns = np.array(field.space.GetDofNrs(ElementId(BND, 0)))[: 3 * (order + 1)].reshape(3, -1)
    given = []
    for i, j in exponents(order):
        field.Set(CF((x**i * y**j, 0.0, 0.0)), dual=True, definedon=region)
        given.append(np.array(field.vec.FV().NumPy())[unknowns])
    values = np.array(given)
    seen = [monomials(order, points).T for points in edge_points(degree)]
    return np.stack([np.linalg.lstsq(values[:, i], seen[i], rcond=None)[0].T for i in range(3)])


def edge_points(degree: int) -> Array:
    """The Gauss points of ``degree`` on each edge, shape (3, p, 2)."""
    places, _ = segment_rule(degree)
    starts, ends = (np.array([CORNERS[edge[i]] for edge in EDGES])[:, None] for i in (0, 1))
    return np.asarray(starts + places[:, None] * (ends - starts))


@cache
def interpolation(order: int, degree: int) -> Array:
    """Coefficients (monomials, 3, given monomials, 3) of the interpolation to ``HCurlCurl`` of polynomials of
    ``degree``: from components 11, 12, 22 of a tensor to those of another.

    It is the same for each orientation, and commutes with the map to an element, curved or not.
    """
    mesh, region = _triangle((0, 1, 2))
    field = GridFunction(HCurlCurl(mesh, order=order, discontinuous=True, definedon=region))
    points = mesh.MapToAllElements(as_rule(lattice(order)), region)
    out = np.zeros((len(exponents(order)), 3, len(exponents(degree)), 3))
    for number, (i, j) in enumerate(exponents(degree)):
        for component, (row, column) in enumerate(COMPONENTS):
            tensor: list[Any] = [CF(0.0)] * 9
            tensor[3 * row + column] = tensor[3 * column + row] = x**i * y**j
            field.Set(CF(tuple(tensor)).Reshape((3, 3)), dual=True, definedon=region)
            out[:, :, number, component] = through(order, _components(field, points))
    return out


def _components(field: GridFunction, points: Any) -> Array:
    values = np.asarray(field(points)).reshape(-1, 3, 3)
    return np.stack([values[:, i, j] for i, j in COMPONENTS], axis=1)
