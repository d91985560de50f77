"""How much field and shell know of each other: the rung of coupling."""

from __future__ import annotations

from collections.abc import Iterator

from embedding.errors import Problem, SceneError
from embedding.plan.decisions import Decision
from embedding.scene import Scene, Stage

REASONS = {
    "joint": "one Newton step for shell and field: quadratic, and stable up to the limit point itself",
    "staggered": "field and shell in turn until neither changes the other: the joint answer, slower near pull-in",
    "unperturbed": "the applied field acts on the shell as if the shell did not change it",
    "once": "the field of the undeformed shape acts as a given load: how far that is off is recorded (coupling_gap)",
}


def choose_coupling(scene: Scene) -> Decision | None:
    """The rung of a scene with a field, None without one.

    Raises:
        SceneError: a stage needs the joint tangent.
    """
    if scene.ambient is None:
        return None
    stated = scene.model.coupling
    rung = "joint" if stated == "auto" else stated
    problems = list(_refused(scene, rung))
    if problems:
        raise SceneError(problems)
    pinned = "" if stated == "auto" else "pinned by the scene; "
    return Decision("coupling", rung, pinned + REASONS[rung])


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
