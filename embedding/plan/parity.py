"""Is the field its own mirror image in a coordinate plane, up to the sign of the potential?

With an even potential every source is its own image, V(R x) = R V(x); with an odd one it is the opposite of it. Driven
conductors are even: one and the same potential on both sides.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from embedding.plan.mirror import SAME, Vector, image
from embedding.scene import Ambient, HalfSpace, Scene
from embedding.scene.surface_fields import SurfaceField

EVEN, ODD = 1, -1
PLACES: tuple[Vector, ...] = ((0.31, 0.77, 1.3), (1.2, 0.4, -0.9), (-2.1, 1.7, 0.6), (0.13, -0.57, 0.35))
"""Points in space without symmetry, relative to the size of the shape."""


def parities(scene: Scene, axis: int) -> tuple[int, ...]:
    """The signs the potential may take across coordinate ``axis`` (0, 1 or 2): ``EVEN``, ``ODD``, both or none."""
    ambient = scene.ambient
    if ambient is None:
        return (EVEN, ODD)
    patterned = any(electrode.where for electrode in scene.faces.electrodes.values())
    if ambient.line_currents or patterned or not all(_mirrored_bodies(scene, ambient, axis)):
        return ()
    return tuple(sign for sign in (EVEN, ODD) if all(_fit(scene, ambient, axis, sign)))


def _fit(scene: Scene, ambient: Ambient, axis: int, sign: int) -> Iterator[bool]:
    """Does each source go with that sign?"""
    shell, shape = scene.shell, scene.shell.shape
    on_it = shape.sample_points()
    around: list[Vector] = [(shape.size * x, shape.size * y, shape.size * z) for x, y, z in PLACES]
    remanences = (body.remanence for body in ambient.bodies if body.remanence is not None)
    for vector in (ambient.uniform_field, *shell.constant_vectors.values(), *remanences):
        yield all(sign * c == v for c, v in zip(image(vector, axis), vector, strict=True))
    for field in shell.vector_fields.values():
        yield _symmetric(field.components, on_it, axis, sign)
    if ambient.varying_field is not None:
        yield _symmetric(ambient.varying_field.components, [*on_it, *around], axis, sign)
    conductors = (*scene.faces.electrodes.values(), *ambient.bodies)
    yield sign == EVEN or all(conductor.strength == 0.0 for conductor in conductors)


def _mirrored_bodies(scene: Scene, ambient: Ambient, axis: int) -> Iterator[bool]:
    """Does each body lie across the plane? One that has its image on the other side would be cut away."""
    near = SAME * scene.shell.shape.size
    level_axis = 1 if scene.shell.shape.reductions == ("plane-strain",) else 2
    for body in ambient.bodies:
        yield axis != level_axis if isinstance(body, HalfSpace) else abs(body.centre[axis]) <= near


def _symmetric(components: Sequence[SurfaceField], points: Sequence[Vector], axis: int, sign: int) -> bool:
    for number, component in enumerate(components):
        flip = -sign if number == axis else sign
        for point in points:
            here, there = component.value_at(point), component.value_at(image(point, axis))
            if math.isnan(here) and math.isnan(there):
                continue  # undefined there: what holds on the shell is checked at its own points
            if not abs(there - flip * here) <= SAME * max(abs(here), abs(there)):
                return False
    return True
