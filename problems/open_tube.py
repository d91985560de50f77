"""An open tube with traction-free ends under pressures on both faces, against the exact thick-walled tube.

Physics: p_b - p_t widens the tube; the mean pressure squeezes the wall and, as nothing holds the ends, lengthens it:
(p_t + p_b) / 2 = mu (axial^2 - thickness^2) for neo-Hooke. A net pressure on the mid-surface misses this altogether.

Reference: `problems.exact.open_tube.exact_stretches`, the incompressible tube of finite thickness with no resultant
force on its ends. The error of the shell theory is O((T/R)^2) in both stretches.

Run: less than a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.common import Array, law_of, print_files, print_steps, thickness_ratio
from problems.exact import open_tube as exact

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"loads.variant=net"``."""
    return load_scene(SCENE, changes)


def at_thickness(ratio: float) -> tuple[str, ...]:
    """Overrides for another T/R, with (p_b - p_t) R / (mu T) kept at 0.4: the stretches tend to a limit."""
    stated = scene()
    inside = 30e3 + 0.4 * stated.shell.material.shear_modulus * ratio
    return (f"shell.thickness={ratio * stated.shell.shape.size!r}", f"loads.pressure_bottom={inside!r}")


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def stretches(solution: Solution) -> Array:
    """(hoop, axial) stretch of every step."""
    return np.column_stack([solution["stretch"], solution["axial_stretch"]])


def reference(solution: Solution) -> Array:
    """Exact (hoop, axial) stretch of the mid-surface at the pressures of every step."""
    ratio, law = thickness_ratio(solution.scene), law_of(solution.scene)
    top, bottom = solution.pressures
    return np.array([exact.exact_stretches(float(b), float(t), ratio, law) for t, b in zip(top, bottom, strict=True)])


def error(solution: Solution) -> Array:
    """Largest errors of the hoop and of the axial stretch over the steps."""
    return np.asarray(np.abs(stretches(solution) - reference(solution)).max(axis=0))


if __name__ == "__main__":
    solution = run(archive=Path("open_tube.vtkhdf"))
    (hoop, axial), (exact_hoop, exact_axial) = stretches(solution).T, reference(solution).T
    print_steps({"hoop stretch": hoop, "exact hoop": exact_hoop, "axial stretch": axial, "exact axial": exact_axial})
    for ratio in (0.1, 0.05, 0.025):
        wrong = error(run(*at_thickness(ratio)))
        print(f"T/R = {ratio:<5}: errors {wrong[0]:.2e} (hoop), {wrong[1]:.2e} (axial)")
    print_files(solution)
