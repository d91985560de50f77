"""Solved scenes whose answers are known in closed form, small enough for tests."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from embedding import Scene, Solution, solve
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


LEVEL = 0.04
GROUND = """
name = "sphere over a conducting half-space"
[shell]
shape = {{ kind = "sphere", radius = "20 mm" }}
thickness = "0.5 mm"
material = {{ law = "neo-hookean", shear_modulus = "3 MPa" }}
[[supports]]
where = "surface"
fix = ["x", "y", "z"]
[ambient]
field = "electric"
bodies = [{{ kind = "half-space", level = "-40 mm", voltage = {ground} }}]
[faces]
both = {{ voltage = {shell} }}
[model]
theory = "bending"
[[path]]
steps = 2
"""


class OverGround(NamedTuple):
    """Capacitance, energy and force of a sphere over a plane."""

    capacitance: float
    energy: float
    force: float


def over_ground(folder: Path, shell: float, ground: float) -> Solution:
    """A sphere at a voltage over a half-space at another one, in "ground.vtkhdf"."""
    scene = Scene.from_toml(GROUND.format(shell=shell, ground=ground))
    return solve(scene, archive=folder / "ground.vtkhdf", progress=False)


def over_ground_exact(voltage: float) -> OverGround:
    """C = 4 pi eps a sinh(alpha) sum of 1 / sinh(n alpha), cosh(alpha) = h / a (Smythe)."""

    def capacitance(height: float) -> float:
        radius = 0.02025
        alpha = math.acosh(height / radius)
        return 4 * math.pi * EPSILON_0 * radius * math.sinh(alpha) * sum(1 / np.sinh(np.arange(1, 100) * alpha))

    value, step = capacitance(LEVEL), 1e-6
    slope = (capacitance(LEVEL + step) - capacitance(LEVEL - step)) / (2 * step)
    return OverGround(value, voltage**2 * value / 2, voltage**2 * slope / 2)


POLE = 100.0
POLES = """
name = "poles"
[shell]
shape = { kind = "sphere", radius = "20 mm" }
thickness = "1 mm"
relative_permeability = 1.0
material = { law = "neo-hookean", shear_modulus = "30 MPa" }
[ambient]
field = "magnetic"
outer = "grounded"
radius = "120 mm"
[[ambient.bodies]]
kind = "sphere"
centre = [0.0, 0.0, "60 mm"]
radius = "15 mm"
potential = "100 A"
[[ambient.bodies]]
kind = "sphere"
centre = [0.0, 0.0, "-60 mm"]
radius = "15 mm"
potential = "-100 A"
[model]
theory = "bending"
[[path]]
steps = 1
"""
