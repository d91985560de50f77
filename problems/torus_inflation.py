"""A rubber torus blown up far, against linear membrane theory at the start and the balance of energy on the way.

Physics: the membrane forces of a torus follow from equilibrium alone, N_1 = p a (r + R) / 2r around the tube and
N_2 = p a / 2 along it, r the distance from the axis. Their complementary energy gives the first pressure. Later the
energy stored must be the work of the pressure, int p dV.

Reference: W. Fluegge, Stresses in Shells (1960), chapter 2; conservation of energy.

Run: about a second.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

from embedding import Scene, Solution, Torus, load_scene, solve
from problems.common import Array, law_of, print_files, print_steps

SCENE = Path(__file__).with_suffix(".toml")


def run(*changes: str, archive: Path | None = None) -> Solution:
    """Solve the scene with overrides."""
    return solve(load_scene(SCENE, changes), archive=archive)


def radii(scene: Scene) -> tuple[float, float]:
    """R of the centre line and a of the tube, in m."""
    shape = scene.shell.shape
    if not isinstance(shape, Torus):
        raise ValueError(f"a {shape.kind} is no torus")
    return shape.radius, shape.tube_radius


def volume(scene: Scene) -> float:
    """Enclosed at rest, in m^3."""
    radius, tube = radii(scene)
    return 2.0 * math.pi**2 * radius * tube**2


def linear_pressure(scene: Scene, ratio: float) -> float:
    """Pressure in Pa at a volume ratio close to 1: 2 U = p dV, with E = 3 mu and Poisson's ratio 1/2."""
    radius, tube = radii(scene)
    angles = 2.0 * math.pi * (np.arange(200) + 0.5) / 200
    r = radius + tube * np.cos(angles)
    around, along = 0.5 * tube * (r + radius) / r, 0.5 * tube
    stiffness = 3.0 * law_of(scene).shear_modulus * scene.shell.thickest
    density = (around**2 + along**2 - around * along) / stiffness
    compliance = float((density * 2.0 * math.pi * r).mean() * 2.0 * math.pi * tube)
    return (ratio - 1.0) * volume(scene) / compliance


def work(solution: Solution) -> Array:
    """int p dV up to every step, in J, by a spline of order five through rest and the steps."""
    volumes = np.append(1.0, solution["volume_ratio"]) * volume(solution.scene)
    curve = make_interp_spline(volumes, np.append(0.0, solution["pressure_difference"]), k=5)
    return np.array([float(curve.integrate(volumes[0], v)) for v in volumes[1:]])


if __name__ == "__main__":
    solution = run(archive=Path("torus_inflation.vtkhdf"))
    energies, works = solution["elastic_energy"], work(solution)
    print_steps({"volume ratio": solution["volume_ratio"], "energy in J": energies, "work in J": works})
    print(f"largest relative difference: {np.abs(energies / works - 1).max():.1e}")
    first, linear = solution["pressure_difference"][3], linear_pressure(solution.scene, solution["volume_ratio"][3])
    print(f"first pressure {first:.6g} Pa, by linear theory {linear:.6g} Pa")
    print_files(solution)
