"""A hard-magnetic ring whose remanence alternates along it, bent into a clover by a uniform field.

Physics: in a field that the shell does not change, a remanence is a dead load. Per length along the ring the energy is
-T B_r . H with B_r = b (t + du/ds), t the tangent and b(a) = b cos(n a) its pattern, so by parts the force on the ring
is -T b'(s) H = (n T b H / R) sin(n a) e_x, exactly and whatever the deflection.

Reference: small deflections of an inextensible ring with the stiffness D = mu T^3 / 3 of plane strain. Its mode
u_r = W sin(m a), u_a = (W/m) cos(m a) under the forces f_r = p sin(m a), f_a = q cos(m a) has

    D (m^2 - 1)^2 / R^4 W = p + q/m

(S. Timoshenko, J. Gere, Theory of Elastic Stability (1961), sec. 7.1). The force above has f0 = n T b H / R in the
modes m = n + 1 with p = q = f0 / 2 and m = n - 1 with p = -q = f0 / 2.

Run: about two seconds.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from embedding import NeoHookean, Scene, Solution, load_scene, solve
from problems.common import Positions, print_files

SCENE = Path(__file__).with_suffix(".toml")
REMANENCE, WAVES = 0.05, 3
"""Amplitude b in T and number n of waves of the pattern in the scene file."""
SMALL = "ambient.applied_field=[10.0, 0.0, 0.0]"
"""Override: a field in which the ring moves by a thousandth of its radius."""
FITTED = 7
"""Modes fitted to the deflection."""


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"ambient.applied_field=[2e3, 0, 0]"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, dict[int, float]]:
    """Solve the scene with overrides; the amplitudes W of sin(m a) in the radial deflection, in m, by m."""
    positions = Positions()
    solution = solve(scene(*changes), archive=archive, listeners=[positions])
    place, moved = positions.reference[:, :2], (positions.deformed - positions.reference)[:, :2]
    angle = np.arctan2(place[:, 1], place[:, 0])
    radial = np.einsum("ij,ij->i", moved, place) / np.hypot(*place.T)
    basis = [wave(m * angle) for m in range(FITTED) for wave in (np.sin, np.cos)]
    fitted = np.linalg.lstsq(np.column_stack(basis), radial, rcond=None)[0]
    return solution, {m: float(fitted[2 * m]) for m in range(1, FITTED)}


def exact(scene: Scene) -> dict[int, float]:
    """Small amplitudes W in m of the modes n - 1 and n + 1.

    Raises ValueError without a uniform field or a neo-Hookean ring.
    """
    shell, ambient = scene.shell, scene.ambient
    if ambient is None or not isinstance(shell.material, NeoHookean):
        raise ValueError("the reference is a neo-Hookean ring in a uniform field")
    radius, thickness = shell.shape.size, float(shell.thickest)
    stiffness = shell.material.shear_modulus * thickness**3 / 3.0
    force = WAVES * thickness * REMANENCE * math.hypot(*ambient.uniform_field) / radius

    def amplitude(m: int, sign: float) -> float:
        return 0.5 * force * (1.0 + sign / m) * radius**4 / (stiffness * (m**2 - 1.0) ** 2)

    return {WAVES - 1: amplitude(WAVES - 1, -1.0), WAVES + 1: amplitude(WAVES + 1, 1.0)}


if __name__ == "__main__":
    solution, found = run(archive=Path("hard_magnetic_ring.vtkhdf"))
    for ended, amplitudes in ((solution, found), run(SMALL)):
        for m, known in exact(ended.scene).items():
            print(f"mode {m}: {amplitudes[m]:.5e} m, small deflections {known:.5e} m: {amplitudes[m] / known - 1:+.1e}")
    print_files(solution)
