"""A closed shell with a remanence: uniform, and along its normal.

Physics: a uniform remanence has poles on both faces, whose fields cancel in the cavity and make a dipole outside. A
constant remanence along the normal is a closed double layer: the potential jumps and there is no field on either side.

Reference: `problems.exact.magnetised_shell`: two uniformly magnetised balls laid over each other; the shell
approaches them as O((T/R)^2) of M T / R, M T being the strength of its sheet. Without any field the error is that of
the mesh.

Run: about fifteen seconds.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from embedding import Scene, Solution, load_scene, solve
from embedding.scene.scales import MU_0
from problems.common import Array, print_files, thickness_ratio
from problems.exact.magnetised_shell import magnetised_sphere
from problems.space import FieldAt

SCENE = Path(__file__).with_suffix(".toml")
REMANENCE = 0.1
"""In T, as in the scene file."""
ALONG_NORMAL = "shell.remanence={expression=['0.1*x/0.02', '0.1*y/0.02', '0.1*z/0.02']}"
"""Override: the remanence along the normal."""
FINE = ("discretisation.order=4", "discretisation.shell_size=2 mm")
"""A mesh whose error is below that of the theory."""
OUTSIDE = ((0.0005, 1.5), (1.2, 1.2), (2.0, 0.0005), (0.0005, 2.5), (2.0, 1.5), (3.5, 0.0005))
CAVITY = ((0.0005, 0.0), (0.2, 0.3), (0.7, 0.0), (0.0005, 0.8))
"""Places (x, z) in radii."""


class Fields(NamedTuple):
    """Errors of the field outside and of that in the cavity, which is none, over M T / R."""

    outside: float
    cavity: float


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.thickness=2 mm"``."""
    return load_scene(SCENE, changes)


def at(ratio: float) -> str:
    """Override for another T/R."""
    return f"shell.thickness={ratio * scene().shell.shape.size!r}"


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, Fields]:
    """Solve the scene with overrides; a remanence along the normal has no field to compare with."""
    stated = scene(*changes)
    radius = stated.shell.shape.size
    outside, cavity = (FieldAt([(radius * x, 0.0, radius * z) for x, z in places], side)
                       for places, side in ((OUTSIDE, "outside"), (CAVITY, "inside")))  # fmt: skip
    solution = solve(stated, archive=archive, listeners=[outside, cavity])
    uniform = isinstance(stated.shell.remanence, tuple)
    known = dipole(stated) if uniform else np.zeros_like(outside.values)
    scale = REMANENCE / MU_0 * thickness_ratio(stated)
    return solution, Fields(
        float(np.abs(outside.values - known).max() / scale), float(np.abs(cavity.values).max() / scale)
    )


def dipole(scene: Scene) -> Array:
    """Exact field (n, 3) in A/m at the places outside."""
    exact = magnetised_sphere(thickness_ratio(scene), 1.0, REMANENCE / MU_0)
    field = []
    for x, z in OUTSIDE:
        angle = math.atan2(x, z)
        radial, along = exact.field_at(math.hypot(x, z), angle)
        sin, cos = math.sin(angle), math.cos(angle)
        field.append((radial * sin + along * cos, 0.0, radial * cos - along * sin))
    return np.array(field)


if __name__ == "__main__":
    solution, _ = run(archive=Path("magnetised_sphere.vtkhdf"))
    print("field outside and in the cavity, errors over M T / R")
    for name, changes in (("uniform", ()), ("along the normal", (ALONG_NORMAL,))):
        for ratio in (0.1, 0.05):
            outside, cavity = run(*changes, at(ratio), *FINE)[1]
            print(f"{name}, T/R = {ratio:<5g} outside {outside:.1e}  cavity {cavity:.1e}")
    print_files(solution)
