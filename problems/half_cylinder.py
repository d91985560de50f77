"""A cylinder clamped at one end and pinched at the other, against the published path.

Physics: the free end is flattened and pushed through itself, while the clamp keeps its circle.

Reference: `problems.published.sze_cylinders.HALF_CYLINDER`, Abaqus S4R: one half, with mirror symmetry along the cut.

Run: about a minute.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import sze_cylinders

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_cylinders.HALF_CYLINDER
READINGS = {
    "pinched": Reading((101.6, 0.0, 152.4), "x", -1.0),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("half_cylinder.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
