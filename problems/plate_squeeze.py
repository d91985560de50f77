"""A plate squeezed by the same pressure on both faces, against the homogeneous three-dimensional solution.

Physics: p_t = p_b = p, the rim is free. The plate thins to l^-2 and spreads to the in-plane stretches (l, l): the net
pressure is zero and the mean pressure alone acts, through the shell's free rim. p = mu (l^2 - l^-4) for neo-Hooke.

Reference: `problems.exact.plate.squeeze`; the agreement is to rounding, on any mesh.

Run: less than a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.common import Array, law_of, print_files, print_steps
from problems.exact import plate

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"loads.rim=pressurised"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def squeeze(solution: Solution) -> Array:
    """Mean of the two face pressures at every step, in units of the shear modulus."""
    top, bottom = solution.pressures
    return np.asarray((top + bottom) / (2.0 * solution.scene.shell.material.shear_modulus))


def reference(solution: Solution) -> Array:
    """Exact pressure on both faces, in shear moduli, at the computed in-plane stretches."""
    law = law_of(solution.scene)
    return np.array([plate.squeeze(float(x), law) / law.shear_modulus for x in solution["stretch"]])


def error(solution: Solution) -> float:
    """Largest difference of the two over the steps, in shear moduli."""
    return float(np.abs(squeeze(solution) - reference(solution)).max())


if __name__ == "__main__":
    solution = run(archive=Path("plate_squeeze.vtkhdf"))
    print_steps({"stretch": solution["stretch"], "p/mu": squeeze(solution), "exact": reference(solution)})
    print(f"largest error of p/mu: {error(solution):.1e}")
    print_files(solution)
