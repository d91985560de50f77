"""Which dimensional reduction and which mirror planes carry a scene without changing its answer."""

from __future__ import annotations

from embedding.geometry.reduction import Reduction
from embedding.plan.decisions import Decision
from embedding.plan.mirror import mirrored_loads
from embedding.plan.parity import EVEN, parities
from embedding.scene import Scene, axisymmetry_problems

AXES = ("x", "y", "z")


def choose_reduction(scene: Scene) -> tuple[Reduction, Decision]:
    """The cheapest reduction that the shape and the loads allow, or the one the scene pins."""
    if scene.model.reduction != "auto":
        name, reason = scene.model.reduction, "pinned by the scene"
    elif scene.shell.shape.reductions == ("plane-strain",):
        kind = "an infinite cylinder" if scene.shell.shape.closed else "a cross-section"
        name, reason = "plane-strain", f"{kind} is treated per length"
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
    fixed = [support.held for support in scene.supports]
    return [f"supports.{i}.fix" for i, fix in enumerate(fixed) if ("x" in fix) != ("y" in fix)]


def _mirror_planes(scene: Scene, reduction: str) -> tuple[str, ...]:
    if scene.model.symmetry == "none" or reduction == "axisymmetric":
        return ()
    planes = tuple(axis for axis in scene.shell.shape.mirrors if _mirrored(scene, AXES.index(axis)))
    if reduction == "plane-strain" and len(planes) < 2:
        return ()  # the cross-section is meshed whole or as a quarter
    return planes


def _mirrored(scene: Scene, axis: int) -> bool:
    """Is the scene its own image in the coordinate plane ``axis`` (the potential up to its sign)?"""
    return mirrored_loads(scene, axis) and bool(parities(scene, axis))


def odd_planes(scene: Scene, reduction: Reduction) -> tuple[str, ...]:
    """Mirror planes in which the potential changes its sign: there it is zero."""
    return tuple(axis for axis in reduction.planes if EVEN not in parities(scene, AXES.index(axis)))
