"""Which theory of the shell carries a scene: a membrane, or a shell that resists bending."""

from __future__ import annotations

from embedding.plan.allowance import Allowance
from embedding.plan.decisions import Decision
from embedding.plan.effects import Effects
from embedding.scene import Scene
from embedding.scene.checks_loads import needs_bending

LOCKS = 0.04
"""Thickness over size from which on plain strains of order 3 lock by a per cent at most, on meshes of the default
size."""


def choose_theory(scene: Scene, effects: Effects, allowance: Allowance) -> Decision:
    """The membrane, unless the scene pins bending, loads or holds what only bending can carry, or has a law of small
    strains, whose shells turn more than they stretch. With a stated accuracy, whichever carries the scene within it, as
    far as the tension is known."""
    number, measure = effects.bending, "effect of bending on the answer"
    ratio = scene.shell.thickest / scene.shell.shape.size
    wants = needs_bending(scene)
    if scene.model.theory != "auto":
        choice, why = scene.model.theory, "pinned by the scene"
    elif wants:
        choice, why = "bending", f"{wants[0].path} needs it"
    elif not allowance.stated or number is None:
        choice = "membrane" if _stretches(scene) else "bending"
        bends = "a material of small strains bends more than it stretches"
        why = bends if choice == "bending" else "a rubber is stretched more than it is bent"
    elif allowance.permits(number):
        choice, why = "membrane", f"bending is {allowance.says(number)}"
    else:
        choice, why = "bending", f"bending left out is {allowance.says(number, kept=True)}"
    tension = effects.bending_number
    told = f"; bending stiffness over tension {tension:.2g}" if tension is not None else "; its tension is not known"
    reason = f"{why}; thickness over size {ratio:.3g}{told}"
    if number is None:
        return Decision("shell theory", choice, reason)
    return Decision("shell theory", choice, reason, number, measure, allowance.threshold)


def judge_thinness(scene: Scene, effects: Effects, allowance: Allowance, *, bending: bool) -> Decision:
    """How good a theory of thin shells is for the scene: nothing in this package is better."""
    number = effects.thin_shell(bending=bending)
    small = number <= allowance.threshold
    choice = "thin" if small else "thick"
    reason = "shell theory carries it" if small else "shell theory itself is not better: where it must be, use a solid"
    return Decision("thin shell", choice, reason, number, "error of the theory in the answer", allowance.threshold)


def choose_locking(scene: Scene) -> Decision:
    """Interpolated strains, unless the scene says otherwise or a rubber is too thick for locking to matter."""
    ratio = scene.shell.thickest / scene.shell.shape.size
    measure = "thickness over size"
    if scene.discretisation.locking != "auto":
        return Decision("membrane locking", scene.discretisation.locking, "pinned by the scene", ratio, measure, LOCKS)
    if _stretches(scene) and ratio > LOCKS:
        reason = f"a rubber of thickness over size above {LOCKS:g} is stretched more than it is bent"
        return Decision("membrane locking", "as it is", reason, ratio, measure, LOCKS)
    reason = "strains are interpolated: a thin shell bends without stretching"
    return Decision("membrane locking", "cured", reason, ratio, measure, LOCKS)


def _stretches(scene: Scene) -> bool:
    """Are all materials rubbers, which are stretched rather than bent?"""
    return all(material.incompressible for material in scene.shell.materials)
