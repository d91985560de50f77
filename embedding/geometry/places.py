"""Where a load or a support sits on the meshed shell: edges by name, points by their coordinates.

A point belongs to the surface element whose curved image comes closest to it, found by Gauss-Newton iteration on the
element's local coordinates. With mirror planes a point of the whole body stands for its image in the meshed part.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, ET, ElementId

from embedding.geometry.domain import Domain
from embedding.geometry.positions import reference_position
from embedding.geometry.spaces import Mask, TraceSpace, scalar_mask

Array = npt.NDArray[np.float64]
Place = str | tuple[float, ...]
"""An edge or a face of the shape, "surface", or a point in mesh coordinates."""

CLOSE = 1e-6
"""How far a point may lie off the surface, or a corner off its point, in shell sizes."""
BULGE = 0.1
"""How far off a curved element besides, relative to the height of its bulge: the mesh is not quite the shape."""
FAR = 3.0
"""Local coordinates that are outside every element for certain."""
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
    mirrored = np.array([axis in domain.reduction.planes for axis in "xyz"[: domain.mesh.dim]])
    target = np.where(mirrored, np.abs(point), point)
    near: SurfacePoint | None = None
    for away, number in _by_distance(domain, target):
        if near is not None and near.distance < away:
            break
        found = _closest(domain.mesh, number, target)
        near = found if near is None or found.distance < near.distance else near
    if near is None:
        raise RuntimeError("the mesh has no shell")
    return near


def corner(domain: Domain, point: tuple[float, ...]) -> int | None:
    """Number of the mesh vertex of the shell at ``point`` (mesh coordinates of the whole body), None without one."""
    target = locate(domain, point)
    element = domain.mesh[ElementId(BND, target.element)]
    places = {v.nr: reference_position(domain.mesh, v) for v in element.vertices}
    distances = {number: float(np.linalg.norm(place - target.position)) for number, place in places.items()}
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
        edge = place in domain.shape.edges or place not in domain.shape.faces
        return scalar_mask(space, domain.mesh.BBoundaries(place) if edge else domain.face(place))
    vertex = corner(domain, place)
    if vertex is None:
        raise ValueError(f"no vertex of the mesh at {place}")
    mask = np.zeros(space.ndof, bool)
    mask[vertex] = True  # the first unknowns of H1 are the values at the vertices
    return mask


def displaced(
    domain: Domain, trace: TraceSpace, prescribed: tuple[tuple[Place, int, float], ...]
) -> tuple[npt.NDArray[np.int64], Array]:
    """Unknowns of ``trace`` that (place, component, displacement) entries prescribe, and their values."""
    block = trace.space.ndof // trace.components
    values: dict[int, float] = {}
    for place, component, displacement in prescribed:
        held = np.flatnonzero(unknowns_at(domain, trace.scalar, place))
        numbers = component * block + trace.in_block(list(held))
        # A constant is its value at the vertices; all other functions of the basis vanish there.
        values |= {int(n): displacement * (dof < domain.mesh.nv) for n, dof in zip(numbers, held, strict=True)}
    return np.array(list(values), dtype=np.int64), np.array(list(values.values()), dtype=np.float64)


def _by_distance(domain: Domain, target: Array) -> list[tuple[float, int]]:
    """The shell's elements, each with the least distance it can have from ``target``, the nearest first."""
    mesh, bounds = domain.mesh, []
    for element in domain.shell.Elements():
        corners = np.array([reference_position(mesh, v) for v in element.vertices])
        centre = corners.mean(axis=0)
        reach = 1.5 * np.linalg.norm(corners - centre, axis=1).max()  # with room for the bulge
        bounds.append((float(np.linalg.norm(target - centre) - reach), int(element.nr)))
    return sorted(bounds)


def _closest(mesh: Any, number: int, target: Array) -> SurfacePoint:
    """The point of one curved element closest to ``target``: inside it, or else on one of its edges."""
    element = ElementId(BND, number)
    kind, trafo = mesh[element].type, mesh.GetTrafo(element)
    corners = CORNERS[kind]
    inner = [_descend(trafo, target, corners.mean(axis=0), np.eye(2))] if mesh.dim == 3 else []
    places = [local for local in inner if _inside(kind, local)]
    if not places:
        edges = zip(corners, np.roll(corners, -1, axis=0), strict=True)
        places = [_descend(trafo, target, start, (end - start)[:, None]) for start, end in edges]
    images = [_image(trafo, local)[0] for local in places]
    distances = [float(np.linalg.norm(image - target)) for image in images]
    best = int(np.argmin(distances))
    local, position = places[best], images[best]
    flat = _weights(kind, local) @ np.array([reference_position(mesh, v) for v in mesh[element].vertices])
    allowed = CLOSE + BULGE * float(np.linalg.norm(position - flat))
    return SurfacePoint(number, tuple(map(float, local)), position, distances[best], allowed)


def _descend(trafo: Any, target: Array, start: Array, directions: Array) -> Array:
    """Local coordinates ``start`` + ``directions`` s whose image is closest to ``target``; on a line 0 <= s <= 1."""
    along = directions.shape[1] == 1
    s = np.full(directions.shape[1], 0.5 if along else 0.0)
    for _ in range(50):
        position, jacobian = _image(trafo, start + directions @ s)
        step = np.linalg.lstsq(jacobian @ directions, target - position, rcond=None)[0]
        moved = np.clip(s + step, 0.0, 1.0) if along else np.clip(s + step, -FAR, FAR)
        change, s = float(np.abs(moved - s).max()), moved
        if change < 1e-15:
            break
    return np.asarray(start + directions @ s, dtype=np.float64)


def _inside(kind: Any, local: Array) -> bool:
    return bool(local.min() >= 0.0 and (local.sum() if kind == ET.TRIG else local.max()) <= 1.0)


def _image(trafo: Any, local: Array) -> tuple[Array, Array]:
    """Position (d,) and derivative (d, d - 1) of the curved element at ``local``."""
    mapped = trafo(*local)  # held while its memory is copied: what it hands out are views
    position = np.array(mapped.point, dtype=np.float64)
    return position, np.array(mapped.jacobi, dtype=np.float64).reshape(len(position), -1)


def _weights(kind: Any, local: Array) -> Array:
    """Weights of the element's vertices in the flat element at ``local``."""
    if kind == ET.QUAD:
        a, b = local
        return np.array([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b])
    return np.append(local, 1.0 - local.sum())
