"""What of the field is modelled, where the faces lie in it, and how its potential is written."""

from __future__ import annotations

from embedding.plan.allowance import Allowance
from embedding.plan.decisions import Decision, Extent
from embedding.plan.effects import Effects
from embedding.scene import Scene
from embedding.scene.checks_electrodes import inside_only, one_conductor
from embedding.scene.checks_field import applied

ROOM = 2.5
"""Elements along a rim, in thicknesses, that can hold faces opened to the full thickness one element away from it."""
SEEN = ("voltage", "charge", "potential", "flux", "force", "torque", "field_energy", "pressure_top", "pressure_bottom")
"""How scalars begin that only a field has: where one of them is asked for, the field is there."""

Chosen = tuple[Extent, tuple[Decision, ...]]


def choose_extent(scene: Scene, effects: Effects, allowance: Allowance) -> Chosen:
    """The least of the field that carries the scene: that around the shell, that inside it, or the given one alone;
    with a stated accuracy none of it where it is not felt."""
    if scene.ambient is None:
        return "none", (Decision("ambient", "none", "the scene has no field: nothing around the shell is meshed"),)
    felt = _felt(effects, allowance)
    if scene.model.coupling == "unperturbed":
        reason = "pinned by the scene; the shell is taken not to change the applied field: nothing around it is meshed"
        return "given", (felt, _given(reason, effects, allowance))
    if inside_only(scene):
        pinned = "pinned by the scene; " if scene.model.surroundings == "none" else ""
        return "inside", (felt, _inside(pinned, effects, allowance))
    asked = any(name.startswith(SEEN) for name in effects.loading.of)
    if scene.model.surroundings == "meshed" or not allowance.stated or asked:
        return "surroundings", (felt, *_kept(scene, effects, allowance))
    if _may_drop(scene, effects) and allowance.permits(effects.field_felt):
        reason = "beside the mechanical loads the field is within the accuracy: nothing around the shell is meshed"
        return "none", (Decision("ambient", "none", reason, felt.number, felt.measure, felt.threshold),)
    if _may_be_given(scene) and allowance.permits(effects.perturbation):
        reason = "what the shell does to the applied field is within the accuracy: nothing around it is meshed"
        return "given", (felt, _given(reason, effects, allowance))
    tight = not scene.shell.shape.closed or (effects.loading.tension or 0.0) > 0.0
    if _may_be_inside(scene) and tight and allowance.permits(effects.surroundings):
        return "inside", (felt, _inside("", effects, allowance))
    return "surroundings", (felt, *_kept(scene, effects, allowance))


def _felt(effects: Effects, allowance: Allowance) -> Decision:
    load = f"its load is {effects.loading.pull:.2g}, the mechanical one {effects.loading.mechanical:.2g} (p R / mu T)"
    return Decision(
        "field felt", "yes", load, effects.field_felt, "effect of the field on the answer", allowance.threshold
    )


def _given(reason: str, effects: Effects, allowance: Allowance) -> Decision:
    number, measure = effects.perturbation, "effect of the shell's change of the field on the answer"
    return _numbered("the applied field alone", reason, number, measure, allowance)


def _inside(pinned: str, effects: Effects, allowance: Allowance) -> Decision:
    reason = f"{pinned}electrodes on both faces: what lies around them is left out"
    number, measure = effects.surroundings, "effect of the field around them on the answer"
    return _numbered("between the electrodes alone", reason, number, measure, allowance)


def _numbered(choice: str, reason: str, number: float | None, measure: str, allowance: Allowance) -> Decision:
    if number is None:
        return Decision("field", choice, reason)
    return Decision("field", choice, reason, number, measure, allowance.threshold)


def _kept(scene: Scene, effects: Effects, allowance: Allowance) -> tuple[Decision, ...]:
    """What might have been left out and is not: the space around the shell, the shell's change of an applied field."""
    pinned = "pinned by the scene; " if scene.model.surroundings == "meshed" else ""
    numbers = [
        (effects.perturbation if _may_be_given(scene) else None, "the shell changes the field"),
        (effects.surroundings if _may_be_inside(scene) else None, "there is a field around the electrodes"),
    ]
    found = [(number, why) for number, why in numbers if number is not None]
    if not found:
        return (Decision("field", "all around the shell", f"{pinned}the shell makes or changes the field around it"),)
    number, why = found[0]
    measure = f"effect of leaving it out on the answer; {allowance.says(number, kept=True)}"
    return (Decision("field", "all around the shell", pinned + why, number, measure, allowance.threshold),)


def _may_drop(scene: Scene, effects: Effects) -> bool:
    """May the field be dropped? Not where it carries the scene alone, or the scene says how it is coupled."""
    return effects.loading.mechanical > 0.0 and scene.model.coupling == "auto"


def _may_be_given(scene: Scene) -> bool:
    """Is there an applied field around a shell that is no conductor, with nothing else beside it?"""
    ambient = scene.ambient
    if ambient is None or scene.faces.electrodes or ambient.bodies or scene.model.coupling != "auto":
        return False
    empty = ambient.contrast == 1.0 and ambient.inside_contrast == 1.0 and ambient.outer == "free-space"
    return applied(scene) and empty


def _may_be_inside(scene: Scene) -> bool:
    """Would a scene whose ``surroundings`` are left out be a scene?"""
    ambient, faces = scene.ambient, scene.faces
    if ambient is None or ambient.field == "magnetic" or applied(scene) or ambient.bodies or one_conductor(scene):
        return False
    both = faces.top is not None and faces.bottom is not None
    return both and scene.shell.relative_permittivity is not None and scene.model.coupling in ("auto", "joint")


def describe_potential(scene: Scene) -> tuple[Decision, ...]:
    """How the potential is written, and that the field moves with the shell."""
    if one_conductor(scene):
        jump = Decision("potential", "continuous", "the shell is one conductor: no jump to solve for")
    else:
        jump = Decision("potential", "with a jump", "the faces may differ: the jump is an unknown on the shell")
    moving = Decision("space", "moves with the shell", "the field is solved on the deformed ambient")
    return moving, jump


def choose_interface(
    scene: Scene, rim_size: float | None, effects: Effects, allowance: Allowance
) -> tuple[tuple[str, ...], Decision]:
    """The faces placed at their true positions; ``rim_size`` is the element size along the rims, in shell sizes, None
    without rims."""
    faces, choice, reason = _faces(scene, rim_size, effects, allowance)
    number, measure = effects.closed_faces, "effect of closed faces on the answer"
    return faces, Decision("interface", choice, reason, number, measure, allowance.threshold)


def _faces(
    scene: Scene, rim_size: float | None, effects: Effects, allowance: Allowance
) -> tuple[tuple[str, ...], str, str]:
    stated = scene.model.interface
    if stated == "closed":
        return (), "closed", "pinned by the scene"
    number = effects.closed_faces
    if stated == "auto" and allowance.permits(number):
        return (), "closed", "the true places of the faces are within the accuracy"
    if stated == "auto" and cramped(scene, rim_size):
        reason = f"elements at the rim are smaller than {ROOM:g} thicknesses, and an opened face would turn them over"
        return (), "closed", reason
    pinned = "pinned by the scene; " if stated == "opened" else ""
    reason = f"{pinned}faces at their true places: second order in the thickness"
    if rim_size is not None:
        return ("t", "b"), "opened", f"{reason}; they meet in the rim, one element away from it"
    empty = scene.ambient is None or not scene.ambient.bodies
    if stated == "auto" and one_conductor(scene) and empty:
        reason += "; the bottom face bounds a space without a field, where its place is not felt"
        return ("t",), "opened at the top", reason
    return ("t", "b"), "opened", reason


def cramped(scene: Scene, rim_size: float | None) -> bool:
    """Have the elements along the rims no room for an opened face?"""
    ratio = scene.shell.thickest / scene.shell.shape.size
    return rim_size is not None and rim_size < ROOM * ratio and one_conductor(scene)
