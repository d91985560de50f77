"""A hemisphere with a hole under alternating radial forces, against the published path.

Physics: nearly inextensional bending of a thin shell (T/R = 1/250), with rotations near a right angle.

Reference: `problems.published.sze_cylinders.HEMISPHERE`, Abaqus S4R.

Run: about ten seconds.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import sze_cylinders

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_cylinders.HEMISPHERE
READINGS = {
    "outward": Reading((10.0, 0.0, 0.0), "x"),
    "inward": Reading((0.0, 10.0, 0.0), "y", -1.0),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("hemisphere_with_hole.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
