"""Which loads, supports and fields are not symmetric about the z axis."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from embedding.errors import Problem
from embedding.scene.bodies import BoxBody, HalfSpace
from embedding.scene.checks_loads import vector_fields
from embedding.scene.part import known
from embedding.scene.surface_fields import SurfaceField

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

_ANGLES = (0.3, 1.4, 2.9, 4.6)
_RINGS = ((0.4, 0.9), (0.8, -0.6), (0.97, 0.2))
"""Radius and height of circles around the axis, relative to the size of the shape."""
_PINNED = 'when model.reduction is "axisymmetric"'


def axisymmetry_problems(scene: Scene) -> tuple[Problem, ...]:
    """What keeps loads, supports and field from being axisymmetric; empty if a reduction may carry them all."""
    return tuple(problem for check in UNSYMMETRIC for problem in check(scene))


def unsymmetric_vectors(scene: Scene) -> Iterator[Problem]:
    """Dead loads with a component across the axis, and loads along an edge."""
    for name, vector in scene.loads.dead_vectors.items():
        yield from _across(f"loads.{name}", vector)
    for number, load in enumerate(scene.loads.edge_tractions):
        if load.frame == "edge" and load.traction[1] != 0.0:
            reason = f"must be 0 along the edge {_PINNED}"
            value = f"{load.traction[1]} N/m"
            yield Problem(f"loads.edge_tractions.{number}.traction.1", f"{value} is not allowed: {reason}")


def unsymmetric_points(scene: Scene) -> Iterator[Problem]:
    """Loads and supports at points off the axis, forces and prescribed displacements across it."""
    for number, load in enumerate(scene.loads.point_loads):
        yield from _across(f"loads.point_loads.{number}.at", load.at)
        yield from _across(f"loads.point_loads.{number}.force", load.force)
    for number, support in enumerate(scene.supports):
        if not isinstance(support.where, str):
            yield from _across(f"supports.{number}.where", support.where)
        yield from _across(f"supports.{number}.displacement", support.displacement)


def unsymmetric_field(scene: Scene) -> Iterator[Problem]:
    """An applied field, a remanence or a polarisation with a component across the axis."""
    for path, vector in scene.shell.constant_vectors.items():
        yield from _across(f"shell.{path}", vector)
    if scene.ambient is not None:
        yield from _across("ambient.applied_field", scene.ambient.uniform_field)


def unsymmetric_space(scene: Scene) -> Iterator[Problem]:
    """Boxes, line currents, bodies off the axis or with a remanence across it."""
    ambient = scene.ambient
    if ambient is None:
        return
    if known(ambient.box) is not None:
        yield Problem("ambient.box", f"not allowed {_PINNED}: a box is not round")
    if ambient.line_currents:
        yield Problem("ambient.line_currents", f"not allowed {_PINNED}: their field is around them")
    for number, body in enumerate(ambient.bodies):
        path = f"ambient.bodies.{number}"
        if isinstance(body, BoxBody):
            yield Problem(f"{path}.kind", f'"box" is not allowed {_PINNED}: a box is not round')
        elif not isinstance(body, HalfSpace):
            yield from _across(f"{path}.centre", body.centre)
        yield from _across(f"{path}.remanence", known(body.remanence) or (0.0, 0.0, 0.0))


def unsymmetric_expressions(scene: Scene) -> Iterator[Problem]:
    """Thickness, pressures, forces and fields that change when turned about the axis; compared at a few points."""
    size = scene.shell.shape.size
    scalars: dict[str, SurfaceField] = {f"shell.{path}": field for path, field in scene.shell.thickness_fields.items()}
    scalars |= {f"loads.{name}": pressure for name, pressure in scene.loads.pressure_fields.items()}
    for path, field in scalars.items():
        if field.parsed.variables & {"x", "y"} and not _invariant(lambda *p, f=field: (f(*p),), size):
            reason = f"must depend on x and y through x**2 + y**2 only {_PINNED}"
            yield Problem(f"{path}.expression", f"{field.expression} is not allowed: {reason}")
    for path, vector in vector_fields(scene).items():
        if not _invariant(_turned(vector.components), size):
            reason = f"must be the same when turned about the z axis, without a component around it, {_PINNED}"
            yield Problem(f"{path}.expression", f"[{', '.join(vector.expression)}] is not allowed: {reason}")


UNSYMMETRIC = (
    unsymmetric_vectors,
    unsymmetric_points,
    unsymmetric_field,
    unsymmetric_space,
    unsymmetric_expressions,
)
"""The checks, one for each kind of thing that may break the symmetry."""


def _across(path: str, vector: tuple[float, float, float]) -> Iterator[Problem]:
    if vector[0] != 0.0 or vector[1] != 0.0:
        reason = f"the x and y components must be 0 {_PINNED}"
        yield Problem(path, f"{list(vector)} is not allowed: {reason}")


def _turned(components: tuple[SurfaceField, ...]) -> Callable[..., tuple[float, ...]]:
    """Radial and axial component of a vector field, and the one around the axis."""

    def values(x: float, y: float, z: float) -> tuple[float, ...]:
        a, b, c = (float(component(x, y, z)) for component in components)
        r = math.hypot(x, y)
        return (a * x + b * y) / r, c, (b * x - a * y) / r

    return values


def _invariant(values: Callable[..., tuple[Any, ...]], size: float) -> bool:
    """Are ``values`` the same all around the axis, and the third (around it) zero?"""
    for radius, height in _RINGS:
        try:
            rows = [
                [float(v) for v in values(radius * size * math.cos(a), radius * size * math.sin(a), height * size)]
                for a in _ANGLES
            ]
        except (ArithmeticError, ValueError, TypeError):
            continue  # outside the shell an expression may be undefined; on it, its values are checked
        small = 1e-9 * max(abs(v) for row in rows for v in row)
        if any(max(column) - min(column) > small for column in zip(*rows, strict=True)):
            return False
        if any(abs(around) > small for row in rows for around in row[2:]):
            return False
    return True
