"""What of the field is modelled, where the faces lie in it, and how its potential is written."""

from __future__ import annotations

from embedding.plan.decisions import Decision, Extent
from embedding.scene import Scene
from embedding.scene.checks_electrodes import inside_only, one_conductor

CLOSED_FACES = 1.6
"""A field on faces at the mid-surface is off by this many thicknesses over size; measured on exact thick spheres."""
ROOM = 2.5
"""Elements along a rim, in thicknesses, that can hold faces opened to the full thickness one element away from it."""


def choose_extent(scene: Scene) -> tuple[Extent, tuple[Decision, ...]]:
    """The least of the field that carries the scene: that around the shell, that inside it, or the given one alone."""
    if scene.ambient is None:
        return "none", (Decision("ambient", "none", "the scene has no field: nothing around the shell is meshed"),)
    if scene.model.coupling == "unperturbed":
        reason = "pinned by the scene; the shell is taken not to change the applied field: nothing around it is meshed"
        return "given", (Decision("field", "the applied field alone", reason),)
    if inside_only(scene):
        share = scene.shell.thickest / scene.shell.shape.size
        reason = f"electrodes on both faces: what lies around is about {share:.1e} of it and left out"
        pinned = "pinned by the scene; " if scene.model.surroundings == "none" else ""
        return "inside", (Decision("field", "between the electrodes alone", pinned + reason),)
    return "surroundings", ()


def describe_potential(scene: Scene) -> tuple[Decision, ...]:
    """How the potential is written, and that the field moves with the shell."""
    if one_conductor(scene):
        jump = Decision("potential", "continuous", "the shell is one conductor: no jump to solve for")
    else:
        jump = Decision("potential", "with a jump", "the faces may differ: the jump is an unknown on the shell")
    moving = Decision("field", "moves with the shell", "joint Newton of shell and field on the moved ambient")
    return moving, jump


def choose_interface(scene: Scene, rim_size: float | None) -> tuple[tuple[str, ...], Decision]:
    """The faces placed at their true positions; ``rim_size`` is the element size along the rims, in shell sizes, None
    without rims."""
    ratio = scene.shell.thickest / scene.shell.shape.size
    off = f"first order in the thickness, about {CLOSED_FACES * ratio:.1e} of the field's load"
    if scene.model.interface == "closed":
        return (), Decision("interface", "closed", f"pinned by the scene; {off}")
    cramped = rim_size is not None and rim_size < ROOM * ratio
    if scene.model.interface == "auto" and cramped and one_conductor(scene):
        reason = f"elements at the rim are smaller than {ROOM:g} thicknesses, and an opened face would turn them over"
        return (), Decision("interface", "closed", f"{reason}; {off}")
    reason = "faces at their true places: second order in the thickness"
    if rim_size is not None:
        return ("t", "b"), Decision("interface", "opened", f"{reason}; they meet in the rim, one element away from it")
    empty = scene.ambient is None or not scene.ambient.bodies
    if scene.model.interface == "auto" and one_conductor(scene) and empty:
        reason += "; the bottom face bounds a space without a field, where its place is not felt"
        return ("t",), Decision("interface", "opened at the top", reason)
    return ("t", "b"), Decision("interface", "opened", reason)
