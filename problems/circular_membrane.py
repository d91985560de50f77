"""A flat circular membrane, clamped and blown up from rest through its limit pressure, against exact membrane theory.

Physics: flat and unstressed, the sheet has no stiffness out of its plane at first; its pressure goes through a maximum
P = p A / (mu T) = 1.87917 (neo-Hooke) at an apex stretch of 2.196.

Reference: `problems.exact.circular_membrane` (Adkins and Rivlin 1952), to ten digits.

Run: less than a second.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from embedding import load_scene
from problems.common import Array, LoadPath, Reading, follow, law_of, print_files, print_steps, thickness_ratio
from problems.exact import circular_membrane

SCENE = Path(__file__).with_suffix(".toml")
RADIUS = 0.1
READINGS = {"apex": Reading((0.0, 0.0, 0.0), "z")}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


def pressures(path: LoadPath) -> Array:
    """P = p A / (mu T) of every step."""
    return path.factors * load(path)


def load(path: LoadPath) -> float:
    """P at the load factor 1."""
    scene = path.solution.scene
    pressure = scene.loads.pressure_bottom
    if not isinstance(pressure, float):
        raise ValueError("the pressure is a number in this scene")
    return pressure / (law_of(scene).shear_modulus * thickness_ratio(scene))


def reference(path: LoadPath) -> Array:
    """P, exact at the computed heights of the apex."""
    law = law_of(path.solution.scene)
    return np.array([circular_membrane.at_deflection(w / RADIUS, law).pressure for w in path.values["apex"]])


def limit_pressures(path: LoadPath) -> list[float]:
    """P at the limit points on the path."""
    return [load(path) * point.factor_mechanical for point in path.solution.critical_points if point.kind == "limit"]


if __name__ == "__main__":
    path = run(archive=Path("circular_membrane.vtkhdf"))
    found, known = pressures(path), reference(path)
    print_steps({"apex/A": path.values["apex"] / RADIUS, "p A/(mu T)": found, "exact": known})
    print(f"largest error of p A/(mu T): {np.abs(found - known).max():.1e}")
    exact = circular_membrane.limit_state(law_of(path.solution.scene))
    for limit in limit_pressures(path):
        print(f"limit pressure {limit:.10f}, exact {exact.pressure if exact else float('nan'):.10f}")
    print_files(path.solution)
