"""The loads of a scene, made dimensionless for a mesh."""

from __future__ import annotations

from typing import Any

import ngsolve

from embedding.errors import Problem, SceneError
from embedding.geometry.domain import Domain
from embedding.geometry.places import locate
from embedding.geometry.reduction import Reduction
from embedding.scene import ForceField, PointLoad, PressureField, Scales, Scene
from embedding.shell.edges import EdgeForce
from embedding.shell.loads import MechanicalLoads
from embedding.solving.expressions import over_surface
from embedding.solving.shell import density_on

Vector = tuple[float, float, float]


def mechanical_loads(scene: Scene, domain: Domain, scales: Scales) -> MechanicalLoads:
    """The loads of ``scene`` in mesh components.

    Raises:
        SceneError: a point load is not on the mid-surface, or a line within the shell is loaded like an edge.
    """
    loads, reduction = scene.loads, domain.reduction
    if problems := _lines_inside(scene, domain):
        raise SceneError(problems)

    def line(traction: Vector) -> tuple[float, ...]:
        return tuple(t / scales.line_force for t in reduction.project(traction))

    return MechanicalLoads(
        pressure_top=_pressure(loads.pressure_top, reduction, scales),
        pressure_bottom=_pressure(loads.pressure_bottom, reduction, scales),
        edge_tractions=tuple((e.edge, line(e.traction)) for e in loads.edge_tractions if e.frame == "global"),
        body_force=_body_force(scene, domain, scales),
        rim_is_free=loads.rim == "traction-free",
        variant=loads.variant,
        edge_forces=_edge_forces(scene, scales),
        line_loads=tuple((load.line, line(load.force)) for load in loads.line_loads),
        edge_moments=tuple((load.edge, load.moment / scales.force) for load in loads.edge_moments),
        point_forces=_point_forces(scene, domain, scales),
        surface_force=_surface_force(scene, reduction, scales),
    )


def _pressure(pressure: float | PressureField, reduction: Reduction, scales: Scales) -> Any:
    if not isinstance(pressure, PressureField):
        return float(pressure) / scales.stress
    return over_surface(pressure, reduction, scales) / scales.stress


def _body_force(scene: Scene, domain: Domain, scales: Scales) -> tuple[Any, ...]:
    force = domain.reduction.project(scene.loads.body_force)
    pull = domain.reduction.project(scene.loads.gravity)
    density = density_on(scene, domain) if any(pull) else 0.0
    return tuple((b + density * g if g else b) / scales.force_density for b, g in zip(force, pull, strict=True))


def _surface_force(scene: Scene, reduction: Reduction, scales: Scales) -> Any:
    force = scene.loads.surface_force
    if not isinstance(force, ForceField):
        return tuple(q / scales.stress for q in reduction.project(force)) if any(force) else None
    x, y, z = (over_surface(component, reduction, scales) / scales.stress for component in force.components)
    # At y = 0 the x axis is the radial direction of axisymmetry.
    return ngsolve.CF({"3d": (x, y, z), "axisymmetric": (x, z), "plane-strain": (x, y)}[reduction.name])


def _edge_forces(scene: Scene, scales: Scales) -> tuple[EdgeForce, ...]:
    def scaled(traction: Vector) -> Vector:
        a, b, c = (t / scales.line_force for t in traction)
        return a, b, c

    framed = [edge for edge in scene.loads.edge_tractions if edge.frame == "edge"]
    return tuple(EdgeForce(e.edge, scaled(e.traction), e.kind == "follower") for e in framed)


def _lines_inside(scene: Scene, domain: Domain) -> list[Problem]:
    """Loads that need the frame of an edge, on lines where there is none because the shell goes on."""
    loads = scene.loads
    framed = [(f"edge_tractions.{i}.edge", e.edge) for i, e in enumerate(loads.edge_tractions) if e.frame == "edge"]
    framed += [(f"edge_moments.{i}.edge", moment.edge) for i, moment in enumerate(loads.edge_moments)]
    inside = set(domain.mesh.GetBBoundaries()) - set(domain.rims)
    reason = "is not allowed: the shell goes on there, so that the line has no outward direction"
    return [Problem(f"loads.{path}", f'"{edge}" {reason}') for path, edge in framed if edge in inside]


def _point_forces(
    scene: Scene, domain: Domain, scales: Scales
) -> tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]:
    reduction = domain.reduction
    # In plane strain a force is one per metre along z.
    unit = scales.line_force if reduction.name == "plane-strain" else scales.force
    forces, problems = [], []
    for number, load in enumerate(scene.loads.point_loads):
        place = tuple(c / scales.length for c in reduction.project(load.at))
        nearest = locate(domain, place)
        if nearest.on_surface:
            forces.append((place, tuple(f / unit for f in reduction.project(load.force))))
        else:
            problems.append(_off_surface(number, load, nearest.distance * scales.length))
    if problems:
        raise SceneError(problems)
    return tuple(forces)


def _off_surface(number: int, load: PointLoad, distance: float) -> Problem:
    reason = f"must be a point of the mid-surface, which is {distance:.3g} m away"
    return Problem(f"loads.point_loads.{number}.at", f"{list(load.at)} is not allowed: {reason}")
