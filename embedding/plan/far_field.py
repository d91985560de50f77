"""Where the meshed space ends and what follows: a mapped region to infinity, a Robin condition, or a grounded boundary.

Lengths are in shell sizes. The reach is how far the shell and the bodies extend from the origin, or from the point
below it on the surface of a half-space, around which the meshed space then ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from embedding.plan.allowance import Allowance
from embedding.plan.decisions import Decision
from embedding.plan.effects import Effects
from embedding.scene import Ambient, HalfSpace, Scene

ENOUGH = 3.0
"""Radius over reach from which the error of Robin's condition is below 1e-4."""
FAR_RADIUS = {"robin": 4.0, "infinite": 3.0, "grounded": 4.0}
CLEARANCE = {"robin": ENOUGH, "infinite": 1.5, "grounded": 1.5}
"""Default radius: at least that of ``FAR_RADIUS``, in which the shell has room to move and grow, and ``CLEARANCE``
times the reach. The mapped region costs as much as what lies between radii 3 and 4 on fine meshes and more on coarse
ones, so that Robin's condition at 4 is the cheaper of the two where it is good enough."""


@dataclass(frozen=True)
class FarField:
    """The ambient's radius, whether a mapped region follows it, and why."""

    radius: float
    beyond: bool
    decisions: tuple[Decision, ...]


def choose_far_field(scene: Scene, ambient: Ambient, effects: Effects, allowance: Allowance) -> FarField:
    """End the meshed space of a scene."""
    size, reach = scene.shell.shape.size, reach_of(scene, ambient)
    stated = ambient.radius / size if ambient.radius else None
    enough = _enough(effects, allowance)
    if stated is None:
        enough = max(enough, CLEARANCE["infinite"])
    kind = _kind(scene, ambient, stated, enough * reach)
    clearance = {**CLEARANCE, "robin": min(enough, ENOUGH)}
    radius = stated or max(FAR_RADIUS[kind], clearance[kind] * reach)
    default = f"default, {radius:g} times the shell" if radius == FAR_RADIUS[kind] else f"all lies within {reach:.3g}"
    reason, limit = "stated by the scene" if stated else default, 1 / max(clearance[kind], 1.0)
    where = Decision("ambient radius", f"{radius:.3g} x size", reason, reach / radius, "reach over radius", limit)
    pinned = "" if scene.model.far_field == "auto" else "pinned by the scene; "
    end = _decision(kind, pinned, effects.far_field(reach / radius), allowance)
    return FarField(radius, kind == "infinite", (where, end))


def _enough(effects: Effects, allowance: Allowance) -> float:
    """Radius over reach from which Robin's condition is good enough: for the stated accuracy, or for 1e-4."""
    if not allowance.stated:
        return ENOUGH
    return math.pow(effects.far_field(1.0) / allowance.threshold, 0.2)


def _kind(scene: Scene, ambient: Ambient, stated: float | None, needed: float) -> str:
    if ambient.outer == "grounded":
        return "grounded"
    if scene.model.far_field != "auto":
        return scene.model.far_field
    return "robin" if (stated or FAR_RADIUS["robin"]) >= needed else "infinite"


def _decision(kind: str, pinned: str, number: float, allowance: Allowance) -> Decision:
    if kind == "grounded":
        return Decision("far field", "grounded", "potential prescribed on the outer boundary, as the scene states")
    measure = "effect of Robin's condition on the answer"
    if kind == "robin":
        choice, reason = "second-order Robin", "exact for net charge and dipole; misses higher multipoles"
    else:
        choice, reason = "infinite map", "to infinity, to the order of the potential"
    return Decision("far field", choice, pinned + reason, number, measure, allowance.threshold)


def reach_of(scene: Scene, ambient: Ambient) -> float:
    """Distance from the centre of space (plane strain: of its axis) of the farthest point of the shell and of the
    bodies, or a little more."""
    seen = 2 if scene.shell.shape.reductions == ("plane-strain",) else 3
    others = [body.farthest(seen) + abs(_level(ambient)) for body in ambient.bodies if not isinstance(body, HalfSpace)]
    return max([shell_reach(scene, ambient), *(other / scene.shell.shape.size for other in others)])


def shell_reach(scene: Scene, ambient: Ambient) -> float:
    """The same of the shell alone."""
    shape, level = scene.shell.shape, _level(ambient)
    seen = 2 if shape.reductions == ("plane-strain",) else 3
    points = (math.hypot(*point[: seen - 1], point[seen - 1] - level) for point in shape.sample_points())
    return max(points) / shape.size


def _level(ambient: Ambient) -> float:
    return next((body.level for body in ambient.bodies if isinstance(body, HalfSpace)), 0.0)
