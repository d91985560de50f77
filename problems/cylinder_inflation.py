"""Inflation of an infinite tube in plane strain, against the exact thick-walled tube.

Physics: the hoop stretch l of the mid-surface follows from p_b - p_t alone, mu (T/R) (1 - l^-4) for the membrane. It
rises without a limit point, and p_t by itself does nothing; a printed formula for this problem says otherwise on both.

Reference: `problems.exact.cylinder.thick_stretch`, the exact incompressible tube of finite thickness (Haughton and
Ogden 1979). The error of the shell theory is O((T/R)^2).

Run: less than a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import InfiniteCylinder, Listener, Scene, Solution, load_scene, solve
from problems.common import Array, law_of, print_files, print_steps, thickness_ratio
from problems.exact import cylinder

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"loads.pressure_top=0"``."""
    return load_scene(SCENE, changes)


def at_thickness(ratio: float) -> tuple[str, ...]:
    """Overrides for another T/R, with (p_b - p_t) R / (mu T) kept at 0.8: the stretch tends to a limit."""
    stated = scene()
    inside = 30e3 + 0.8 * stated.shell.material.shear_modulus * ratio
    return (f"shell.thickness={ratio * stated.shell.shape.size!r}", f"loads.pressure_bottom={inside!r}")


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def reference(solution: Solution) -> Array:
    """Exact hoop stretch of the mid-surface at the pressure difference of every step.

    Raises ValueError for a shape other than an infinite cylinder.
    """
    stated = solution.scene
    shape, ratio, law = stated.shell.shape, thickness_ratio(stated), law_of(stated)
    if not isinstance(shape, InfiniteCylinder):
        raise ValueError("the reference is an infinite cylinder")
    pressures = solution["pressure_difference"]
    return np.array([cylinder.thick_stretch(float(p), ratio, law, shape.axial_stretch) for p in pressures])


def error(solution: Solution) -> float:
    """Largest error of the stretch over the steps."""
    return float(np.abs(solution["stretch"] - reference(solution)).max())


if __name__ == "__main__":
    solution = run(archive=Path("cylinder_inflation.vtkhdf"))
    pressures = solution["pressure_difference"]
    print_steps({"p_b - p_t / Pa": pressures, "stretch": solution["stretch"], "exact": reference(solution)})
    print(f"largest error of the stretch: {error(solution):.1e}")
    for ratio in (0.1, 0.05, 0.01):
        print(f"T/R = {ratio:<4}: {error(run(*at_thickness(ratio))):.2e}")
    print_files(solution)
