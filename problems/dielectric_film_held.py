"""A dielectric elastomer film whose width is held: no pull-in, against the exact film.

Physics: a film that can widen in one direction only thins less for the same voltage. For neo-Hooke the voltage rises
with the stretch all the way to T (mu/eps)^(1/2) / width: the path is monotone. The held edges keep the film in tension
across, along it stays free of load.

Reference: `problems.exact.dielectric_film` with a width, met to rounding.

Run: about a second.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Listener, Scene, Solution, load_scene, solve
from problems.common import Array, print_files, print_steps
from problems.dielectric_film import exact

SCENE = Path(__file__).with_suffix(".toml")
WIDTH = 1.5


def scene(*changes: str) -> Scene:
    """The scene file with overrides."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()) -> Solution:
    """Solve the scene with overrides."""
    return solve(scene(*changes), archive=archive, listeners=listeners)


def along(solution: Solution) -> Array:
    """Stretch in the free direction at the steps whose width is `WIDTH`: the area's square root is what is recorded."""
    return charged(solution, "stretch") ** 2 / WIDTH


def known(solution: Solution) -> Array:
    """The exact stretch at the voltages of those steps."""
    film = exact(solution.scene, WIDTH)
    return np.array([film.stretch(abs(voltage)) for voltage in charged(solution, "voltage_jump")])


def charged(solution: Solution, name: str) -> Array:
    """A scalar at the steps of the stage that charges."""
    return solution[name][[step.stage == "charging" for step in solution.steps]]


def error(solution: Solution) -> float:
    """Largest error of the stretch over the steps."""
    return float(np.abs(along(solution) - known(solution)).max())


if __name__ == "__main__":
    solution = run(archive=Path("dielectric_film_held.vtkhdf"))
    columns = {"voltage / kV": np.abs(charged(solution, "voltage_jump")) / 1e3, "stretch": along(solution)}
    print_steps(columns | {"exact": known(solution)})
    print(f"largest error of the stretch: {error(solution):.1e}")
    print_files(solution)
