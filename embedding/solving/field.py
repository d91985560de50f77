"""The field of a scene, made dimensionless for a mesh: its sources, what the shell is, what is around it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from ngsolve import CF, Cross, InnerProduct

from embedding.ambient.sources import Electrodes, Source
from embedding.ambient.transmission import Matter
from embedding.coupling.physics import FieldPhysics, Solid
from embedding.errors import Problem, SceneError
from embedding.geometry.domain import Domain
from embedding.geometry.reduction import Reduction
from embedding.plan.decisions import Plan
from embedding.scene import AppliedField, Body, Electrode, LineCurrent, Scales, Scene
from embedding.solving.expressions import vector_at, vector_over_surface
from embedding.solving.shell import pick

NOTHING: dict[str, Callable[[Domain], Any]] = {
    "relative_permittivity": lambda _: CF(1.0),
    "relative_permeability": lambda _: CF(1.0),
    "remanence": lambda domain: CF((0.0,) * domain.mesh.dim),
    "polarisation": lambda domain: CF((0.0,) * domain.mesh.dim),
    "saturation": lambda _: CF(1e6),
}
"""What a shell has where only some of its regions state a quantity."""


def field_on(scene: Scene, plan: Plan, scales: Scales, domain: Domain) -> FieldPhysics | None:
    """The dimensionless statement of the field on the mesh of ``domain``; None for a scene without one.

    Raises:
        SceneError: a wire passes through the elements that touch the shell.
    """
    ambient = scene.ambient
    if ambient is None or plan.extent == "none":
        return None
    refuse_close_wires(scene, domain, scales)
    return FieldPhysics(
        electrodes=_electrodes(scene, scales),
        matter=_matter(scene, domain, scales),
        applied=_applied(scene, plan, scales),
        grounded=ambient.outer == "grounded",
        odd_planes=plan.odd_planes,
        extent=plan.extent,
        varying=_varying(scene, plan.reduction, scales),
        bodies=tuple(_body(body, plan.reduction, scales) for body in ambient.bodies),
        liquids={"outside": ambient.contrast, "inside": ambient.inside_contrast},
        beyond=plan.sizes.beyond,
    )


def _electrodes(scene: Scene, scales: Scales) -> Electrodes:
    faces, lengths = scene.faces, 1 if scene.shell.shape.reductions == ("plane-strain",) else 2
    unit = scales.flux_density * scales.length**lengths
    if faces.both is not None:
        return Electrodes(_source(faces.both, scales, unit), joined=True)
    top, bottom = (None if e is None else _source(e, scales, unit) for e in (faces.top, faces.bottom))
    where = next((e.where for e in (faces.top, faces.bottom) if e is not None and e.where), ())
    return Electrodes(top, bottom, where=where)


def _source(stated: Electrode | Body, scales: Scales, unit_charge: float) -> Source:
    if stated.charge is not None:
        return Source(charge=stated.charge / unit_charge)
    return Source(voltage=(stated.voltage or 0.0) / scales.potential)


def _matter(scene: Scene, domain: Domain, scales: Scales) -> Matter:
    shell, electric = scene.shell, scene.ambient is not None and scene.ambient.field == "electric"
    contrast, remanence = ("relative_permittivity", "polarisation") if electric else (
        "relative_permeability", "remanence")  # fmt: skip

    def over(name: str, scaled: Callable[[Any], Any]) -> Any:
        parts = [(r, scaled(getattr(r, name))) for r in shell.regions if getattr(r, name) is not None]
        stated = getattr(shell, name)
        if stated is None and not parts:
            return None
        return pick(domain, parts, scaled(stated) if stated is not None else NOTHING[name](domain))

    return Matter(
        over(contrast, float),
        over(remanence, lambda b: vector_over_surface(b, domain.reduction, scales) / scales.flux_density),
        over("saturation", lambda js: js / scales.flux_density) if not electric else None,
    )


def _applied(scene: Scene, plan: Plan, scales: Scales) -> tuple[float, ...]:
    stated = scene.ambient.uniform_field if scene.ambient is not None else (0.0, 0.0, 0.0)
    return tuple(component / scales.field for component in plan.reduction.project(stated))


def _varying(scene: Scene, reduction: Reduction, scales: Scales) -> Callable[[Any], Any] | None:
    """The applied field that depends on the place, from a position on the mesh to mesh components."""
    ambient = scene.ambient
    if ambient is None:
        return None
    parts: list[Callable[[Any], Any]] = []
    stated = ambient.applied_field
    if isinstance(stated, AppliedField):
        parts.append(lambda x: vector_at(stated, x, reduction, scales) / scales.field)
    for line in ambient.line_currents:
        parts.append(_line_current(line, reduction, scales))
    if not parts:
        return None
    return lambda x: sum((part(x) for part in parts[1:]), parts[0](x))


def _line_current(line: LineCurrent, reduction: Reduction, scales: Scales) -> Callable[[Any], Any]:
    """H = I / 2 pi  t x d / |d|^2 around a straight line along t, d the distance vector from it (Biot and Savart)."""
    strength = line.current / (2 * math.pi * scales.length * scales.field)
    through = CF(tuple(c / scales.length for c in line.through))
    size = math.hypot(*line.along)
    along = CF(tuple(c / size for c in line.along))

    def field(x: Any) -> Any:
        place = x if reduction.dimension == 3 else CF((x[0], x[1], 0.0))
        away = place - through
        away = away - InnerProduct(away, along) * along
        h = strength / InnerProduct(away, away) * Cross(along, away)
        return h if reduction.dimension == 3 else CF((h[0], h[1]))

    return field


def refuse_close_wires(scene: Scene, domain: Domain, scales: Scales) -> None:
    """Line currents must not pass through the elements that touch the shell, which hold the applied field's own energy.

    Raises:
        SceneError: one does.
    """
    wires = scene.ambient.line_currents if scene.ambient is not None else ()
    if not wires or not domain.has_ambient:
        return
    near = [e for side in ("outside", "inside") for e in domain.mesh.Materials(domain.near(side)).Elements()]
    points = np.array([[domain.mesh[v].point for v in element.vertices] for element in near])
    points = np.pad(points, ((0, 0), (0, 0), (0, 3 - points.shape[2])))
    centres = points.mean(axis=1)
    reach = np.linalg.norm(points - centres[:, None], axis=2).max(axis=1)
    problems = []
    for number, wire in enumerate(wires):
        along = np.array(wire.along) / np.linalg.norm(wire.along)
        away = np.cross(centres - np.array(wire.through) / scales.length, along)
        if np.any(np.linalg.norm(away, axis=1) < reach):
            reason = "not allowed: the wire passes through the elements that touch the shell"
            advice = "move it away, or make the mesh on the shell finer"
            problems.append(Problem(f"ambient.line_currents.{number}", f"{reason}; {advice}"))
    if problems:
        raise SceneError(problems)


def _body(body: Body, reduction: Reduction, scales: Scales) -> Source | Solid:
    lengths = 1 if reduction.name == "plane-strain" else 2
    if body.is_conductor:
        if body.potential is not None:
            return Source(voltage=body.potential / scales.potential)
        return _source(body, scales, scales.flux_density * scales.length**lengths)
    remanence = None
    if body.remanence is not None:
        remanence = tuple(b / scales.flux_density for b in reduction.project(body.remanence))
    return Solid(body.contrast, remanence)
