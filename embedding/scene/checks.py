"""Cross checks: what is right field by field and still cannot be one scene. All findings are collected.

Each check is a generator of problems of its own, so that one that touches a wrong field is left out alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.checks_field import FIELD_CHECKS
from embedding.scene.loads import PressureField
from embedding.scene.messages import choice, quoted
from embedding.scene.part import Unavailable, known
from embedding.scene.shapes import Point
from embedding.scene.symmetry import unsymmetric_field, unsymmetric_pressures, unsymmetric_vectors

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def cross_problems(scene: Scene) -> tuple[Problem, ...]:
    """Everything that does not fit together; checks on fields that are themselves wrong are left out."""
    found: list[Problem] = []
    for check in (*MECHANICAL_CHECKS, *FIELD_CHECKS, *MODEL_CHECKS):
        try:
            for problem in check(scene):
                found.append(problem)
        except Unavailable:
            continue
    return tuple(found)


def _thickness(scene: Scene) -> Iterator[Problem]:
    radius, thickness = scene.shell.shape.curvature_radius, scene.shell.thickness
    if radius is not None and thickness / 2 >= radius:
        yield Problem(
            "shell.thickness",
            f"{thickness} m is not allowed: half of it must be less than {_radius(scene)} = {radius} m, "
            "or the inner face crosses the centre of curvature",
        )


def _radius(scene: Scene) -> str:
    """What the smallest radius of curvature is called."""
    shape = scene.shell.shape
    same = (name for name in ("radius", "tube_radius") if getattr(shape, name, None) == shape.curvature_radius)
    return next((f"shell.shape.{name}" for name in same), "the shape's smallest radius of curvature")


def _supports(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    allowed = (*shape.edges, "surface")
    for number, support in enumerate(scene.supports):
        if support.where not in allowed:
            message = f'{choice(support.where, allowed)} (the shape is a "{shape.kind}")'
            yield Problem(f"supports.{number}.where", message)


def _edge_tractions(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for number, load in enumerate(scene.loads.edge_tractions):
        path = f"loads.edge_tractions.{number}.edge"
        if not shape.edges:
            yield Problem(path, f'"{load.edge}" is not allowed: a shape of kind "{shape.kind}" has no edges')
        elif load.edge not in shape.edges:
            yield Problem(path, f'{choice(load.edge, shape.edges)} (the shape is a "{shape.kind}")')


def _pressure_values(scene: Scene) -> Iterator[Problem]:
    for name, pressure in scene.loads.pressure_fields.items():
        bad = [point for point in scene.shell.shape.sample_points() if not _finite(pressure, point)]
        if bad:
            where = ", ".join(f"{axis} = {value:.3g} m" for axis, value in zip("xyz", bad[0], strict=True))
            message = f"{pressure.expression} is not allowed: it has no finite value at {where}"
            yield Problem(f"loads.{name}.expression", message)


def _finite(pressure: PressureField, point: Point) -> bool:
    try:
        return math.isfinite(pressure(*point))
    except (ArithmeticError, ValueError, TypeError):  # TypeError: a root of a negative number is complex
        return False


def _infinitely_long(scene: Scene) -> Iterator[Problem]:
    if scene.shell.shape.reductions != ("plane-strain",):
        return
    axial = scene.loads.body_force[2]
    if axial != 0.0:
        message = f"{axial} N/m^3 is not allowed: must be 0 along the axis of an infinite cylinder"
        yield Problem("loads.body_force.2", message)
    for name, pressure in scene.loads.pressure_fields.items():
        if "z" in pressure.parsed.variables:
            message = f"{pressure.expression} is not allowed: must not depend on z along an infinite cylinder"
            yield Problem(f"loads.{name}.expression", message)


def _volume_control(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for number, stage in enumerate(scene.path):
        if known(stage.volume_ratio) is None:
            continue
        path = f"path.{number}.volume_ratio"
        if not shape.closed:
            reason = "only closed shells enclose a volume"
            yield Problem(path, f'not allowed for a shape of kind "{shape.kind}": {reason}')
        for name in scene.loads.pressure_fields:
            reason = f"loads.{name} varies over the surface, and volume control needs uniform pressures"
            yield Problem(path, f"not allowed: {reason}")


def _reduction(scene: Scene) -> Iterator[Problem]:
    shape, reduction = scene.shell.shape, scene.model.reduction
    if reduction != "auto" and reduction not in shape.reductions:
        allowed = quoted(("auto", *shape.reductions))
        message = f'"{reduction}" is not allowed: must be {allowed} for a shape of kind "{shape.kind}"'
        yield Problem("model.reduction", message)


def _edge_sizes(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for edge in scene.discretisation.edge_size:
        if edge not in shape.edges:
            path = f"discretisation.edge_size.{edge}"
            kind = f'a shape of kind "{shape.kind}"'
            yield Problem(path, f"unknown edge: {kind} has {quoted(shape.edges) or 'no edges'}")


def _symmetric_vectors(scene: Scene) -> Iterator[Problem]:
    if scene.model.reduction == "axisymmetric":
        yield from unsymmetric_vectors(scene)


def _symmetric_field(scene: Scene) -> Iterator[Problem]:
    if scene.model.reduction == "axisymmetric":
        yield from unsymmetric_field(scene)


def _symmetric_pressures(scene: Scene) -> Iterator[Problem]:
    if scene.model.reduction == "axisymmetric":
        yield from unsymmetric_pressures(scene)


MECHANICAL_CHECKS = (
    _thickness,
    _supports,
    _edge_tractions,
    _pressure_values,
    _infinitely_long,
    _volume_control,
)
MODEL_CHECKS = (_reduction, _edge_sizes, _symmetric_vectors, _symmetric_field, _symmetric_pressures)
