"""From a shape to its mesh: the shell alone, or as an interface inside the ambient with its two sides told apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import netgen.meshing as netgen
import numpy as np
import numpy.typing as npt
from ngsolve import BND, VOL, Mesh

from embedding.geometry.counting import refuse_too_large
from embedding.geometry.cut import BOTTOM, RIM, TOP, Cut, Integers
from embedding.geometry.facets import Facets
from embedding.geometry.outline import NoMeshError, Outline
from embedding.geometry.reduction import Reduction
from embedding.geometry.shapes import outline
from embedding.geometry.sides import signs
from embedding.geometry.sizes import MeshSizes
from embedding.geometry.surroundings import raw_mesh
from embedding.scene import Shape

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Meshed:
    """A straight-sided ``mesh``; the number of the shape's face on each of its boundaries, -1 where there is none; and
    the rims of the shell in the ambient, vertices (n,) and edges (n, 2) by vertices."""

    mesh: Mesh
    faces: tuple[int, ...]
    rim_vertices: Integers
    rim_edges: Integers


def mesh(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Meshed:
    """Mesh of the dimensionless ``shape``: lengths are divided by its size.

    Raises:
        BodyError, TooLargeError, NoMeshError: no room for a body, in memory for the mesh, no mesh of these sizes.
        JunctionError, CloseSheetsError, OneSidedError, UnclearSidesError: the shell has no two sides in its ambient.
    """
    geometry = outline(shape, reduction)
    none = np.zeros((0, 2), np.int64)
    if not sizes.radius:
        refuse_too_large(geometry, reduction, sizes)
        alone = geometry.mesh(sizes)
        return Meshed(alone, tuple(range(len(alone.GetBoundaries()))), none[:, 0], none)

    def up(facets: Facets) -> Floats:
        return np.asarray(signs(facets, shape, reduction)[:, None] * facets.at_centres(reduction.normal))

    return around(geometry, reduction, sizes, up)


def around(geometry: Outline, reduction: Reduction, sizes: MeshSizes, up: Callable[[Facets], Floats]) -> Meshed:
    """Mesh of the space around the shell of ``geometry``; ``up`` gives vectors (n, d) towards the top side of the
    shell's elements.

    Raises:
        As :func:`mesh`.
    """
    raw = raw_mesh(geometry, reduction, sizes)
    faces = _faces(raw, reduction)
    trial = Mesh(raw)
    facets = Facets(trial, trial.Boundaries("shell"))
    elements = np.array([[v.nr for v in element.vertices] for element in trial.Elements(VOL)])
    cut = Cut(elements, facets.corners)
    element, facet = cut.beside
    if np.any(np.bincount(facet, minlength=len(facets.corners)) != 2):  # netgen leaves faces out and only says so
        raise NoMeshError("the mesh generator left out what is beside the shell")
    ends = np.array([[v.nr for v in element.vertices] for element in trial.Elements(BND)])
    if _has_holes(elements, ends):
        raise NoMeshError("the mesh generator left out a part of space")
    rim_vertices, rim_edges = cut.rim_vertices, cut.rim_edges
    points = np.array([v.point for v in trial.vertices])
    reach = points[elements[element]].mean(axis=1) - points[facets.corners[facet]].mean(axis=1)
    sides = cut.sides(np.einsum("ij,ij->i", reach, up(facets)[facet]) > 0)
    materials = np.array([element.mat for element in trial.Elements(VOL)])
    _relabel(raw, _materials(materials, sides, cut.rooms()), reduction)
    return Meshed(Mesh(raw), faces, rim_vertices, rim_edges)


def _has_holes(elements: Integers, boundary: Integers) -> bool:
    """Does a mesh end anywhere else than at its boundary? Vertices (n, d + 1) of its elements, (m, d) of the latter."""
    corners = elements.shape[1]
    sides = np.concatenate([np.delete(elements, corner, axis=1) for corner in range(corners)])
    found, count = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
    single = np.unique(np.concatenate([found[count == 1], np.sort(boundary, axis=1)]), axis=0)
    return len(single) > len(np.unique(np.sort(boundary, axis=1), axis=0))


def _faces(raw: netgen.Mesh, reduction: Reduction) -> tuple[int, ...]:
    """Numbers of the shape's faces by boundary; from here on they are all called ``shell``."""
    names = raw.GetRegionNames(codim=1)
    if reduction.dimension == 2:
        return tuple(0 if name == "shell" else -1 for name in names)
    numbers = []
    for number, name in enumerate(names):
        of_shell = name.startswith("shell ")
        numbers.append(int(name.split()[1]) if of_shell else -1)
        if of_shell:
            raw.SetBCName(number, "shell")
    return tuple(numbers)


def _materials(materials: Any, sides: Integers, rooms: Integers) -> Any:
    """The material of each element: beside the shell by its side; the rest of a room that only the bottom face bounds
    is the inside."""
    out = materials.astype(object)
    within = np.setdiff1d(rooms[sides == BOTTOM], rooms[sides == TOP])
    out[np.isin(rooms, within) & (materials == "outside")] = "inside"
    out[(sides == TOP) | (sides == RIM)] = "outside_near"
    out[sides == BOTTOM] = "inside_near"
    return out


def _relabel(raw: netgen.Mesh, materials: Any, reduction: Reduction) -> None:
    """Give every element of the mesh its material."""
    index = {name: number + 1 for number, name in reversed(list(enumerate(raw.GetRegionNames(codim=0))))}
    for name in sorted(set(materials) - set(index)):
        number = len(raw.GetRegionNames(codim=0)) + 1
        if reduction.dimension == 2:
            raw.Add(netgen.FaceDescriptor(surfnr=number, domin=number, bc=number))
        raw.SetMaterial(number, name)
        index[name] = number
    elements = raw.Elements3D() if reduction.dimension == 3 else raw.Elements2D()
    for number, name in enumerate(materials):
        element = elements[number]
        if element.index != index[name]:
            element.index = index[name]
