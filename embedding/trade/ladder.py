"""The rungs between the cheapest and the dearest way to solve a scene, one change away from what the plan chose."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from embedding.plan import explain
from embedding.plan.decisions import Plan
from embedding.scene import Scene

ORDERS = (1, 2, 3, 4)
MESHES = {"mesh x 2": 2.0, "mesh / 2": 0.5}
"""Sizes of the elements on the shell over those of the plan."""
PLANNED, FINEST = "as planned", "finest"


@dataclass(frozen=True)
class Rung:
    """A way to solve the scene: ``changes`` are overrides of it, ``of`` says what they are about."""

    name: str
    of: str
    changes: tuple[str, ...] = ()


def ladder(scene: Scene) -> tuple[Rung, ...]:
    """All rungs: what the plan chose, the finest that serves as reference, and between them one choice changed at a
    time: order and mesh of the shell, alone and together, reduction, shell theory, faces, coupling, far field.

    A rung may turn out not to fit the scene; solving it says so.
    """
    plan = explain(scene)
    rungs = [Rung(PLANNED, "plan"), *_meshes(scene, plan), *_models(scene, plan)]
    return tuple(rungs)


def _meshes(scene: Scene, plan: Plan) -> Iterator[Rung]:
    size, planned = plan.sizes.shell * scene.shell.shape.size, plan.sizes.order
    for order in ORDERS:
        if order != planned:
            yield Rung(f"order {order}", "order", (_order(order),))
    for name, factor in MESHES.items():
        yield Rung(name, "mesh", (_size(factor * size),))
        for order in ORDERS:
            if order != planned and not (order == max(ORDERS) and factor == min(MESHES.values())):
                yield Rung(f"order {order}, {name}", "order and mesh", (_order(order), _size(factor * size)))
    open_space = scene.ambient is not None and scene.ambient.box is None and plan.extent == "surroundings"
    far_field = ("model.far_field=infinite",) if open_space else ()
    yield Rung(FINEST, "reference", (_order(max(ORDERS)), _size(min(MESHES.values()) * size), *far_field))


def _models(scene: Scene, plan: Plan) -> Iterator[Rung]:
    """Other models than the planned ones, on the planned mesh."""
    size = plan.sizes.shell * scene.shell.shape.size
    if plan.reduction.name != "3d" and "3d" in scene.shell.shape.reductions:
        yield Rung("3d", "reduction", ("model.reduction=3d",))
        yield Rung("3d, mesh of the plan", "reduction", ("model.reduction=3d", _size(size)))
    theory = "membrane" if plan.bending else "bending"
    yield Rung(theory, "shell theory", (f"model.theory={theory}",))
    if scene.ambient is None:
        return
    if plan.extent == "surroundings":
        interface = "closed" if plan.opened else "opened"
        yield Rung(f"faces {interface}", "faces", (f"model.interface={interface}",))
        if scene.ambient.box is None:
            end = "robin" if plan.sizes.beyond else "infinite"
            yield Rung(f"far field {end}", "far field", (f"model.far_field={end}",))
    for coupling in ("joint", "staggered", "once", "unperturbed"):
        if coupling != plan.coupling:
            yield Rung(f"coupling {coupling}", "coupling", (f"model.coupling={coupling}",))


def _order(order: int) -> str:
    return f"discretisation.order={order}"


def _size(size: float) -> str:
    return f"discretisation.shell_size={size!r}"
