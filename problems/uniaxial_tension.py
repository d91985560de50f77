"""A sheet in uniaxial tension, against published Cauchy stresses of three laws up to three times its length.

Physics: homogeneous, with stretches l, l^-1/2 and l^-1/2, so that the shell, a membrane, is exact. Cauchy stress
sum mu_p (l^a_p - l^(-a_p/2)) by Ogden's law, which holds the other two.

Reference: Verhelst, Mantzaflaris, Moeller and den Besten, Comput. Aided Des. 139 (2021) 103075, after Ogden (1972): one
modulus of 1.5 MPa for all laws. The sheet is pulled by the published stresses, and its stretches must come out.

Run: about a second a law.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.common import Array, print_files, print_steps

SCENE = Path(__file__).with_suffix(".toml")
MATERIALS = {
    "neo-hookean": "{law = 'neo-hookean', shear_modulus = 1.5e6}",
    "mooney-rivlin": "{law = 'mooney-rivlin', c1 = 656250, c2 = 93750}",
    "ogden": "{law = 'ogden', moduli = [2236686.3905325443, 4260.355029585799, -35502.958579881655],"
    " exponents = [1.3, 5.0, -2.0]}",
}
STRETCHES = np.array([1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0])
PUBLISHED: dict[str, Array] = {
    "neo-hookean": np.array(
        [910000, 1868571.429, 2902500, 4026666.667, 5250000, 6578181.818, 8015000, 9563076.923, 11224285.71, 13000000]
    ),
    "mooney-rivlin": np.array(
        [
            891041.6667, 1801836.735, 2766445.313, 3802962.963, 4921875, 6129669.421, 7430572.917, 8827455.621,
            10322334.18, 11916666.67,
        ]
    ),
    "ogden": np.array(
        [
            874045.5944, 1719310.577, 2559013.833, 3408447.362, 4279680.111, 5183795.056, 6132092.999, 7136816.768,
            8211634.49, 9371993.939,
        ]
    ),
}  # fmt: skip
"""Cauchy stress in Pa at ``STRETCHES``, to ten digits."""


def scene(law: str, *changes: str) -> Scene:
    """The scene with one of the three laws, a stage for every published stress, and overrides."""
    nominal = PUBLISHED[law] / STRETCHES
    thickness, unit = 1e-3, 1e3  # m and N/m: the traction of the scene file
    stages = ", ".join(f"{{steps = 1, mechanical = {stress * thickness / unit!r}}}" for stress in map(float, nominal))
    return load_scene(SCENE, (f"shell.material={MATERIALS[law]}", f"path=[{stages}]", *changes))


def run(law: str, *changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with one of the three laws."""
    return solve(scene(law, *changes), archive=archive, listeners=listeners)


def stresses(solution: Solution) -> Array:
    """Cauchy stress of every step in Pa: the applied nominal stress times the stretch found."""
    shell = solution.scene.shell
    full = solution.scene.loads.edge_tractions[0].traction[0] / shell.thickness
    return np.array([full * step.factor_mechanical for step in solution.steps]) * solution["stretch_max"]


def error(solution: Solution, law: str) -> float:
    """Largest relative error of the Cauchy stress over the table."""
    return float(np.abs(stresses(solution) / PUBLISHED[law] - 1.0).max())


if __name__ == "__main__":
    for law in MATERIALS:
        solution = run(law, archive=Path("uniaxial_tension.vtkhdf"))
        print(law)
        columns = {"stretch": solution["stretch_max"], "stress [MPa]": stresses(solution) / 1e6}
        print_steps({**columns, "published": PUBLISHED[law] / 1e6})
        print(f"largest relative error of the stress: {error(solution, law):.1e}")
    print_files(solution)
