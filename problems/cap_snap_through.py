"""A clamped shallow spherical cap under outside pressure, against Marguerre's equations: both limit points.

Physics: the load rises to a maximum, where the cap snaps through, and to a minimum behind it. Which of them there are
depends on the rise alone, through lambda = 2 [3 (1 - nu^2)]^(1/4) (H/T)^(1/2). The path is the axisymmetric one.

Reference: `problems.exact.shallow_cap`; a cap whose rise is not small differs by O((H/a)^2).

Run: about a second.
"""

from __future__ import annotations

import math
from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_files
from problems.exact.shallow_cap import ShallowCap, Turning

SCENE = Path(__file__).with_suffix(".toml")
RADIUS, THICKNESS, POISSON = 10.0, 1e-3, 0.3
RISE_PARAMETER, PRESSURE = 5.0, 2420.91013067521
READINGS = {"apex": Reading((0.0, 0.0, RADIUS), "z", -1.0)}


def rise(parameter: float) -> float:
    """H in m at a rise parameter lambda."""
    return THICKNESS * parameter**2 / (4.0 * math.sqrt(3.0 * (1.0 - POISSON**2)))


def with_rise(parameter: float) -> tuple[str, str]:
    """Overrides that give the cap another rise, and end the path at twice that."""
    height = rise(parameter)
    return (
        f"shell.shape.half_angle={math.acos(1.0 - height / RADIUS)!r} rad",
        f"path=[{{until = {{where = ['0 m', '0 m', '{RADIUS!r} m'], axis = 'z', value = '{-2.0 * height!r} m'}}}}]",
    )


def thicker(factor: float, parameter: float = RISE_PARAMETER) -> tuple[str, ...]:
    """Overrides that give the cap ``factor`` times its thickness at the same rise parameter, and so a larger rise."""
    stiffer = (f"shell.thickness={factor * THICKNESS!r} m", f"loads.pressure_top={factor**2 * PRESSURE!r} Pa")
    return (*stiffer, *with_rise(parameter * math.sqrt(factor)))


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


def limit_pressures(path: LoadPath) -> list[float]:
    """Pressures of the limit points over the classical one."""
    return [point.factor_mechanical for point in path.solution.critical_points if point.kind == "limit"]


def reference(parameter: float = RISE_PARAMETER) -> tuple[Turning, ...]:
    """The same, exact for small rises."""
    return ShallowCap(parameter, POISSON).limit_points()


if __name__ == "__main__":
    path = run(archive=Path("cap_snap_through.vtkhdf"))
    for found, known in zip(limit_pressures(path), reference(), strict=True):
        print(f"limit pressure {found:.6f}, exact {known.pressure:.6f}: {found / known.pressure - 1:+.1e}")
    print(f"{len(path.solution.steps)} steps, {path.solution.iterations} Newton iterations")
    print_files(path.solution)
