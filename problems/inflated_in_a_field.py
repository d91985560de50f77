"""A permeable balloon inflated to four times its radius in a magnetic field: how far the space around it follows.

Physics: the balloon thins out sixteenfold and grows from an eighth to half of the meshed space, which is squeezed
outside and blown up inside. The field is weak: the balloon stays round, and its pressure is that of the exact thin
balloon; its moment is that of a permeable shell of the new radius and thickness.

Reference: p = 2 T s / (l^2 R) with the stress s = 2 (l^2 - l^-4) (c1 + l^2 c2) of an equibiaxial incompressible sheet
(R. W. Ogden, Non-Linear Elastic Deformations (1984), sec. 5.3.2). The smallest det F of the mesh's motion is recorded
as ``min_jacobian``; the guard stops at 0.02.

Run: about fifteen seconds.
"""

from __future__ import annotations

from pathlib import Path

from embedding import MooneyRivlin, Scene, Solution, load_scene, solve
from problems.common import print_files, print_steps, thickness_ratio

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"ambient.radius=200 mm"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive)


def pressure(scene: Scene, stretch: float) -> float:
    """Inflating pressure in Pa of the thin balloon without a field; ValueError for another material."""
    material = scene.shell.material
    if not isinstance(material, MooneyRivlin):
        raise ValueError("the reference is a Mooney-Rivlin balloon")
    stress = 2.0 * (stretch**2 - stretch**-4) * (material.c1 + stretch**2 * material.c2)
    return 2.0 * thickness_ratio(scene) * stress / stretch**3


if __name__ == "__main__":
    solution = run(archive=Path("inflated_in_a_field.vtkhdf"))
    print_steps({name: solution[name] for name in ("stretch", "pressure_difference", "min_jacobian")})
    found, known = solution["pressure_difference"][-1], pressure(solution.scene, solution["stretch"][-1])
    print(f"pressure at the end, from the balloon without a field: {found / known - 1.0:+.1e}")
    print_files(solution)
