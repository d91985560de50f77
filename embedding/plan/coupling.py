"""How much field and shell know of each other: the rung of coupling."""

from __future__ import annotations

from collections.abc import Iterator

from embedding.errors import Problem, SceneError
from embedding.plan.allowance import Allowance
from embedding.plan.decisions import Decision, Extent
from embedding.plan.effects import Effects
from embedding.scene import Scene, Stage

REASONS = {
    "joint": "one Newton step for shell and field: quadratic, and stable up to the limit point itself",
    "staggered": "field and shell in turn until neither changes the other: the joint answer, slower near pull-in",
    "unperturbed": "the applied field acts on the shell as if the shell did not change it",
    "once": "the field of the undeformed shape acts as a given load: how far that is off is recorded (coupling_gap)",
}


def choose_coupling(scene: Scene, extent: Extent, effects: Effects, allowance: Allowance) -> Decision | None:
    """The rung of a scene with a field, None without one.

    Raises:
        SceneError: a stage needs the joint tangent.
    """
    if extent == "none":
        return None
    stated, number = scene.model.coupling, effects.coupling
    rung, why = ("joint" if stated == "auto" else stated), "" if stated == "auto" else "pinned by the scene; "
    if stated == "auto" and extent == "given":
        rung = "unperturbed"
    elif stated == "auto" and _once(scene, extent, held=effects.loading.held) and allowance.permits(number):
        rung, why = "once", "how far the field's forces change with the shape is within the accuracy; "
    problems = list(_refused(scene, rung))
    if problems:
        raise SceneError(problems)
    measure = "effect on the answer of how the field's forces change with the shape"
    return Decision("coupling", rung, why + REASONS[rung], number, measure, allowance.threshold)


def _once(scene: Scene, extent: Extent, *, held: bool) -> bool:
    """May the field be solved once? Between electrodes alone that saves nothing, nor around a shell that is held; and
    what follows a path by arc length, as a stage without ``steps`` does, stays as it is."""
    left_open = [stage for stage in scene.path if stage.control == "auto" and stage.volume_ratio is None]
    followed = any(stage.steps is None for stage in left_open)
    return extent == "surroundings" and not held and not followed and not any(_refused(scene, "once"))


def _refused(scene: Scene, rung: str) -> Iterator[Problem]:
    if rung in ("joint", "unperturbed"):
        return
    for number, stage in enumerate(scene.path):
        for field in _needs_tangent(stage):
            reason = f'with model.coupling = "{rung}" there is no joint tangent to follow a path with'
            yield Problem(f"path.{number}.{field}", f"not allowed: {reason}; use joint, or control the load")


def _needs_tangent(stage: Stage) -> Iterator[str]:
    if stage.control in ("arc-length", "displacement"):
        yield "control"
    if stage.until is not None:
        yield "until"
    if stage.branch is not None:
        yield "branch"
