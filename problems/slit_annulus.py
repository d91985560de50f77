"""A slit ring whose free lip is lifted by a line force, against the published end of its path.

Physics: bending and twisting of a thin ring (T/R = 1/333) through rotations of more than a right angle, in which
membrane locking shows.

Reference: `problems.published.sze_strips.SLIT_ANNULUS`, Abaqus S4R; another code on the same mesh lies 0.8 % lower.

Run: about 20 seconds.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import sze_strips

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_strips.SLIT_ANNULUS
READINGS = {
    "inner": Reading((6.0, -1e-12, 0.0), "z"),  # the lip of negative y is the free one
    "outer": Reading((10.0, -1e-12, 0.0), "z"),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("slit_annulus.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
