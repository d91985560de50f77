"""Cross checks: what is right field by field and still cannot be one scene. All findings are collected.

Each check is a generator of problems of its own, so that one that touches a wrong field is left out alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.checks_bodies import BODY_CHECKS
from embedding.scene.checks_electrodes import ELECTRODE_CHECKS
from embedding.scene.checks_field import FIELD_CHECKS
from embedding.scene.checks_loads import LOAD_CHECKS
from embedding.scene.checks_matter import MATTER_CHECKS
from embedding.scene.checks_shell import SHELL_CHECKS
from embedding.scene.loads import Loads
from embedding.scene.messages import key_path, quoted
from embedding.scene.output import output_problems
from embedding.scene.part import Unavailable, known
from embedding.scene.symmetry import UNSYMMETRIC

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

Check = Callable[["Scene"], Iterator[Problem]]


def cross_problems(scene: Scene) -> tuple[Problem, ...]:
    """Everything that does not fit together; checks on fields that are themselves wrong are left out."""
    found: list[Problem] = []
    for check in (*SHELL_CHECKS, *LOAD_CHECKS, _volume_control, _idle, *IN_SPACE, *MODEL_CHECKS):
        try:
            for problem in check(scene):
                found.append(problem)
        except Unavailable:
            continue
    return tuple(found)


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


def _idle(scene: Scene) -> Iterator[Problem]:
    """A stage that changes no load and is to end at a displacement: nothing would bring a point there."""
    begin: tuple[float, float] | None = (0.0, 0.0)
    for number, stage in enumerate(scene.path):
        end = (stage.mechanical, stage.field)
        known_end = known(stage.until) is None and known(stage.volume_ratio) is None
        if begin is not None and known(stage.until) is not None and not _driven(scene, begin, end):
            reason = "the stage changes no load and no field, so that nothing moves the point"
            yield Problem(f"path.{number}.until", f"not allowed: {reason}")
        begin = end if known_end else None  # the load at a displacement or a volume is not known before


def _driven(scene: Scene, begin: tuple[float, float], end: tuple[float, float]) -> bool:
    """Does anything change with the factors of loads and field from ``begin`` to ``end``?"""
    loaded = scene.loads != Loads(rim=scene.loads.rim, variant=scene.loads.variant)
    loaded = loaded or any(any(support.displacement) for support in scene.supports)
    with_field = known(scene.ambient) is not None
    return (loaded and begin[0] != end[0]) or (with_field and begin[1] != end[1])


def _reduction(scene: Scene) -> Iterator[Problem]:
    shape, reduction = scene.shell.shape, scene.model.reduction
    if reduction != "auto" and reduction not in shape.reductions:
        allowed = quoted(("auto", *shape.reductions))
        message = f'"{reduction}" is not allowed: must be {allowed} for a shape of kind "{shape.kind}"'
        yield Problem("model.reduction", message)


def _edge_sizes(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for edge in scene.discretisation.edge_size:
        names = tuple(dict.fromkeys((*shape.edges, *shape.kinks)))
        if edge not in names:
            path = key_path(("discretisation", "edge_size", edge))
            kind = f'a shape of kind "{shape.kind}"'
            yield Problem(path, f"unknown edge: {kind} has {quoted(names) or 'no edges'}")


def _axisymmetric(check: Check) -> Check:
    """``check`` where the scene asks for an axisymmetric reduction."""

    def pinned(scene: Scene) -> Iterator[Problem]:
        if scene.model.reduction == "axisymmetric":
            yield from check(scene)

    return pinned


IN_SPACE = (*FIELD_CHECKS, *ELECTRODE_CHECKS, *MATTER_CHECKS, *BODY_CHECKS)
MODEL_CHECKS = (_reduction, _edge_sizes, output_problems, *map(_axisymmetric, UNSYMMETRIC))
