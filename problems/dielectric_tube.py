"""A dielectric elastomer tube at a voltage in plane strain, against the exact thick-walled dielectric tube.

Physics: the voltage squeezes the wall and the tube widens; held at its length, it needs ever more voltage, up to
T (mu/eps)^(1/2) times a number that the thick wall changes a little, and does not pull in.

Reference: `problems.exact.dielectric_tube`. The shell follows the thin tube, 1 - l^-4 = eps V^2 / (mu T^2), up to the
discretisation; the thick wall is O((T/R)^2) away.

Run: about two seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from embedding import InfiniteCylinder, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Array, law_of, print_files, print_steps, thickness_ratio
from problems.dielectric_balloon import voltage
from problems.exact.charged_shell import Theory
from problems.exact.dielectric_tube import DielectricTube

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.relative_permittivity=5"``."""
    return load_scene(SCENE, changes)


def at(ratio: float) -> tuple[str, ...]:
    """Overrides for another T/R at the same V / T."""
    stated = scene()
    factor = ratio / thickness_ratio(stated)
    across = factor * voltage(stated)
    return f"shell.thickness={factor * stated.shell.thickest!r}", f"faces.bottom.voltage={across!r}"


def run(*changes: str, archive: Path | None = None) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive)


def exact(scene: Scene, theory: Theory = "thick") -> DielectricTube:
    """The exact tube of ``scene``, in SI units; ValueError for another shape, or without a permittivity."""
    shape, permittivity = scene.shell.shape, scene.shell.relative_permittivity
    if not isinstance(shape, InfiniteCylinder) or permittivity is None:
        raise ValueError("the reference is a dielectric tube")
    wall = permittivity * EPSILON_0
    return DielectricTube(shape.radius, scene.shell.thickest, law_of(scene), wall, EPSILON_0, theory=theory)


def reference(solution: Solution, theory: Theory = "thick") -> Array:
    """Exact stretch of the mid-surface at the voltage of every step."""
    tube, full = exact(solution.scene, theory), voltage(solution.scene)
    return np.array([tube.stretch(full * step.factor_field) for step in solution.steps])


def error(solution: Solution, theory: Theory = "thick") -> float:
    """Largest error of the stretch over the steps."""
    return float(np.abs(solution["stretch"] - reference(solution, theory)).max())


if __name__ == "__main__":
    solution = run(archive=Path("dielectric_tube.vtkhdf"))
    kilovolts = np.array([voltage(solution.scene) * step.factor_field / 1e3 for step in solution.steps])
    print_steps({"voltage / kV": kilovolts, "stretch": solution["stretch"], "exact": reference(solution)})
    for ratio in (0.1, 0.05, 0.025):
        found = run(*at(ratio))
        thick, thin = error(found), error(found, "membrane")
        print(f"T/R = {ratio:<5}: from the thick wall {thick:.1e}, from the thin one {thin:.1e}")
    print_files(solution)
