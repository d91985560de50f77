"""Which dimensional reduction and which mirror planes carry a scene without changing its answer."""

from __future__ import annotations

from embedding.geometry.reduction import Reduction
from embedding.plan.decisions import Decision
from embedding.scene import InfiniteCylinder, PressureField, Scene, Sphere, axisymmetry_problems

AXES = ("x", "y", "z")


def choose_reduction(scene: Scene) -> tuple[Reduction, Decision]:
    """The cheapest reduction that the shape and the loads allow, or the one the scene pins."""
    if scene.model.reduction != "auto":
        name, reason = scene.model.reduction, "pinned by the scene"
    elif isinstance(scene.shell.shape, InfiniteCylinder):
        name, reason = "plane-strain", "an infinite cylinder is treated per length"
    elif "axisymmetric" not in scene.shell.shape.reductions:
        name, reason = "3d", "the shape has no axis"
    else:
        obstacles = [problem.path for problem in axisymmetry_problems(scene)] + _lopsided_supports(scene)
        name = "3d" if obstacles else "axisymmetric"
        reason = f"{obstacles[0]} is not axisymmetric" if obstacles else "shape and loads share the z axis"
    planes = _mirror_planes(scene, name)
    if planes:
        reason += f"; mirrored about {', '.join(planes)}"
    choice = f"{name}, 1/{2 ** len(planes)}" if planes else name
    return Reduction(name, planes), Decision("dimension", choice, reason)


def _lopsided_supports(scene: Scene) -> list[str]:
    """Supports that hold x without y or the other way round, by the path of their field."""
    fixed = [support.fix for support in scene.supports]
    return [f"supports.{i}.fix" for i, fix in enumerate(fixed) if ("x" in fix) != ("y" in fix)]


def _mirror_planes(scene: Scene, reduction: str) -> tuple[str, ...]:
    if scene.model.symmetry == "none" or reduction == "axisymmetric" or scene.shell.shape.kind == "plate":
        return ()
    candidates = AXES if isinstance(scene.shell.shape, Sphere) else AXES[:2]
    planes = tuple(axis for axis in candidates if _mirrored(scene, AXES.index(axis)))
    if reduction == "plane-strain" and len(planes) < 2:
        return ()  # the cross-section is meshed whole or as a quarter
    return planes


def _mirrored(scene: Scene, axis: int) -> bool:
    """Is the scene its own image in the coordinate plane ``axis`` (the potential up to its sign)?"""
    loads = scene.loads
    vectors = [loads.body_force, *(edge.traction for edge in loads.edge_tractions)]
    if any(vector[axis] for vector in vectors):
        return False
    if not all(_even(field, scene.shell.shape.sample_points(), axis) for field in loads.pressure_fields.values()):
        return False
    applied = scene.ambient.applied_field if scene.ambient is not None else (0.0, 0.0, 0.0)
    if applied[axis] == 0.0:
        return True
    alone = not any(applied[other] for other in range(3) if other != axis)
    charged = any(e is not None and e.voltage != 0.0 for e in (scene.faces.top, scene.faces.bottom))
    return alone and not charged


def _even(field: PressureField, points: tuple[tuple[float, float, float], ...], axis: int) -> bool:
    for point in points:
        x, y, z = (-c if i == axis else c for i, c in enumerate(point))
        here, there = float(field(*point)), float(field(x, y, z))
        if abs(here - there) > 1e-9 * max(abs(here), abs(there)):
            return False
    return True


def odd_planes(scene: Scene, reduction: Reduction) -> tuple[str, ...]:
    """Mirror planes across which the applied field points: there the potential is zero."""
    if scene.ambient is None:
        return ()
    return tuple(axis for axis in reduction.planes if scene.ambient.applied_field[AXES.index(axis)] != 0.0)
