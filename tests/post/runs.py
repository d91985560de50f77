"""Solved scenes whose answers are known in closed form, small enough for tests."""

from __future__ import annotations

import math
from pathlib import Path

from embedding import Scene, solve
from embedding.scene.scales import EPSILON_0

RADIUS, THICKNESS, VOLTAGE = 0.02, 0.001, 3e3
OUTER = RADIUS + THICKNESS / 2
CAPACITANCE = 4 * math.pi * EPSILON_0 * OUTER

SPHERE = f"""
name = "stiff charged sphere"
[shell]
thickness = {THICKNESS}
shape = {{ kind = "sphere", radius = {RADIUS} }}
material = {{ law = "neo-hookean", shear_modulus = "1 GPa" }}
[ambient]
field = "electric"
[faces]
both = {{ voltage = {VOLTAGE} }}
[[path]]
steps = 2
"""
"""It does not move to speak of: a conductor of radius ``OUTER``."""

SOFT = SPHERE.replace("1 GPa", "30 kPa").replace(f"voltage = {VOLTAGE}", "voltage = 450e3")


def sphere(folder: Path, size: float, text: str = SPHERE) -> Path:
    """The archive of the charged sphere with shell elements of ``size`` radii."""
    path = folder / f"sphere{size}.vtkhdf"
    scene = Scene.from_toml(f"{text}\n[discretisation]\nshell_size = {size * RADIUS}\n")
    solve(scene, archive=path, progress=False)
    return path
