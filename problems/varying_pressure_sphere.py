"""A closed sphere whose face pressures vary along it, against a thick three-dimensional solid.

Physics: p_b - p_t = mu T/R inflates the sphere, and (p_t + p_b) / 2 = 0.3 mu (z/R)^2 on both faces squeezes the wall
more at the poles than at the equator: to first order in T the shell feels the gradient of that mean pressure.

Reference: `tests.solids.thick`, an incompressible neo-Hookean solid loaded on its true faces, solved by mixed finite
elements of high order. The consistent load ("embedding-aware") reaches it with an error O((T/R)^2); the net pressure
on the mid-surface and the load as first published do not reach it at any thickness.

Run: some seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, PressureField, Scene, Solution, load_scene, solve
from problems.common import Array, Positions, print_files, thickness_ratio
from tests.solids import Loading, MidSurface, Profile, constant
from tests.solids.thick import thick_sphere

SCENE = Path(__file__).with_suffix(".toml")


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"loads.variant=net"``."""
    return load_scene(SCENE, changes)


def at_thickness(ratio: float) -> tuple[str, ...]:
    """Overrides for another T/R, with (p_b - p_t) R / (mu T) kept at 1: the deformation tends to a limit."""
    stated = scene()
    half = 50.0 * ratio  # kPa
    return (
        f"shell.thickness={ratio * stated.shell.shape.size!r}",
        f"loads.pressure_top.expression=30*(z/0.02)**2 - {half!r}",
        f"loads.pressure_bottom.expression=30*(z/0.02)**2 + {half!r}",
    )


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def mid_surface(scene: Scene, positions: Positions) -> MidSurface:
    """The computed mid-surface in units of R, as upper half of a meridian: angles in increasing order."""
    start, now = positions.reference / scene.shell.shape.size, positions.deformed / scene.shell.shape.size
    distance = np.hypot(start[:, 0], start[:, 1])
    radial = (start[:, 0] * now[:, 0] + start[:, 1] * now[:, 1]) / distance
    upwards = np.sign(start[:, 2])
    theta = np.arctan2(distance, np.abs(start[:, 2]))
    order = np.argsort(theta)
    return MidSurface(theta[order], radial[order], (upwards * now[:, 2])[order])


def loading(scene: Scene) -> Loading:
    """The face pressures over cos(theta), in shear moduli."""
    size, modulus = scene.shell.shape.size, scene.shell.material.shear_modulus

    def profile(pressure: float | PressureField) -> Profile:
        if not isinstance(pressure, PressureField):
            return constant(pressure / modulus)
        return lambda c: pressure(0.0, 0.0, size * c) / modulus

    return Loading(profile(scene.loads.pressure_top), profile(scene.loads.pressure_bottom))


def reference(scene: Scene, angles: Array) -> MidSurface:
    """Mid-surface of the thick solid at polar ``angles`` of the reference, in units of R."""
    return thick_sphere(thickness_ratio(scene), *loading(scene), angles=angles)


def error(*changes: str) -> float:
    """Largest distance of the shell's points from those of the solid, in units of R."""
    positions = Positions()
    solved = run(*changes, listeners=[positions])
    surface = mid_surface(solved.scene, positions)
    return surface.distance(reference(solved.scene, surface.theta))


if __name__ == "__main__":
    print("largest distance of the mid-surface from the solid's, in units of R")
    for variant in ("embedding-aware", "net", "as-published"):
        errors = [error(*at_thickness(ratio), f"loads.variant={variant}") for ratio in (0.1, 0.05, 0.025)]
        print(f"{variant:>16}: " + ", ".join(f"{value:.2e}" for value in errors) + " at T/R = 0.1, 0.05, 0.025")
    print_files(run(archive=Path("varying_pressure_sphere.vtkhdf")))
