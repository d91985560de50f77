"""The linear shell obstacle course: Scordelis-Lo roof, pinched hemispheres and pinched cylinder, by small loads.

Physics: one number a shell. The solver knows no linear theory: a part of the load is applied that is small enough for
the answer to be linear in it to 2e-6, and the displacement divided by that part.

Reference: `problems.published.obstacle_course`: the value everybody quotes, and the one that Kirchhoff-Love shells
converge to, which differs by up to 0.6 %.

Run: about 20 seconds.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_files
from problems.published import obstacle_course as published

FOLDER = Path(__file__).parent


class Shell(NamedTuple):
    """A shell of the course: what is published, the displacement that is read, and a converged value.

    ``converged`` is that of meshes and orders finer than any here, by this solver, where no other is known.
    """

    known: published.Obstacle
    reading: Reading
    converged: float


ANGLE = math.radians(40.0)
COURSE = {
    "scordelis_lo": Shell(
        published.SCORDELIS_LO, Reading((25.0 * math.cos(ANGLE), 25.0 * math.sin(ANGLE), 0.0), "x", -1.0), 0.30043
    ),
    "pinched_hemisphere": Shell(published.PINCHED_HEMISPHERE, Reading((10.0, 0.0, 0.0), "x"), 0.09241),
    "pinched_hemisphere_hole": Shell(published.PINCHED_HEMISPHERE_HOLE, Reading((10.0, 0.0, 0.0), "x"), 0.09352),
    "pinched_cylinder_linear": Shell(published.PINCHED_CYLINDER, Reading((300.0, 0.0, 0.0), "x", -1.0), 1.8291e-5),
}
"""By the names of the scene files."""


def run(name: str, *changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene ``name`` of the course with overrides."""
    readings = {"displacement": COURSE[name].reading}
    return follow(load_scene(FOLDER / f"{name}.toml", changes), readings, archive)


def displacement(path: LoadPath) -> float:
    """The displacement at the stated load, in m, by linear theory."""
    return path.end("displacement") / float(path.factors[-1])


if __name__ == "__main__":
    for name, shell in COURSE.items():
        path = run(name, archive=Path("obstacle_course.vtkhdf"))
        found, thin = displacement(path), f", thin {shell.known.thin:.6g}" if shell.known.thin else ""
        print(f"{shell.known.name}: {found:.6g} m, quoted {shell.known.reference:.6g}{thin}", end="; ")
        print(f"{found / shell.known.reference - 1:+.1e}, {path.solution.iterations} Newton iterations")
    print_files(path.solution)
