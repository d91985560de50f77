"""A plate under a dead edge traction, against uniaxial tension.

Physics: the stretch l along the pull and l^-1/2 across it and through the thickness are the same everywhere, so that
the shell, a membrane, is exact here: t / T = mu (l - l^-2) for a neo-Hookean plate, with t per reference edge length.

Reference: `problems.exact.plate.traction` (Treloar, The Physics of Rubber Elasticity, ch. 5); the agreement is to
rounding, on any mesh.

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
    """The scene file with overrides such as ``"path.0.steps=40"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def pull(solution: Solution) -> Array:
    """Nominal stress t / T of every step, in units of the shear modulus."""
    shell = solution.scene.shell
    full = solution.scene.loads.edge_tractions[0].traction[0]
    factors = np.array([step.factor_mechanical for step in solution.steps])
    return factors * (full / (shell.thickness * shell.material.shear_modulus))


def reference(solution: Solution) -> Array:
    """Exact nominal stress, in shear moduli, at the computed longitudinal stretches."""
    law = law_of(solution.scene)
    return np.array([plate.traction(float(x), law) / law.shear_modulus for x in solution["stretch_max"]])


def error(solution: Solution) -> float:
    """Largest difference of the two over the steps, in shear moduli."""
    return float(np.abs(pull(solution) - reference(solution)).max())


if __name__ == "__main__":
    solution = run(archive=Path("plate_traction.vtkhdf"))
    print_steps({"stretch": solution["stretch_max"], "t/(mu T)": pull(solution), "exact": reference(solution)})
    print(f"largest error of t/(mu T): {error(solution):.1e}")
    print_files(solution)
