"""Cross checks of the bodies beside the shell: what they are in this field, and that there is room for them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.bodies import ELECTRIC, MAGNETIC, Body, HalfSpace
from embedding.scene.checks_field import axes_of
from embedding.scene.part import known

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def _fit_the_field(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None:
        return
    field = scene.ambient.field
    allowed = ELECTRIC if field == "electric" else MAGNETIC
    for number, body in enumerate(scene.ambient.bodies):
        for name in body.given:
            if name not in allowed:
                reason = f'not allowed when ambient.field is "{field}": a body has a {", ".join(allowed[:-1])}'
                yield Problem(f"ambient.bodies.{number}.{name}", f"{reason} or {allowed[-1]}")


def _within_space(scene: Scene) -> Iterator[Problem]:
    ambient = scene.ambient
    if ambient is None:
        return
    axes, radius, box = axes_of(scene), known(ambient.radius), known(ambient.box)
    for number, body in enumerate(ambient.bodies):
        path = f"ambient.bodies.{number}"
        if isinstance(body, HalfSpace):
            if box is not None and abs(body.level) >= box[axes - 1]:
                reason = f"must lie within {box[axes - 1]} m of the origin, where space ends"
                yield Problem(f"{path}.level", f"{body.level} m is not allowed: {reason}")
        elif _beyond(body, axes, radius, box):
            where = f"a sphere of radius {radius} m" if box is None else "ambient.box"
            yield Problem(path, f"not allowed here: it reaches beyond the end of space, {where}")


def _beyond(body: Body, axes: int, radius: float | None, box: tuple[float, float, float] | None) -> bool:
    if box is not None:
        return any(far >= end for far, end in list(zip(body.reach(axes), box, strict=True))[:axes])
    return radius is not None and body.farthest(axes) >= radius


def _clear_of_the_shell(scene: Scene) -> Iterator[Problem]:
    """Overlaps that a few points of the shell show; others are seen by the mesh."""
    if scene.ambient is None:
        return
    axes, points = axes_of(scene), scene.shell.shape.sample_points()
    for number, body in enumerate(scene.ambient.bodies):
        if isinstance(body, HalfSpace):
            yield from _below_the_shell(scene, f"ambient.bodies.{number}.level", body)
            continue
        covered = [point for point in points if body.clearance(point, axes) <= 0.0]
        if covered:
            place = ", ".join(f"{axis} = {value:.3g} m" for axis, value in zip("xyz"[:axes], covered[0], strict=False))
            yield Problem(f"ambient.bodies.{number}", f"not allowed here: the shell is inside it, at {place}")


def _below_the_shell(scene: Scene, path: str, body: HalfSpace) -> Iterator[Problem]:
    shape, axis = scene.shell.shape, axes_of(scene) - 1
    lowest = min(point[axis] for point in shape.sample_points())
    # The rim of a curved open shell may point down; then its lowest face is not half a thickness below.
    lies = shape.closed or shape.curvature_radius is None
    lowest -= scene.shell.thickest / 2 if lies else 0.0
    if body.level >= lowest:
        reason = f"must be less than {lowest:.6g} m, the lowest {'yz'[axis - 1]} of the shell"
        yield Problem(path, f"{body.level} m is not allowed: {reason}")


BODY_CHECKS = (_fit_the_field, _within_space, _clear_of_the_shell)
