"""A conducting balloon at a voltage in free space, against the exact thick-walled sphere.

Physics: the field pulls each bit of the outer face outwards with eps0 E^2 / 2, E = V / b at the outer face radius b;
inside the conductor there is no field, so p_b = 0 and p_t = -eps0 (V / b)^2 / 2. The shell has no limit point.

Reference: `problems.exact.charged_balloon`, incompressible neo-Hookean sphere of finite thickness with the field at
its true outer face. With the interface opened the error of the stretch is O((T/R)^2), closed O(T/R).

Run: about a second.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt

from embedding import Listener, NeoHookean, Scene, Solution, Sphere, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.charged_shell import Theory
from problems.exact.material import Law, mooney_rivlin, neo_hookean

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"model.interface=closed"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, listeners: tuple[Listener, ...] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), listeners=listeners)


def exact(scene: Scene, theory: Theory = "thick") -> ChargedBalloon:
    """The exact shell of ``scene``, in SI units.

    Raises ValueError for a shape other than a sphere.
    """
    shape, ambient = scene.shell.shape, scene.ambient
    if not isinstance(shape, Sphere) or ambient is None:
        raise ValueError("the reference is a sphere in an electric field")
    ground = math.inf
    if ambient.outer == "grounded":
        ground = ambient.radius or 4.0 * shape.radius
    return ChargedBalloon(shape.radius, scene.shell.thickness, _law(scene), EPSILON_0, ground, theory)


def _law(scene: Scene) -> Law:
    material = scene.shell.material
    if isinstance(material, NeoHookean):
        return neo_hookean(material.shear_modulus)
    return mooney_rivlin(material.c1, material.c2)


def reference(solution: Solution, theory: Theory = "thick") -> npt.NDArray[np.float64]:
    """Exact stretch of the mid-surface at the voltage of every step of ``solution``."""
    shell = exact(solution.scene, theory)
    return np.array([shell.stretch(float(voltage)) for voltage in solution["voltage"]])


def error(solution: Solution, theory: Theory = "thick") -> float:
    """Largest error of the stretch over the steps of ``solution``."""
    return float(np.abs(solution["stretch"] - reference(solution, theory)).max())


if __name__ == "__main__":
    solution = run()
    print(f"{'voltage/kV':>10} {'stretch':>9} {'exact':>9} {'p_t/Pa':>9}")
    for voltage, stretch, known, p_t in zip(
        solution["voltage"], solution["stretch"], reference(solution), solution.pressures[0], strict=True
    ):
        print(f"{voltage / 1e3:10.0f} {stretch:9.5f} {known:9.5f} {p_t:9.1f}")
    print(f"largest error of the stretch: {error(solution):.1e}")
