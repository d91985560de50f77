"""A disc magnetised along its normal: an open double layer, whose field is that of a current around its rim.

Physics: the potential jumps by M T across the disc, and at the rim the field is that of a wire with the current M T:
so strong that a thin sheet has no finite energy. Away from the rim nothing of that is felt.

Reference: on the axis, a disc of finite thickness is a short solenoid, `disc_field_on_axis`; in the limit of a thin
one, the ring current, `cap_field_on_axis`, which a cap over the same rim has too. Far away it is a dipole of the
moment M T pi R^2.

Run: about ten seconds.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from embedding import Scene, Solution, load_scene, solve
from embedding.scene.scales import MU_0
from problems.common import print_files
from problems.exact.magnetised_shell import cap_field_on_axis, disc_field_on_axis
from problems.space import FieldAt

SCENE = Path(__file__).with_suffix(".toml")
REMANENCE = 0.1
"""In T, as in the scene file."""
HEIGHTS = (-2.5, -1.0, -0.3, 0.3, 0.5, 1.0, 2.5)
"""Places on the axis, in radii."""
OFF = 1e-4
"""How far from the axis they are read, in radii."""


class OnAxis(NamedTuple):
    """Largest error on the axis over the field of the ring current in its middle, M T / (2 R)."""

    thick: float
    thin: float


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.thickness=1 mm"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, OnAxis]:
    """Solve the scene with overrides; the field on the axis against a disc of finite thickness and a thin one."""
    stated = scene(*changes)
    radius, thickness, strength = stated.shell.shape.size, stated.shell.thickest, REMANENCE / MU_0
    # Elements that touch the disc move with one of its faces.
    sides = {"inside": [h for h in HEIGHTS if h < 0.0], "outside": [h for h in HEIGHTS if h > 0.0]}
    found = [FieldAt([(OFF * radius, 0.0, h * radius) for h in heights], side) for side, heights in sides.items()]
    solution = solve(stated, archive=archive, listeners=found)
    along = np.concatenate([side.values[:, 2] for side in found])
    thick = [disc_field_on_axis(radius, thickness, h * radius, strength) for h in HEIGHTS]
    thin = [cap_field_on_axis(radius, h * radius, strength * thickness) for h in HEIGHTS]
    scale = 0.5 * strength * thickness / radius
    return solution, OnAxis(*(float(np.abs(along - known).max() / scale) for known in (thick, thin)))


if __name__ == "__main__":
    solution, errors = run(archive=Path("magnetised_disc.vtkhdf"))
    print(f"field on the axis, error over M T / (2 R): {errors.thick:.1e}")
    for size in (4, 2, 1):
        errors = run("discretisation.order=4", f"discretisation.shell_size={size} mm")[1]
        print(f"elements of {size} mm, order 4: {errors.thick:.1e}; from the ring current {errors.thin:.1e}")
    print_files(solution)
