"""Which side of the mid-surface is the top: the conventions of the shapes, and signs that follow them on a mesh.

=====================================================  =======================================================
shape                                                  the normal points
=====================================================  =======================================================
closed shapes                                          outwards
plate, disc, annulus                                   along +z
strip                                                  along +y
cylinder, cone, cap, hemisphere, arch                  away from the axis or the centre
T-section                                              along +x on the vertical plate, +z on the horizontal one
file                                                   as the first face of a part says; ``flip`` turns all round
=====================================================  =======================================================

NGSolve's own normals follow the order of materials or the direction of an OCC edge. Here the elements of one part are
first turned to one and the same side, from neighbour to neighbour; then the part as a whole is.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from embedding.geometry.facets import Facets
from embedding.geometry.file import file
from embedding.geometry.matching import nearest_of
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes
from embedding.scene import Arch, Cap, Cone, Cylinder, Hemisphere, Shape, SurfaceFile, TSection

Floats = npt.NDArray[np.float64]
CLEAR = 1e-3
"""Smallest mean of N along the direction of the top side that settles a part."""


class UnclearSidesError(RuntimeError):
    """The sides cannot be told apart on this mesh."""


def signs(facets: Facets, shape: Shape, reduction: Reduction) -> Floats:
    """+1 or -1 for each element: times it, the mesh's own normal points to the top side.

    Raises:
        UnclearSidesError: the sides cannot be told apart on this mesh.
        OneSidedError: the surface has only one side.
    """
    own = facets.at_centres(reduction.normal)
    corner = np.sign(np.einsum("ij,ij->i", own, facets.corner_normals))
    consistent = facets.turns * corner
    if isinstance(shape, SurfaceFile):
        turn = _as_in_the_file(facets, shape, consistent[:, None] * own, reduction)
        return np.asarray((-1.0 if shape.flip else 1.0) * consistent * turn[facets.parts])
    upwards = np.einsum("ij,ij->i", own, _up(facets.at_centres(reduction.position), shape)) * consistent
    area = np.linalg.norm(facets.corner_normals, axis=1)
    count = facets.parts.max() + 1
    share = np.bincount(facets.parts, upwards * area, count) / np.bincount(facets.parts, area, count)
    if np.abs(share).min() < CLEAR:
        raise UnclearSidesError("the shell's sides cannot be told apart on this mesh")
    return np.asarray(consistent * np.sign(share)[facets.parts])


def _as_in_the_file(facets: Facets, shape: SurfaceFile, normals: Floats, reduction: Reduction) -> Floats:
    """+1 or -1 for each part: times it, the ``normals`` (n, 3) are those of the part's first face in the file.

    Only a mesh of the surface alone keeps its faces' order and normals.
    """
    if facets.mesh.ne == 0:
        first = np.unique(facets.parts, return_index=True)[1]
        own = facets.at_centres(reduction.normal)
        return np.asarray(np.sign(np.einsum("ij,ij->i", normals[first], own[first])))
    size = float(np.sqrt(2 * np.linalg.norm(facets.corner_normals, axis=1).mean()))
    alone = file(shape).mesh(MeshSizes(shell=size, far=size, radius=0.0, grading=0.3, order=1))
    seeds = Facets(alone, alone.Boundaries("shell"))
    first = np.unique(seeds.parts, return_index=True)[1]
    places, wanted = seeds.points.mean(axis=1)[first], seeds.at_centres(reduction.normal)[first]
    near = nearest_of(facets.points.mean(axis=1), places)
    turn = np.ones(facets.parts.max() + 1)
    turn[facets.parts[near]] = np.sign(np.einsum("ij,ij->i", normals[near], wanted))
    return turn


def _up(positions: Floats, shape: Shape) -> Floats:
    """A vector field towards the top side, at mesh ``positions`` (n, d)."""
    if isinstance(shape, Cap | Hemisphere | Arch) or (shape.closed and not isinstance(shape, Cylinder)):
        return np.asarray(positions / np.linalg.norm(positions, axis=1).mean())
    up = np.zeros_like(positions)
    if isinstance(shape, TSection):
        up[:, [0, 2]] = 1.0
    elif isinstance(shape, Cylinder | Cone):
        across = positions if shape.closed else positions[:, : max(1, positions.shape[1] - 1)]
        up[:, : across.shape[1]] = across / np.linalg.norm(across, axis=1).mean()
    else:
        up[:, -1] = 1.0
    return up
