"""A cylinder over rigid diaphragms, pinched far beyond small deflections, against the published path.

Physics: the wall dimples under the forces, and the dimple spreads until it bends the whole cylinder.

Reference: `problems.published.sze_cylinders.PINCHED_CYLINDER`, Abaqus S4R; a second code on the same mesh lies up to
2.5 % higher.

Run: minutes.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import sze_cylinders

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_cylinders.PINCHED_CYLINDER
READINGS = {
    "pinched": Reading((100.0, 0.0, 0.0), "x", -1.0),
    "side": Reading((0.0, 100.0, 0.0), "y"),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("pinched_cylinder.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
