"""A new mesh of the space around a deformed shell, with the same elements on the shell.

The mesh is made where the shell is *now*; forms on the shell go on to be written where it came from. Two deformations
of the mesh keep both. Its own one, which NGSolve applies wherever none is given, takes the shell's elements back to the
reference mid-surface X: all that is on the shell is as it was. Integrals over the ambient take another, which only
curves the straight elements beside the shell: they start from the configuration the mesh was made in, the *base*, and
a displacement u of the shell counts there as u - u_0, with u_0 the one the mesh was made at. Elements that an inflating
or turning shell has worn out are good again, and nothing of the shell's state changes. Theory page, "Remeshing".
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BBND, CF, H1, GridFunction, VectorH1, x, y, z

from embedding.errors import SceneError
from embedding.geometry import meshing
from embedding.geometry.cut import CloseSheetsError
from embedding.geometry.domain import Base, Domain, MeshSizes
from embedding.geometry.facets import Facets
from embedding.geometry.matching import Matching, on_lattice, put
from embedding.geometry.outline import NoMeshError
from embedding.geometry.polyhedron import Polyhedron
from embedding.geometry.surroundings import BodyError

Floats = npt.NDArray[np.float64]
TOUCHING = 1e-6
"""Vertices closer than this, in shell sizes, cannot be told apart."""
GROWTHS = (1.0, 0.7)
"""Gradings that are tried, over the one asked for."""


class RemeshingError(RuntimeError):
    """There is no sound mesh around the deformed shell."""


@dataclass(frozen=True)
class Remeshed:
    """A ``domain`` around a deformed shell, and how its shell's elements match those of the one before."""

    domain: Domain
    matching: Matching


def remeshed(domain: Domain, displacement: Any) -> Remeshed:
    """A new ambient around the shell of ``domain`` at its ``displacement`` (grid function on the shell, dimensionless).

    Raises:
        RemeshingError: the shell touches itself or a body, or the mesh generator gave up.
    """
    for growth in GROWTHS:
        sizes = replace(domain.sizes, grading=growth * domain.sizes.grading)
        try:
            found = _around(domain, displacement, sizes)
        except (BodyError, NoMeshError, CloseSheetsError, SceneError, ValueError) as error:
            raise RemeshingError(str(error)) from error
        if found.domain.unfolded:
            return found
    raise RemeshingError("elements around the curved shell are folded")


def _around(domain: Domain, displacement: Any, sizes: MeshSizes) -> Remeshed:
    old = domain.facets
    moved = on_lattice(old, domain.reduction.position + displacement, 1)
    polyhedron = _polyhedron(domain, moved)
    upward = np.sign(np.einsum("ij,ij->i", domain.facets.at_centres(domain.normal), old.corner_normals))

    def up(facets: Facets) -> Floats:
        matching = Matching.of(old, moved, facets)
        return np.asarray((upward[matching.row] * matching.turns())[:, None] * facets.corner_normals)

    made = meshing.around(polyhedron.outline(), domain.reduction, sizes, up)
    made.mesh.Curve(sizes.order)
    fresh = Domain(made.mesh, domain.reduction, domain.shape, sizes, made.faces, made.rim_vertices, made.rim_edges)
    if len(fresh.rim_vertices) != len(domain.rim_vertices):
        raise RemeshingError("the shell touches itself")
    matching = Matching.of(old, moved, Facets(made.mesh, fresh.shell))
    base = _base(domain, displacement, matching)
    made.mesh.SetDeformation(base.reference)
    return Remeshed(replace(fresh, base=base), matching)


def _polyhedron(domain: Domain, moved: Floats) -> Polyhedron:
    """The shell with its corners ``moved`` (n, d, d)."""
    from scipy.spatial import cKDTree  # slow to load, and few runs come here

    facets, mesh = domain.facets, domain.mesh
    vertices, corners = np.unique(facets.corners, return_inverse=True)
    corners = corners.reshape(facets.corners.shape)
    places = np.zeros((len(vertices), mesh.dim))
    places[corners] = moved
    if cKDTree(places).query_pairs(TOUCHING):
        raise RemeshingError("the shell touches itself")
    short = {int(vertex): number for number, vertex in enumerate(vertices)}
    names = {}
    for element in mesh.Elements(BBND):
        ends = [short.get(v.nr, -1) for v in element.vertices]
        if min(ends) >= 0 and element.mat:
            names[frozenset(ends)] = element.mat
    numbers = np.array([domain.face_numbers[mesh[facet].index] for facet in facets.region.Elements()])
    return Polyhedron(corners, places, numbers, names)


def _base(domain: Domain, displacement: Any, matching: Matching) -> Base:
    """The two deformations of the new mesh, and the displacement it was made at."""
    order = domain.sizes.order
    first = matching if domain.base is None else matching.after(domain.base.first)
    present = put(_scalar(first, order), matching.new, matching.sampled(displacement, order))
    return _deformations(first, order, present)


def _deformations(first: Matching, order: int, displacement: Floats) -> Base:
    """The base of the new mesh of ``first``, of an ``order``, with the unknowns (d, n) of a displacement."""
    mesh = first.new.mesh
    position = CF((x, y, z)) if mesh.dim == 3 else CF((x, y))
    came_from = put(_scalar(first, order), first.new, first.sampled(position, order))
    straight = np.zeros_like(came_from)
    corners = np.unique(first.new.corners)
    straight[:, corners] = np.array([mesh.vertices[int(v)].point for v in corners]).T
    fields = []
    for unknowns in (came_from - straight, came_from + displacement - straight, displacement):
        field = GridFunction(VectorH1(mesh, order=order))
        field.vec.FV().NumPy()[:] = unknowns.ravel()
        fields.append(field)
    reference, ambient, moved = fields
    return Base(reference, ambient, moved, first)


def _scalar(matching: Matching, order: int) -> Any:
    return H1(matching.new.mesh, order=order)


@contextmanager
def one_order_more(domain: Domain) -> Iterator[Domain]:
    """``domain`` with its geometry, also that of the shell, and its fields of one order more, for a while."""
    order, base, meshes = domain.sizes.order, domain.base, [domain.mesh]
    if base is not None:
        meshes.append(base.first.old.mesh)
    try:
        for mesh in meshes:
            mesh.Curve(order + 1)
        if base is not None:
            base = _raised(base, order + 1)
            domain.mesh.SetDeformation(base.reference)
        yield replace(domain, sizes=replace(domain.sizes, order=order + 1), base=base)
    finally:
        for mesh in meshes:
            mesh.Curve(order)
        if domain.base is not None:
            domain.mesh.SetDeformation(domain.base.reference)


def _raised(base: Base, order: int) -> Base:
    """``base`` at a higher order, with the same displacement."""
    samples = on_lattice(base.first.new, base.displacement, order)
    return _deformations(base.first, order, put(_scalar(base.first, order), base.first.new, samples))
