"""The meshes and orders that are tried, the cheapest first, and how far up one has to go."""

from __future__ import annotations

import math
from dataclasses import dataclass

from embedding.plan.decisions import Plan
from embedding.scene import Scene

STRETCHED = ((2, 2.0), (2, 1.0), (3, 1.0), (3, 0.5), (4, 0.5), (4, 0.25), (4, 0.125))
"""Orders, and sizes of elements over the planned ones. Where a shell is stretched, elements of twice the planned size
and order 2 give a per cent."""
BENT = ((3, 1.0), (3, 0.5), (4, 0.5), (4, 0.25), (4, 0.125))
"""The same where it is bent: order 2 may not resolve the planned mesh at all."""
LOOSE = 1e-3
"""Down to here the coarsest mesh is tried first: it costs little, and does on smooth problems."""
GAIN = 6.0
"""By what one level reduces the discretisation's error, at least where it is smooth (docs/accuracy.md)."""
AT_EDGES = (1.0, 0.25, 0.0625)
"""Sizes along rims and sharp edges over the planned ones: a field that is singular there gains by those alone."""
SKIPPED = {"3d": 1, "axisymmetric": 2, "plane-strain": 2}
"""Levels that may be left out at once: in 3D each costs several times the one before."""


@dataclass(frozen=True)
class Level:
    """A place on the ladder of meshes, and one on that of edges."""

    mesh: int
    edges: int = 0

    def changes(self, scene: Scene, plan: Plan) -> tuple[str, ...]:
        """The overrides of ``scene``, whose own ``plan`` the sizes are relative to."""
        size, (order, factor) = scene.shell.shape.size, ladder(plan)[self.mesh]
        changes = [f"discretisation.order={order}", f"discretisation.shell_size={factor * plan.sizes.shell * size!r}"]
        edges = {name: AT_EDGES[self.edges] * min(1.0, factor) * length * size for name, length in plan.sizes.edges}
        if edges:
            changes.append(f"discretisation.edge_size={{{', '.join(f'{n} = {s!r}' for n, s in edges.items())}}}")
        return tuple(changes)


def ladder(plan: Plan) -> tuple[tuple[int, float], ...]:
    """The orders and sizes for a plan."""
    return BENT if plan.bending else STRETCHED


def first_level(plan: Plan, relative: float) -> Level:
    """Where to start for an accuracy: a level that often reaches it."""
    return Level(0 if plan.bending or relative >= LOOSE else 2)


def next_level(plan: Plan, level: Level, excess: float, *, at_edges: bool) -> Level | None:
    """The level after ``level`` when the discretisation's error is ``excess`` times what it may be; None at the top.

    ``at_edges`` says that it is that of a field at edges.
    """
    if at_edges and level.edges + 1 < len(AT_EDGES):
        up = 1 if excess < 4.0 else 2
        return Level(level.mesh, min(level.edges + up, len(AT_EDGES) - 1))
    needed = math.ceil(math.log(max(excess, 1.0)) / math.log(GAIN)) if math.isfinite(excess) else 1
    mesh = level.mesh + min(max(1, needed), 1 + SKIPPED[plan.reduction.name])
    top = len(ladder(plan)) - 1
    if level.mesh == top:
        return None
    return Level(min(mesh, top), level.edges)
