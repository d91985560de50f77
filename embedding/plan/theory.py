"""Which theory of the shell carries a scene: a membrane, or a shell that resists bending."""

from __future__ import annotations

from embedding.plan.decisions import Decision
from embedding.scene import Scene
from embedding.scene.checks_loads import needs_bending

LOCKS = 0.04
"""Thickness over size from which on plain strains of order 3 lock by a per cent at most, on meshes of the default
size."""


def choose_theory(scene: Scene) -> Decision:
    """The membrane, unless the scene pins bending, loads or holds what only bending can carry, or has a law of small
    strains, whose shells turn more than they stretch."""
    ratio = scene.shell.thickest / scene.shell.shape.size
    slender = f"thickness over size {ratio:.3g}"
    wants = needs_bending(scene)
    if scene.model.theory == "membrane" or (scene.model.theory == "auto" and not wants and _stretches(scene)):
        off = f"loads off by about {0.8 * ratio**2:.1e} of themselves"
        pinned = "pinned by the scene; " if scene.model.theory == "membrane" else ""
        return Decision("shell theory", "membrane", f"{pinned}{slender}: {off}; no bending stiffness")
    if scene.model.theory == "bending":
        why = "pinned by the scene"
    else:
        why = f"{wants[0].path} needs it" if wants else "a material of small strains bends more than it stretches"
    return Decision("shell theory", "bending", f"{why}; {slender}")


def choose_locking(scene: Scene) -> Decision:
    """Interpolated strains, unless the scene says otherwise or a rubber is too thick for locking to matter."""
    ratio = scene.shell.thickest / scene.shell.shape.size
    if scene.discretisation.locking != "auto":
        return Decision("membrane locking", scene.discretisation.locking, "pinned by the scene")
    if _stretches(scene) and ratio > LOCKS:
        reason = f"a rubber of thickness over size above {LOCKS:g} is stretched more than it is bent"
        return Decision("membrane locking", "as it is", reason)
    return Decision("membrane locking", "cured", "strains are interpolated: a thin shell bends without stretching")


def _stretches(scene: Scene) -> bool:
    """Are all materials rubbers, which are stretched rather than bent?"""
    return all(material.incompressible for material in scene.shell.materials)
