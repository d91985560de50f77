"""Cross checks of the space around the shell: where it ends, what fills it, the field that is given in it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.bodies import HalfSpace
from embedding.scene.part import known
from embedding.scene.shapes import Annulus

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

CLOSE = 1e-12
"""Lengths that differ by less, relative to them, are equal."""


def axes_of(scene: Scene) -> int:
    """How many coordinates count: 2 in plane strain, else 3."""
    return 2 if scene.shell.shape.reductions == ("plane-strain",) else 3


def centre_of_space(scene: Scene) -> float:
    """Where on the last axis the centre of the outer boundary is, in m: the origin, or on the face of a half-space."""
    ambient = scene.ambient
    if ambient is None or known(ambient.box) is not None:
        return 0.0
    return next((body.level for body in ambient.bodies if isinstance(body, HalfSpace)), 0.0)


def varying(scene: Scene) -> bool:
    """Is a field given that is not the same everywhere?"""
    ambient = scene.ambient
    return ambient is not None and (ambient.varying_field is not None or bool(ambient.line_currents))


def applied(scene: Scene) -> bool:
    """Is a field given at all?"""
    return varying(scene) or (scene.ambient is not None and any(scene.ambient.uniform_field))


def _junctions(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    if known(scene.ambient) is not None and not shape.surroundable:
        if isinstance(shape, Annulus):
            yield Problem("ambient", "not allowed around a slit ring: there is no space between the lips of the slit")
            return
        reason = "more than two plates meet in its junction, and the space between them has no top and bottom"
        yield Problem("ambient", f'not allowed around a shape of kind "{shape.kind}": {reason}')


def _radius(scene: Scene) -> Iterator[Problem]:
    radius = known(scene.ambient.radius) if scene.ambient is not None else None
    if radius is None:
        return
    last, level = axes_of(scene) - 1, centre_of_space(scene)
    points = scene.shell.shape.sample_points()
    farthest = max(math.hypot(*point[:last], point[last] - level) for point in points)
    outside = farthest + scene.shell.thickest / 2
    if radius <= outside * (1 + CLOSE):
        centre = "the origin" if not level else "the point below the origin on the half-space"
        reason = f"the farthest point of the shell from {centre} plus half its thickness"
        yield Problem("ambient.radius", f"{radius} m is not allowed: must be greater than {outside:.6g} m, {reason}")


def _box(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or (box := known(scene.ambient.box)) is None:
        return
    if known(scene.ambient.radius) is not None:
        yield Problem("ambient.box", "not allowed beside ambient.radius: space ends at a sphere or at a box")
    if scene.ambient.outer != "grounded":
        reason = f'"{scene.ambient.outer}" is not allowed with ambient.box: open space ends at a sphere; use "grounded"'
        yield Problem("ambient.outer", reason)
    for axis in range(axes_of(scene)):
        outside = max(abs(point[axis]) for point in scene.shell.shape.sample_points())
        if box[axis] <= outside:
            reason = f"must be greater than {outside:.6g} m, as far as the shell extends along {'xyz'[axis]}"
            yield Problem(f"ambient.box.{axis}", f"{box[axis]} m is not allowed: {reason}")


def _inside(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.shell.shape.closed:
        return
    for name in ("inside_relative_permittivity", "inside_relative_permeability"):
        if known(getattr(scene.ambient, name)) is not None:
            reason = f'a shape of kind "{scene.shell.shape.kind}" is open and has no inside'
            yield Problem(f"ambient.{name}", f"not allowed: {reason}")


def _along_the_axis(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or axes_of(scene) == 3:
        return
    axial = scene.ambient.uniform_field[2]
    if axial != 0.0:
        unit = "V/m" if scene.ambient.field == "electric" else "A/m"
        long = "an infinite cylinder" if scene.shell.shape.closed else "what is infinitely long"
        message = f"{axial} {unit} is not allowed: must be 0 along the axis of {long}"
        yield Problem("ambient.applied_field.2", message)
    for number, current in enumerate(scene.ambient.line_currents):
        if current.along[0] != 0.0 or current.along[1] != 0.0:
            message = f"{list(current.along)} is not allowed: must be along z, along which nothing changes"
            yield Problem(f"ambient.line_currents.{number}.along", message)


def _currents(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is not None and scene.ambient.field == "electric" and scene.ambient.line_currents:
        yield Problem("ambient.line_currents", 'not allowed when ambient.field is "electric"')


def _conductors_in_varying_fields(scene: Scene) -> Iterator[Problem]:
    if not varying(scene) or scene.ambient is None:
        return
    paths = [f"faces.{name}" for name in scene.faces.electrodes]
    paths += [f"ambient.bodies.{i}" for i, body in enumerate(scene.ambient.bodies) if body.is_conductor]
    for path in paths:
        reason = "in an applied field that varies, or in that of line currents, there can be no conductors"
        yield Problem(path, f"not allowed: {reason}")


def _unperturbed(scene: Scene) -> Iterator[Problem]:
    if known(scene.ambient) is None or scene.model.coupling != "unperturbed":
        return
    pinned = 'model.coupling = "unperturbed": the field is the applied one alone'
    for name in scene.faces.electrodes:
        yield Problem(f"faces.{name}", f"not allowed with {pinned}")
    if scene.ambient is not None and scene.ambient.bodies:
        yield Problem("ambient.bodies", f"not allowed with {pinned}")
    if not applied(scene):
        yield Problem("ambient.applied_field", f"missing: needed with {pinned}")


FIELD_CHECKS = (
    _junctions,
    _radius,
    _box,
    _inside,
    _along_the_axis,
    _currents,
    _conductors_in_varying_fields,
    _unperturbed,
)
