"""A short open cylinder pulled apart by two forces, against the published path.

Physics: bending gives way to stretching at half of the load, where the wall beside the forces snaps.

Reference: `problems.published.sze_cylinders.PULLED_CYLINDER`, Abaqus S4R; a second code by its side.

Run: about half a minute.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import sze_cylinders

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_cylinders.PULLED_CYLINDER
READINGS = {
    "pulled": Reading((4.953, 0.0, 0.0), "x"),
    "middle": Reading((0.0, 4.953, 0.0), "y", -1.0),
    "end": Reading((0.0, 4.953, 5.175), "y", -1.0),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("pulled_cylinder.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
