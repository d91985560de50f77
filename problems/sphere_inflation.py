"""Inflation of a spherical balloon over its limit point, against membrane theory and the exact thick-walled sphere.

Physics: the membrane's pressure is 2 mu (T/R) (l^-1 - l^-7). It has its maximum at l = 7^(1/6); a Mooney-Rivlin
balloon may have a minimum behind it and then stiffens. Only volume control follows the falling part.

Reference: `problems.exact.sphere`, membrane (Green and Adkins) and exact sphere of finite thickness (Haughton and
Ogden 1978). The finite element solution differs from the membrane by its discretisation alone, and from the thick
sphere by O((T/R)^2).

Run: about a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.interpolate import PPoly, make_interp_spline

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.common import Array, law_of, print_files, print_steps, thickness_ratio
from problems.exact import sphere
from problems.exact.sphere import LimitPoint, Theory

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"model.reduction=3d"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def pressures(solution: Solution) -> Array:
    """(p_b - p_t) R / (mu T) of every step."""
    scale = solution.scene.shell.material.shear_modulus * thickness_ratio(solution.scene)
    return np.asarray(solution["pressure_difference"] / scale)


def reference(solution: Solution, theory: Theory = "membrane") -> Array:
    """The same, exact at the computed stretches."""
    ratio, law = thickness_ratio(solution.scene), law_of(solution.scene)
    curve, _ = sphere.PRESSURES[theory]
    return np.array([curve(float(x), ratio, law) for x in solution["stretch"]]) / (law.shear_modulus * ratio)


def error(solution: Solution, theory: Theory = "membrane") -> float:
    """Largest error of (p_b - p_t) R / (mu T) over the steps."""
    return float(np.abs(pressures(solution) - reference(solution, theory)).max())


def limit_points(solution: Solution) -> tuple[LimitPoint, ...]:
    """Extrema of the pressure along the path, as (stretch, (p_b - p_t) R / (mu T)).

    At the steps of the scene file the maximum is located to 1e-7 in the stretch; a minimum further out, where the
    steps are wider, to 5e-6; the load at either to 1e-8.
    """
    return extrema(solution["stretch"], pressures(solution))


def extrema(stretches: Array, loads: Array) -> tuple[LimitPoint, ...]:
    """Extrema of the spline of order five through points with increasing stretch."""
    curve = make_interp_spline(stretches, loads, k=5)
    slope = curve.derivative()
    roots = PPoly.from_spline((slope.t, slope.c, slope.k)).roots(extrapolate=False)
    return tuple(LimitPoint(float(root), float(curve(root))) for root in roots)


def reference_limit_points(scene: Scene, theory: Theory = "membrane") -> tuple[LimitPoint, ...]:
    """The same, exact."""
    ratio, law = thickness_ratio(scene), law_of(scene)
    points = sphere.limit_points(ratio, law, theory, largest_stretch=5.0)
    return tuple(LimitPoint(stretch, load / (law.shear_modulus * ratio)) for stretch, load in points)


if __name__ == "__main__":
    solution = run(archive=Path("sphere_inflation.vtkhdf"))
    print_steps({"stretch": solution["stretch"], "p R/(mu T)": pressures(solution), "exact": reference(solution)})
    print(f"largest error of p R/(mu T): {error(solution):.1e}")
    for found, known in zip(limit_points(solution), reference_limit_points(solution.scene), strict=True):
        print(f"limit point: stretch {found.stretch:.8f} (exact {known.stretch:.8f}),", end=" ")
        print(f"p R/(mu T) {found.load:.8f} (exact {known.load:.8f})")
    print_files(solution)
