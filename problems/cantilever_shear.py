"""A cantilever under a dead end force, against the elastica and an extensible strip.

Physics: bending by 64 degrees at the tip, with hardly any stretching. The exact strip of the energy that is solved
stretches by 1e-4; the discretisation error is the distance to that, not to the inextensible elastica.

Reference: `problems.exact.koiter_strip` and `elastica`; published `problems.published.sze_strips.END_SHEAR`.

Run: less than a second.
"""

from __future__ import annotations

from pathlib import Path

from embedding import load_scene
from problems.common import LoadPath, Reading, follow, print_end, print_files
from problems.exact import elastica
from problems.exact.koiter_strip import KoiterStrip
from problems.published import sze_strips

SCENE = Path(__file__).with_suffix(".toml")
CASE = sze_strips.END_SHEAR
READINGS = {"shortening": Reading((10.0, 0.0, 0.0), "x", -1.0), "deflection": Reading((10.0, 0.0, 0.0), "y")}
PLATE = (
    "shell.shape={kind = 'plate', length = '10 m', width = '1 m'}",
    "loads.edge_tractions=[{edge = 'x1', traction = ['0 N/m', '0 N/m', '4 N/m']}]",
)
"""Overrides that make a plate of the strip."""
ON_PLATE = {"shortening": Reading((10.0, 0.5, 0.0), "x", -1.0), "deflection": Reading((10.0, 0.5, 0.0), "z")}


def run(*changes: str, plate: bool = False, archive: Path | None = None) -> LoadPath:
    """Solve the scene with overrides, in plane strain or as a ``plate``."""
    scene = load_scene(SCENE, (*(PLATE if plate else ()), *changes))
    return follow(scene, ON_PLATE if plate else READINGS, archive)


def reference() -> dict[str, float]:
    """End of the path by the energy that is solved, which has the strip stretch a little: in m."""
    strip = KoiterStrip(CASE.geometry["length"], *stiffnesses(), stretch_power=0)
    state = strip.bent(vertical=CASE.largest_load)
    return {"shortening": CASE.geometry["length"] - state.x, "deflection": state.y}


def inextensible() -> dict[str, float]:
    """The same by the elastica, the limit of a thin strip."""
    length, (_, bending) = CASE.geometry["length"], stiffnesses()
    tip = elastica.end_force(CASE.largest_load * length**2 / bending)
    return {"shortening": length * tip.shortening, "deflection": length * tip.deflection}


def stiffnesses() -> tuple[float, float]:
    """E T and E T^3 / 12, per width: in N/m and N m."""
    thickness = CASE.geometry["thickness"]
    return CASE.young * thickness, CASE.young * thickness**3 / 12.0



if __name__ == "__main__":
    path = run(archive=Path("cantilever_shear.vtkhdf"))
    print_end(path, reference())
    print_files(path.solution)
