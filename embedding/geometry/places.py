"""Where a load or a support sits on the meshed shell: edges by name, points by their coordinates.

A point belongs to the surface element whose curved image comes closest to it, found by Gauss-Newton iteration on the
element's local coordinates. With mirror planes a point of the whole body stands for its image in the meshed part.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, ET, ElementId, Mesh

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import Mask, scalar_mask

Array = npt.NDArray[np.float64]
Place = str | tuple[float, ...]
"""An edge of the shape, "surface", or a point in mesh coordinates."""

CLOSE = 1e-6
"""How far a point may lie off the surface, or a corner off its point, in shell sizes."""
BULGE = 0.1
"""How far off a curved element besides, relative to the height of its bulge: the mesh is not quite the shape."""
CORNERS: dict[Any, Array] = {
    ET.SEGM: np.array([[1.0], [0.0]]),
    ET.TRIG: np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
    ET.QUAD: np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
}
"""Local coordinates of the vertices of NGSolve's elements, in the order of the element's vertices."""


@dataclass(frozen=True)
class SurfacePoint:
    """A point on the meshed mid-surface: boundary element, local coordinates, position (d,), distance to the target."""

    element: int
    local: tuple[float, ...]
    position: Array
    distance: float
    allowed: float

    @property
    def on_surface(self) -> bool:
        """Is the target on the mid-surface, as far as the mesh can tell?"""
        return self.distance <= self.allowed


def locate(domain: Domain, point: tuple[float, ...]) -> SurfacePoint:
    """The point of the meshed mid-surface closest to ``point``, given in mesh coordinates of the whole body."""
    mesh, target = domain.mesh, np.abs(point) * _mirrored(domain) + np.asarray(point) * ~_mirrored(domain)
    return min((_closest(mesh, number, target) for number in _candidates(domain, target)), key=lambda p: p.distance)


def corner(domain: Domain, point: tuple[float, ...]) -> int | None:
    """Number of the mesh vertex of the shell at ``point`` (mesh coordinates of the whole body), None without one."""
    target = locate(domain, point)
    element = domain.mesh[ElementId(BND, target.element)]
    distances = {v.nr: float(np.linalg.norm(_place(domain.mesh, v) - target.position)) for v in element.vertices}
    nearest = min(distances, key=distances.__getitem__)
    return nearest if target.on_surface and distances[nearest] <= CLOSE else None


def unknowns_at(domain: Domain, space: Any, place: Place) -> Mask:
    """Degrees of freedom of the scalar H1 ``space`` that are held where a support holds ``place``.

    Raises:
        ValueError: ``place`` is a point without a mesh vertex.
    """
    if place == "surface":
        return scalar_mask(space, domain.shell)
    if isinstance(place, str):
        return scalar_mask(space, domain.mesh.BBoundaries(place))
    vertex = corner(domain, place)
    if vertex is None:
        raise ValueError(f"no vertex of the mesh at {place}")
    mask = np.zeros(space.ndof, bool)
    mask[vertex] = True  # the first unknowns of H1 are the values at the vertices
    return mask


def _mirrored(domain: Domain) -> Mask:
    planes = domain.reduction.planes
    return np.array([axis in planes for axis in "xyz"[: domain.mesh.dim]])


def _place(mesh: Mesh, vertex: Any) -> Array:
    return np.asarray(mesh[vertex].point, dtype=np.float64)


def _candidates(domain: Domain, target: Array) -> list[int]:
    """Boundary elements of the shell that may hold the point closest to ``target``."""
    mesh = domain.mesh
    corners = {el.nr: np.array([_place(mesh, v) for v in el.vertices]) for el in domain.shell.Elements()}
    centres = {number: places.mean(axis=0) for number, places in corners.items()}
    reach = {n: 1.5 * float(np.linalg.norm(corners[n] - centres[n], axis=1).max()) for n in corners}
    away = {n: float(np.linalg.norm(target - centres[n])) for n in corners}
    nearest = min(away, key=lambda n: away[n] - reach[n])
    return [n for n in corners if away[n] <= reach[n]] or [nearest]


def _closest(mesh: Mesh, number: int, target: Array) -> SurfacePoint:
    element = ElementId(BND, number)
    kind, trafo = mesh[element].type, mesh.GetTrafo(element)
    corners = CORNERS[kind]
    local = corners.mean(axis=0)
    for _ in range(50):
        mapped = trafo(*local)
        jacobian = np.asarray(mapped.jacobi).reshape(mesh.dim, -1)
        step = np.linalg.lstsq(jacobian, target - np.asarray(mapped.point), rcond=None)[0]
        moved = _inside(kind, local + step)
        change, local = float(np.abs(moved - local).max()), moved
        if change < 1e-15:
            break
    position = np.asarray(trafo(*local).point, dtype=np.float64)
    flat = _weights(kind, local) @ np.array([_place(mesh, v) for v in mesh[element].vertices])
    allowed = CLOSE + BULGE * float(np.linalg.norm(position - flat))
    return SurfacePoint(number, tuple(local), position, float(np.linalg.norm(position - target)), allowed)


def _inside(kind: Any, local: Array) -> Array:
    """The nearest local coordinates within the element."""
    inside = np.clip(local, 0.0, 1.0)
    if kind == ET.TRIG and local.sum() > 1.0:
        inside = np.clip(local - (local.sum() - 1.0) / 2, 0.0, 1.0)
        inside /= max(1.0, inside.sum())
    return inside


def _weights(kind: Any, local: Array) -> Array:
    """Weights of the element's vertices in the flat element at ``local``."""
    if kind == ET.QUAD:
        a, b = local
        return np.array([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b])
    return np.append(local, 1.0 - local.sum())
