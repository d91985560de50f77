"""Are thickness, loads and supports their own mirror image in a coordinate plane?"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from embedding.scene import ForceField, Scene, Support
from embedding.scene.surface_fields import SurfaceField

Vector = tuple[float, float, float]
SAME = 1e-9
AXES = ("x", "y", "z")


def mirrored_loads(scene: Scene, axis: int) -> bool:
    """Do thickness, loads and supports stay the same when mirrored across coordinate ``axis`` (0, 1 or 2)?"""
    loads = scene.loads
    uniform = [loads.body_force, loads.gravity]
    fields: list[tuple[SurfaceField, bool]] = [
        (field, False) for field in (*loads.pressure_fields.values(), *scene.shell.thickness_fields.values())
    ]
    if isinstance(loads.surface_force, ForceField):
        fields += [(component, i == axis) for i, component in enumerate(loads.surface_force.components)]
    else:
        uniform.append(loads.surface_force)
    if any(vector[axis] for vector in uniform):
        return False
    points = scene.shell.shape.sample_points()
    if not all(_parity(field, points, axis, odd=odd) for field, odd in fields):
        return False
    return _mirrored_edges(scene, axis) and _mirrored_points(scene, axis) and _mirrored_supports(scene, axis)


def image(vector: Vector, axis: int) -> Vector:
    """The mirror image across coordinate ``axis`` of a vector, or of a point."""
    x, y, z = (-c if i == axis else c for i, c in enumerate(vector))
    return x, y, z


def _parity(field: SurfaceField, points: Sequence[Vector], axis: int, *, odd: bool) -> bool:
    for point in points:
        here, there = float(field(*point)), float(field(*image(point, axis)))
        if abs(here - (-there if odd else there)) > SAME * max(abs(here), abs(there)):
            return False
    return True


def _mirrored_edges(scene: Scene, axis: int) -> bool:
    """Loads on edges and lines: every edge carries the image of what its mirror image carries."""
    loads, shape = scene.loads, scene.shell.shape
    lines = [(edge.edge, edge.traction) for edge in loads.edge_tractions if edge.frame == "global"]
    lines += [(line.line, line.force) for line in loads.line_loads]
    frames: dict[str, list[tuple[str, Vector]]] = {
        kind: [(e.edge, e.traction) for e in loads.edge_tractions if e.frame == "edge" and e.kind == kind]
        for kind in ("dead", "follower")
    }
    moments = [(edge.edge, (edge.moment, 0.0, 0.0)) for edge in loads.edge_moments]

    def mirrored(entries: Sequence[tuple[str, Vector]], flip: int) -> bool:
        def total(name: str) -> Vector:
            return _sum(vector for edge, vector in entries if edge == name)

        return all(_like(image(total(n), flip), total(shape.mirror_image(n, AXES[axis]))) for n, _ in entries)

    # In an edge's own frame only the component along the edge, the second, changes its sign.
    return mirrored(lines, axis) and all(mirrored(entries, 1) for entries in (*frames.values(), moments))


def _mirrored_points(scene: Scene, axis: int) -> bool:
    loads, near = scene.loads.point_loads, SAME * scene.shell.shape.size

    def total(point: Vector) -> Vector:
        return _sum(load.force for load in loads if math.dist(load.at, point) <= near)

    return all(_like(image(total(load.at), axis), total(image(load.at, axis))) for load in loads)


def _mirrored_supports(scene: Scene, axis: int) -> bool:
    shape = scene.shell.shape
    near = SAME * shape.size

    def matches(one: Support, other: Support) -> bool:
        if isinstance(one.where, str):
            name = one.where if one.where == "surface" else shape.mirror_image(one.where, AXES[axis])
            close = name == other.where
        else:
            close = not isinstance(other.where, str) and math.dist(image(one.where, axis), other.where) <= near
        return close and one.held == other.held and image(one.displacement, axis) == other.displacement

    return all(any(matches(one, other) for other in scene.supports) for one in scene.supports)


def _sum(vectors: Iterable[Vector]) -> Vector:
    x, y, z = (sum(components) for components in zip((0.0, 0.0, 0.0), *vectors, strict=True))
    return x, y, z


def _like(one: Vector, other: Vector) -> bool:
    return math.dist(one, other) <= SAME * math.hypot(*one, *other)
