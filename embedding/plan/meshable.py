"""What no mesh generator can do, said before it is tried: it would crash, or never come back.

The geometry kernel takes points closer than 1e-7 for the same one (Open CASCADE, Precision::Confusion), in coordinates
in which the shape has size 1.
"""

from __future__ import annotations

from collections.abc import Iterator

from embedding.errors import Problem, SceneError
from embedding.geometry.bodies import Body
from embedding.geometry.sizes import MeshSizes
from embedding.scene import Scene
from embedding.scene.messages import key_path

SMALLEST = 1e-5
"""Of anything that has a surface, in shell sizes: a hundred times what the kernel can tell apart."""
LARGEST = 1e6
"""Of the space around the shell, in shell sizes."""


def refuse_what_cannot_be_meshed(scene: Scene, sizes: MeshSizes) -> None:
    """Raises SceneError if the shape, the space around it or elements are out of all proportion."""
    problems = tuple(_shape(scene)) or (*_space(scene, sizes), *_elements(scene, sizes))
    if problems:
        raise SceneError(problems)


def _shape(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    columns = zip(*shape.sample_points(), strict=True)
    longest = max((max(column) - min(column) for column in columns), default=0.0)
    if shape.narrowest < SMALLEST * max(shape.size, longest):
        reason = f"{shape.narrowest:.3g} m across where it is narrowest, and {max(shape.size, longest):.3g} m long"
        yield Problem("shell.shape", f"not allowed: {reason}; the ratio must be at least {SMALLEST:g}")
    radius = shape.curvature_radius
    if radius is not None and not SMALLEST <= radius / shape.size <= 1 / SMALLEST:
        reason = f"its radius of curvature is {radius:.3g} m, and its size {shape.size:.3g} m"
        limits = f"the ratio must lie between {SMALLEST:g} and {1 / SMALLEST:g}; what is flatter is flat"
        yield Problem("shell.shape", f"not allowed: {reason}; {limits}")


def _space(scene: Scene, sizes: MeshSizes) -> Iterator[Problem]:
    unit = scene.shell.shape.size
    path = "ambient.radius" if sizes.box is None else "ambient.box"
    if sizes.radius > LARGEST:
        yield Problem(path, f"{sizes.radius * unit:.3g} m is not allowed: {_at_most(LARGEST * unit)}")
    if sizes.box is not None and min(sizes.box) < SMALLEST:
        yield Problem(path, f"{min(sizes.box) * unit:.3g} m is not allowed: must be at least {SMALLEST * unit:.3g} m")
    for number, body in enumerate(sizes.bodies):
        small = min(_lengths(body), default=1.0)
        if small < SMALLEST:
            reason = f"{small * unit:.3g} m is not allowed: must be at least {SMALLEST * unit:.3g} m beside this shell"
            yield Problem(f"ambient.bodies.{number}", reason)


def _lengths(body: Body) -> list[float]:
    return [length for length in (body.radius, body.length, *body.size) if length > 0.0]


def _elements(scene: Scene, sizes: MeshSizes) -> Iterator[Problem]:
    """Elements that the kernel could not tell apart; whether there is memory for all of them is asked when their number
    is known (:mod:`embedding.geometry.counting`)."""
    unit = scene.shell.shape.size
    named = [("discretisation.shell_size", sizes.shell)]
    named += [(key_path(("discretisation", "edge_size", edge)), size) for edge, size in sizes.edges]
    if sizes.radius > 0.0:
        named.append(("discretisation.ambient_size", sizes.far))
    for path, size in named:
        if size < SMALLEST:
            yield Problem(path, f"{size * unit:.3g} m is not allowed: must be at least {SMALLEST * unit:.3g} m")


def _at_most(length: float) -> str:
    return f"must be at most {length:.3g} m, {LARGEST:g} times the size of the shell"
