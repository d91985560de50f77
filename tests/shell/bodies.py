"""Meshed bodies with a formula for every point: coordinates, the deformation that is put on them, and its tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import BND, CF, GridFunction, VectorH1, x, y

from embedding import Cylinder, Torus
from embedding.geometry.domain import Domain, MeshSizes, build
from embedding.geometry.reduction import Reduction
from embedding.shell.charts import Coordinates
from embedding.shell.derivatives import Derivatives
from embedding.shell.kinematics import Kinematics
from tests.forms import Array, body
from tests.shell.parametrised import ExactShell, Geometry, geometry
from tests.shell.test_kinematics import at, points_of

Motion = Callable[[Any, Any, Any], tuple[Any, Any, Any]]
THICKNESS, AXIAL = 0.2, 1.2
SHOWN = {"3d": (0, 1, 2), "axisymmetric": (0, 2), "plane-strain": (0, 1)}


@dataclass(frozen=True)
class Case:
    """A body, its surface ``place`` in coordinates found by ``locate``, and the ``motion`` of its points.

    ``coordinates`` is the chart in which the components are those of ``place``; None if there is none. ``size`` is that
    of a coarse mesh.
    """

    mesh: Callable[[float, int], Domain]
    place: Callable[[Array, Array], tuple[Any, ...]]
    locate: Callable[[Array], tuple[Array, Array]]
    motion: Motion
    coordinates: Coordinates | None
    size: float = 0.4

    def shell(self, thickness: float = THICKNESS) -> ExactShell:
        """The exact shell."""
        return ExactShell(self._before, self._after, thickness)

    def geometries(self, p: Array, q: Array) -> tuple[Geometry, Geometry]:
        """Exact geometry of the reference and the deformed mid-surface."""
        return geometry(self._before, p, q), geometry(self._after, p, q)

    def _before(self, p: Array, q: Array) -> Array:
        return np.stack(np.broadcast_arrays(*self.place(p, q)), axis=1)

    def _after(self, p: Array, q: Array) -> Array:
        return np.stack(np.broadcast_arrays(*self.motion(*self.place(p, q))), axis=1)


@dataclass(frozen=True)
class Meshed:
    """A case on a mesh: its motion interpolated, and the points (with coordinates p, q) to compare at."""

    derivatives: Derivatives
    points: Any
    p: Array
    q: Array

    def __call__(self, values: Any) -> Array:
        """Values at the points; compiled, as the expressions share most of their parts."""
        return at(CF(values).Compile(), self.points)


def meshed(case: Case, size: float, order: int) -> Meshed:
    """``case`` on a mesh, at points that keep away from singularities of its coordinates."""
    domain = case.mesh(size, order)
    name = domain.reduction.name
    position = CF((x, 0.0, y)) if name == "axisymmetric" else CF((x, y, 0.0)) if name == "plane-strain" else None
    place = domain.reduction.position if position is None else position
    moved = case.motion(place[0], place[1], place[2])
    u = GridFunction(VectorH1(domain.mesh, order=order))
    u.Set(CF(tuple(moved[i] - place[i] for i in SHOWN[name])), BND, definedon=domain.shell)
    derivatives = Derivatives(domain, Kinematics(domain.reduction, domain.normal, u, AXIAL))
    points = points_of(domain)
    where = at(derivatives.position, points)
    points = points[np.hypot(where[:, 0], where[:, 1]) > 0.2]
    p, q = case.locate(at(derivatives.position, points))
    return Meshed(derivatives, points, p, q)


def _on_sphere(p: Array, q: Array) -> tuple[Any, ...]:
    return np.sin(p) * np.cos(q), np.sin(p) * np.sin(q), np.cos(p)


def _angles(where: Array) -> tuple[Array, Array]:
    return np.arctan2(np.hypot(where[:, 0], where[:, 1]), where[:, 2]), np.arctan2(where[:, 1], where[:, 0])


def _on_torus(p: Array, q: Array) -> tuple[Any, ...]:
    away = 1 + 0.4 * np.cos(q)
    return away * np.cos(p), away * np.sin(p), 0.4 * np.sin(q)


def _torus_angles(where: Array) -> tuple[Array, Array]:
    away = np.hypot(where[:, 0], where[:, 1])
    return np.arctan2(where[:, 1], where[:, 0]), np.arctan2(where[:, 2], away - 1)


def _torus(size: float, order: int) -> Domain:
    shape = Torus(radius=1.0, tube_radius=0.4)
    return build(_of_size_one(shape), Reduction("3d", ()), MeshSizes(size, size, 0.0, 0.5, order))


def _tube(size: float, order: int) -> Domain:
    shape = Cylinder(radius=1.0, length=1.0)
    return build(_of_size_one(shape), Reduction("3d", ()), MeshSizes(size, size, 0.0, 0.5, order))


def _of_size_one(shape: Any) -> Any:
    assert shape.size == 1.0, "the formulas are those of a shape of size 1"
    return shape


def _stretched(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    return 1.3 * x + 0.2 * y * z, 0.9 * y - 0.1 * x * z, 1.1 * z + 0.3 * x * x


def _revolved(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    return 1.3 * x * (1 + 0.2 * z * z), 1.3 * y * (1 + 0.2 * z * z), 0.8 * z + 0.2 * z * z


def _sheared(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    return 1.3 * x + 0.2 * x * y, 0.9 * y - 0.1 * x * x, AXIAL * z


def _twisted(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """By an angle 0.5 z, whose sine and cosine are their series to order 6: numbers and functions alike."""
    a = 0.5 * z
    s, c = a - a**3 / 6 + a**5 / 120, 1 - a**2 / 2 + a**4 / 24 - a**6 / 720
    return 1.2 * (c * x - s * y), 1.2 * (s * x + c * y), 1.1 * z


def _bent(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    return 1.2 * x + 0.1 * x * y, 1.1 * y - 0.2 * x * x, 0.5 * x * x * y - 0.3 * y * y + z


CASES = {
    "sphere": Case(lambda h, k: body("sphere", h, k), _on_sphere, _angles, _stretched, "spherical"),
    "twisted tube": Case(
        _tube, lambda p, q: (np.cos(p), np.sin(p), q),
        lambda w: (np.arctan2(w[:, 1], w[:, 0]), w[:, 2]), _twisted, "cylindrical",
    ),
    "torus": Case(_torus, _on_torus, _torus_angles, _stretched, None, 0.2),
    "disc": Case(
        lambda h, k: body("disc", h, k), lambda p, q: (p * np.cos(q), p * np.sin(q), 0 * p),
        lambda w: (np.hypot(w[:, 0], w[:, 1]), np.arctan2(w[:, 1], w[:, 0])), _bent, "polar",
    ),
    "plate": Case(
        lambda h, k: body("plate", h, k), lambda p, q: (p, q, 0 * p), lambda w: (w[:, 0], w[:, 1]), _bent, "frame",
        0.2,
    ),
    "meridian": Case(lambda h, k: body("axisymmetric sphere", h, k), _on_sphere, _angles, _revolved, "frame"),
    "meridian, spherical": Case(
        lambda h, k: body("axisymmetric sphere", h, k), _on_sphere, _angles, _revolved, "spherical"
    ),
    "ring": Case(
        lambda h, k: body("ring", h, k), lambda p, q: (np.cos(p), np.sin(p), q),
        lambda w: (np.arctan2(w[:, 1], w[:, 0]), 0 * w[:, 0]), _sheared, "frame",
    ),
}  # fmt: skip
"""Every kind of reference in every reduction, under a motion that stretches, shears and bends it."""
