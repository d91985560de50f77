"""Which loads and fields are not symmetric about the z axis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.loads import PressureField

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

_ANGLES = (0.3, 1.4, 2.9, 4.6)
_RINGS = ((0.4, 0.9), (0.8, -0.6), (0.97, 0.2))
"""Radius and height of circles around the axis, relative to the size of the shape."""


def axisymmetry_problems(scene: Scene) -> tuple[Problem, ...]:
    """What keeps the loads and the field from being axisymmetric; empty if a reduction may carry them all."""
    return (*unsymmetric_vectors(scene), *unsymmetric_field(scene), *unsymmetric_pressures(scene))


def unsymmetric_vectors(scene: Scene) -> Iterator[Problem]:
    """Dead loads with a component across the axis."""
    yield from _across("loads.body_force", scene.loads.body_force)
    for number, load in enumerate(scene.loads.edge_tractions):
        yield from _across(f"loads.edge_tractions.{number}.traction", load.traction)


def unsymmetric_field(scene: Scene) -> Iterator[Problem]:
    """An applied field with a component across the axis."""
    if scene.ambient is not None:
        yield from _across("ambient.applied_field", scene.ambient.applied_field)


def unsymmetric_pressures(scene: Scene) -> Iterator[Problem]:
    """Varying pressures that change when turned about the axis; compared at a few points."""
    for name, pressure in scene.loads.pressure_fields.items():
        if not _invariant(pressure, scene.shell.shape.size):
            reason = 'must depend on x and y through x**2 + y**2 only when model.reduction is "axisymmetric"'
            yield Problem(f"loads.{name}.expression", f"{pressure.expression} is not allowed: {reason}")


def _across(path: str, vector: tuple[float, float, float]) -> Iterator[Problem]:
    if vector[0] != 0.0 or vector[1] != 0.0:
        reason = 'the x and y components must be 0 when model.reduction is "axisymmetric"'
        yield Problem(path, f"{list(vector)} is not allowed: {reason}")


def _invariant(pressure: PressureField, size: float) -> bool:
    if not pressure.parsed.variables & {"x", "y"}:
        return True
    for radius, height in _RINGS:
        try:
            values = [
                float(pressure(radius * size * math.cos(angle), radius * size * math.sin(angle), height * size))
                for angle in _ANGLES
            ]
        except (ArithmeticError, ValueError, TypeError):
            continue  # outside the shell an expression may be undefined; on it, its values are checked
        if max(values) - min(values) > 1e-9 * max(map(abs, values)):
            return False
    return True
