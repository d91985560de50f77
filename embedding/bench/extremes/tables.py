"""Scenes of the map in a line or two: tables as in a scene file, lengths in m and stresses in Pa."""

from __future__ import annotations

from typing import Any

from embedding.scene import Scene

Table = dict[str, Any]


def scene_of(name: str, shape: Table, thickness: float, material: Table, **parts: Any) -> Scene:
    """A scene from the tables of its shell and ``parts``. Raises SceneError."""
    return Scene.from_table(
        {"name": name, "shell": {"shape": shape, "thickness": thickness, "material": material}, **parts}
    )


def rubber(shear_modulus: float) -> Table:
    """Neo-Hookean."""
    return {"law": "neo-hookean", "shear_modulus": shear_modulus}


def metal(youngs_modulus: float, poisson_ratio: float) -> Table:
    """Of small strains."""
    return {"law": "st-venant-kirchhoff", "youngs_modulus": youngs_modulus, "poisson_ratio": poisson_ratio}


def clamped(*edges: str) -> list[Table]:
    """Supports that hold edges and their rotation."""
    return [{"where": edge, "kind": "clamped"} for edge in edges]


def by_load(steps: int) -> list[Table]:
    """A path of one stage in given steps of the load."""
    return [{"control": "load", "steps": steps}]
