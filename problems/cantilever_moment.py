"""A cantilever rolled up to a full circle by an end moment, against the circle.

Physics: pure bending. By the energy of the turn of its normals the strip is not stretched at all, and the circle exact;
a plate of the same material widens a little where it bends.

Reference: `problems.exact.elastica`; published `problems.published.sze_strips.END_MOMENT`.

Run: less than a second.
"""

from __future__ import annotations

import math
from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.exact import elastica
from problems.published import sze_strips

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_strips.END_MOMENT
READINGS = {"shortening": Reading((12.0, 0.0, 0.0), "x", -1.0), "deflection": Reading((12.0, 0.0, 0.0), "y")}
PLATE = (
    "shell.shape={kind = 'plate', length = '12 m', width = '1 m'}",
)
"""Overrides that make a plate of the strip."""
ON_PLATE = {"shortening": Reading((12.0, 0.5, 0.0), "x", -1.0), "deflection": Reading((12.0, 0.5, 0.0), "z")}


def run(*changes: str, plate: bool = False, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides, in plane strain or as a ``plate``."""
    scene = load_scene(SCENE, (*(PLATE if plate else ()), *changes))
    return follow(scene, ON_PLATE if plate else READINGS, archive)


def reference() -> dict[str, float]:
    """End of the path, a full circle of the strip's length: in m."""
    return {"shortening": CASE.geometry["length"], "deflection": 0.0}


def exact(factor: float) -> dict[str, float]:
    """The exact inextensible strip at a part of the load, an arc of a circle: in m."""
    length = CASE.geometry["length"]
    tip = elastica.end_moment(2.0 * math.pi * factor)
    return {"shortening": length * tip.shortening, "deflection": length * tip.deflection}



if __name__ == "__main__":
    path = run(archive=Path("cantilever_moment.vtkhdf"))
    print_end(path, reference())
    print_files(path.solution)
