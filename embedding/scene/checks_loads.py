"""Cross checks of loads and supports: places that the shape has, and what acts there."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.messages import choice
from embedding.scene.part import known
from embedding.scene.shapes import Point
from embedding.scene.surface_fields import SurfaceField
from embedding.scene.units import LARGEST
from embedding.scene.vector_fields import ForceField, VectorField

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def surface_fields(scene: Scene) -> Iterator[tuple[str, SurfaceField]]:
    """Every expression of the scene over the mid-surface or in space, with the path of its text."""
    for path, thickness in scene.shell.thickness_fields.items():
        yield f"shell.{path}.expression", thickness
    for name, pressure in scene.loads.pressure_fields.items():
        yield f"loads.{name}.expression", pressure
    for path, vector in vector_fields(scene).items():
        for number, component in enumerate(vector.components):
            yield f"{path}.expression.{number}", component


def vector_fields(scene: Scene) -> dict[str, VectorField]:
    """Every vector of the scene that is given as expressions, by the path of its field."""
    vectors: dict[str, VectorField] = {f"shell.{path}": field for path, field in scene.shell.vector_fields.items()}
    if isinstance(scene.loads.surface_force, ForceField):
        vectors["loads.surface_force"] = scene.loads.surface_force
    if scene.ambient is not None and scene.ambient.varying_field is not None:
        vectors["ambient.applied_field"] = scene.ambient.varying_field
    return vectors


def _supports(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    allowed = tuple(dict.fromkeys((*shape.edges, *shape.faces, "surface")))
    for number, support in enumerate(scene.supports):
        path = f"supports.{number}"
        if isinstance(support.where, str) and support.where not in allowed:
            message = f'{choice(support.where, allowed)} (the shape is a "{shape.kind}")'
            yield Problem(f"{path}.where", message)
        elif "rotation" in support.held and support.where not in shape.edges:
            field, value = ("kind", f'"{support.kind}"') if support.kind else ("fix", '"rotation"')
            reason = "the rotation of the shell can be held on an edge only"
            yield Problem(f"{path}.{field}", f"{value} is not allowed: {reason}")


def _edges(scene: Scene) -> Iterator[Problem]:
    loads = scene.loads
    for number, traction in enumerate(loads.edge_tractions):
        yield from _edge(scene, f"loads.edge_tractions.{number}.edge", traction.edge)
    for number, line in enumerate(loads.line_loads):
        yield from _edge(scene, f"loads.line_loads.{number}.line", line.line)
    for number, moment in enumerate(loads.edge_moments):
        yield from _edge(scene, f"loads.edge_moments.{number}.edge", moment.edge)


def _edge(scene: Scene, path: str, edge: str) -> Iterator[Problem]:
    shape = scene.shell.shape
    if not shape.edges:
        yield Problem(path, f'"{edge}" is not allowed: a shape of kind "{shape.kind}" has no edges')
    elif edge not in shape.edges:
        yield Problem(path, f'{choice(edge, shape.edges)} (the shape is a "{shape.kind}")')


def _gravity(scene: Scene) -> Iterator[Problem]:
    if any(scene.loads.gravity) and known(scene.shell.density) is None:
        yield Problem("shell.density", "missing: needed under loads.gravity")


def _values(scene: Scene) -> Iterator[Problem]:
    for path, field in surface_fields(scene):
        for point in scene.shell.shape.sample_points():
            value = field.value_at(point)
            if not abs(value) <= LARGEST:
                reason = f"must be at most {LARGEST:g} in magnitude, and is {value:.3g}"
                said = reason if math.isfinite(value) else "it has no finite value"
                yield Problem(path, f"{field.expression} is not allowed: {said} at {_place(point)}")
                break


def _thick(scene: Scene) -> Iterator[Problem]:
    for path, field in scene.shell.thickness_fields.items():
        points = [point for point in scene.shell.shape.sample_points() if field.value_at(point) < 1.0 / LARGEST]
        if points:
            least = "greater than 0" if field.value_at(points[0]) <= 0.0 else f"at least {1.0 / LARGEST:g} m"
            reason = f"must be {least}, and is {field.value_at(points[0]):.3g} m at {_place(points[0])}"
            yield Problem(f"shell.{path}.expression", f"{field.expression} is not allowed: {reason}")


def _place(point: Point) -> str:
    return ", ".join(f"{axis} = {value:.3g} m" for axis, value in zip("xyz", point, strict=True))


def _infinitely_long(scene: Scene) -> Iterator[Problem]:
    """What is the same all along z has no load, place or displacement along z, and no load that varies along it."""
    if scene.shell.shape.reductions != ("plane-strain",):
        return
    zero = "is not allowed: must be 0 along z, along which nothing changes"
    for path, value in _along_z(scene):
        if value != 0.0:
            yield Problem(path, f"{value} {zero}")
    for path, field in surface_fields(scene):
        if "z" in field.parsed.variables:
            message = f"{field.expression} is not allowed: must not depend on z, along which nothing changes"
            yield Problem(path, message)
    for path, vector in vector_fields(scene).items():
        if any(vector.components[2].values_at(scene.shell.shape.sample_points())):
            yield Problem(f"{path}.expression.2", f"{vector.expression[2]} {zero}")


def _along_z(scene: Scene) -> Iterator[tuple[str, float]]:
    loads = scene.loads
    for name, vector in loads.dead_vectors.items():
        yield f"loads.{name}.2", vector[2]
    for number, edge in enumerate(loads.edge_tractions):
        if edge.frame == "edge":
            yield f"loads.edge_tractions.{number}.traction.1", edge.traction[1]
    for number, load in enumerate(loads.point_loads):
        yield f"loads.point_loads.{number}.at.2", load.at[2]
        yield f"loads.point_loads.{number}.force.2", load.force[2]
    for number, support in enumerate(scene.supports):
        if not isinstance(support.where, str):
            yield f"supports.{number}.where.2", support.where[2]
        yield f"supports.{number}.displacement.2", support.displacement[2]
    for path, vector in scene.shell.constant_vectors.items():
        yield f"shell.{path}.2", vector[2]
    for number, body in enumerate(scene.ambient.bodies if scene.ambient is not None else ()):
        yield f"ambient.bodies.{number}.remanence.2", (body.remanence or (0.0, 0.0, 0.0))[2]


def needs_bending(scene: Scene) -> tuple[Problem, ...]:
    """Loads and supports that only a shell with bending stiffness can carry."""
    reason = "needs a shell that resists bending, and this one is a membrane"
    moments = [f"loads.edge_moments.{number}" for number in range(len(scene.loads.edge_moments))]
    held = [(number, support) for number, support in enumerate(scene.supports) if support.kind != "symmetry"]
    turned = [f"supports.{n}.{'kind' if s.kind else 'fix'}" for n, s in held if "rotation" in s.held]
    return tuple(Problem(path, reason) for path in (*moments, *turned))


LOAD_CHECKS = (_supports, _edges, _gravity, _values, _thick, _infinitely_long)
