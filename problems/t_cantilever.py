"""A T-section under an oblique line force, against the published path: a branched shell with a kink.

Physics: three plates meet in a line and keep their right angles while they bend.

Reference: `problems.published.t_cantilever`, another code with the same elements.

Run: about ten seconds.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.published import t_cantilever

SCENE = Path(__file__).with_suffix(".toml")
CASE = t_cantilever.T_CANTILEVER
READINGS = {
    "loaded": Reading((-0.5, 0.0, 1.0), "x"),
    "opposite": Reading((0.5, 0.0, 1.0), "z", -1.0),
}


def run(*changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides."""
    return follow(load_scene(SCENE, changes), READINGS, archive)


if __name__ == "__main__":
    path = run(archive=Path("t_cantilever.vtkhdf"))
    print_end(path, {name: CASE.end(name) for name in READINGS})
    print_files(path.solution)
