"""A strip whose end turns by 180 degrees with the meshed space around it.

Physics: a moment at the end bends the clamped strip into a half circle; the field is weak. Elements at the end turn by
half a turn, those below it are squeezed.

Reference: the half circle of radius L / pi: the tip ends at (0, 2 L / pi), up to (pi T / L)^2. The smallest
det F of the mesh's motion is recorded as ``min_jacobian``; beyond three quarters of a turn the space is meshed anew.

Run: about ten seconds.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

from embedding import Scene, Solution, load_scene, solve
from problems.common import Probe, Reading, print_files, print_steps

SCENE = Path(__file__).with_suffix(".toml")
TIP = (1.0, 2.0 / math.pi)
"""Displacement of the tip, towards the clamp and across, over the length: that of the half circle."""


class Tip(NamedTuple):
    """How far the tip has moved over the length."""

    back: float
    across: float


def scene(*changes: str) -> Scene:
    """The scene file with overrides such as ``"shell.thickness=0.2 mm"``."""
    return load_scene(SCENE, changes)


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, Tip]:
    """Solve the scene with overrides; where the tip ends."""
    stated = scene(*changes)
    length = stated.shell.shape.size
    end = (length, 0.0, 0.0)
    probe = Probe({"back": Reading(end, "x", -1.0), "across": Reading(end, "y")})
    solution = solve(stated, archive=archive, listeners=[probe])
    return solution, Tip(*(probe.values[name][-1] / length for name in Tip._fields))


if __name__ == "__main__":
    solution, tip = run(archive=Path("turned_in_a_field.vtkhdf"))
    print_steps({name: solution[name] for name in ("displacement", "min_jacobian")})
    print(f"tip from that of the half circle, over the length: {tip.back - TIP[0]:+.1e} {tip.across - TIP[1]:+.1e}")
    print_files(solution)
