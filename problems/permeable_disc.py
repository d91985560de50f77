"""A clamped permeable disc that bends towards a magnet: a membrane of iron-filled silicone in a field gradient.

Physics: the disc is drawn to the stronger field, bends towards it and finds it stronger still. Beyond a remanence of
about half a tesla no equilibrium is near: the disc snaps to the magnet.

Reference: there is no closed form; what must hold does not depend on one. Forces in free space are internal: the force
on the disc, from the tractions on its two faces, is minus that on the magnet, from the stress on a surface around it.
A staggered solution ends where the joint one does.

Run: about a minute.
"""

from __future__ import annotations

from pathlib import Path

from embedding import Scene, Solution, load_scene, solve
from problems.common import print_files, print_steps

SCENE = Path(__file__).with_suffix(".toml")
FINE = ("discretisation.order=4", "discretisation.shell_size=2 mm", "ambient.radius=160 mm")
"""Overrides: a finer mesh, and an outer boundary so far away that the magnet is a dipole there."""


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permeability=2"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive)


def imbalance(solution: Solution) -> float:
    """Force on the disc and the magnet together, over that on the disc, at the last step."""
    return float((solution["force_z"][-1] + solution["force_body0_z"][-1]) / solution["force_z"][-1])


if __name__ == "__main__":
    solution = run(archive=Path("permeable_disc.vtkhdf"))
    print_steps({name: solution[name] for name in ("displacement", "force_z", "force_body0_z", "min_jacobian")})
    print(f"force on disc and magnet together, over that on the disc: {imbalance(solution):+.1e}")
    print(f"on a finer mesh: {imbalance(run(*FINE)):+.1e}")
    staggered = run("model.coupling=staggered")
    gap = staggered["displacement"][-1] / solution["displacement"][-1] - 1.0
    iterations = int(staggered["coupling_iterations"].sum())
    print(f"staggered: {iterations} coupling iterations, joint: {solution.iterations} Newton; apart by {gap:+.1e}")
    print_files(solution)
