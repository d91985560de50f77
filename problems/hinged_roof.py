"""Hinged cylindrical roofs that snap through, against published paths: by arc length over limit points and back.

Physics: a shallow roof under a central dead force. Its load has a maximum and a minimum; at the smaller of the two
thicknesses the displacement turns back as well (snap-back), so that neither load nor displacement can be prescribed.

Reference: `problems.published.sze_roof`, Abaqus S4R. The path is the doubly symmetric one.

Run: a few seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from embedding import load_scene
from problems.common import Array, LoadPath, Reading, follow, print_files
from problems.published import sze_roof

SCENE = Path(__file__).with_suffix(".toml")
CASES = {"12.7 m": sze_roof.THICK_ROOF, "6.35 m": sze_roof.THIN_ROOF}
READINGS = {"centre": Reading((2540.0, 0.0, 0.0), "x", -1.0)}


def run(thickness: str, *changes: str, archive: Path | None = None) -> LoadPath:
    """Solve the scene at one of the thicknesses of ``CASES``, with overrides."""
    return follow(load_scene(SCENE, (f"shell.thickness={thickness}", *changes)), READINGS, archive)


def limit_loads(path: LoadPath) -> list[float]:
    """Loads of the limit points on the path, in N."""
    load = path.solution.scene.loads.point_loads[0].force[0]
    return [-load * point.factor_mechanical for point in path.solution.critical_points if point.kind == "limit"]


def published_limit_loads(thickness: str) -> list[float]:
    """The same of the published path, by the parabola through the three rows around each turn, in N."""
    case = CASES[thickness]
    loads, found = case.largest_load * np.array(case.table["factor"]), []
    for row in range(1, len(loads) - 1):
        if (loads[row] - loads[row - 1]) * (loads[row + 1] - loads[row]) < 0.0:
            parabola = np.polynomial.Polynomial.fit([-1.0, 0.0, 1.0], loads[row - 1 : row + 2], 2)
            found.append(float(parabola(parabola.deriv().roots()[0])))
    return found


def distances(path: LoadPath, thickness: str) -> Array:
    """Distance of every step from the published curve, both axes in its extent."""
    case = CASES[thickness]
    return path.distances("centre", case.table["factor"], case.table["centre"])


if __name__ == "__main__":
    for thickness in CASES:
        path = run(thickness, archive=Path("hinged_roof.vtkhdf"))
        for load, known in zip(limit_loads(path), published_limit_loads(thickness), strict=True):
            print(f"thickness {thickness}: limit load {load:.1f} N, published {known:.1f} N")
        print(f"largest distance from the published curve, in its extent: {distances(path, thickness).max():.1e}")
        print(f"{len(path.solution.steps)} steps, {path.solution.iterations} Newton iterations")
    print_files(path.solution)
