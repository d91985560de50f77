"""Meshes from absurdly coarse to beyond memory, with slivers and with jumps of size."""

from __future__ import annotations

from functools import partial
from typing import Any

from embedding.bench.extremes.cell import REFUSED, RIGHT, TOLD, Cell
from embedding.bench.extremes.fields import SPHERE, conductor, disc_charge, sphere_charge
from embedding.bench.extremes.tables import by_load, clamped, metal, scene_of
from embedding.scene import Scene

SIZES = (10.0, 3.0, 1.0, 0.3)
JUMPS = (1e-1, 1e-2, 1e-3)


def cells() -> list[Cell]:
    """Charges of conductors, and the deflection of a strip, on meshes of all kinds."""
    found: list[Cell] = []
    for size in SIZES:
        for reduction in ("axisymmetric", "3d"):
            found.append(
                Cell(
                    "meshes", f"elements on a sphere, {reduction}", f"{size:g} R", partial(_sphere, size, reduction),
                    _of_sphere, "4 pi eps0 R V", tolerance=1e-3, slow=reduction == "3d", seconds=120.0,
                )
            )  # fmt: skip
    for jump in JUMPS:
        found.append(
            Cell(
                "meshes", "elements along a rim over the others", f"{jump:g}", partial(_disc, jump), _of_disc,
                "8 eps0 R V", tolerance=1e-3, expected=TOLD if jump > 0.05 else RIGHT, slow=jump > 1e-3,
            )
        )  # fmt: skip
    for part in JUMPS:
        beams = {
            "3D strip as wide as": partial(_strip, part, 0.1),
            "3D strip, elements at its clamp over the others": partial(_strip, 0.02, 0.1 * part),
        }
        found += [
            Cell(
                "meshes", row, f"{part:g}", scene, _of_strip, "Euler's beam", tolerance=1e-5,
                slow=(row, part) != ("3D strip as wide as", 1e-3), seconds=300.0,
            )
            for row, scene in beams.items()
        ]  # fmt: skip
    for reduction in ("axisymmetric", "3d"):
        found.append(
            Cell(
                "meshes", f"elements of space around a sphere, {reduction}", "1e3 R", partial(_alone, reduction),
                fields=("discretisation.",), expected=REFUSED, slow=True,
                source="sizes that may jump at once by 1e3 are more than the mesh generator can do",
            )
        )  # fmt: skip
        found.append(
            Cell(
                "meshes", f"elements on a sphere, {reduction}", "1e-9 R", partial(_sphere, 1e-9, reduction),
                fields=("discretisation.shell_size",), expected=REFUSED, source="memory",
            )
        )  # fmt: skip
    return found


def _of_sphere() -> dict[str, float]:
    return {"charge": sphere_charge()}


def _of_disc() -> dict[str, float]:
    return {"charge": disc_charge()}


def _sphere(size: float, reduction: str) -> Scene:
    model: dict[str, Any] = {"interface": "closed", "reduction": reduction}
    return Scene.from_table(conductor(SPHERE, {}, model=model, discretisation={"shell_size": size}))


def _alone(reduction: str) -> Scene:
    model: dict[str, Any] = {"interface": "closed", "reduction": reduction}
    sizes = {"shell_size": 0.5, "ambient_size": 1e3, "grading": 1.0}
    return Scene.from_table(conductor(SPHERE, {"radius": 1e3}, model=model, discretisation=sizes))


DEFLECTION = 1e-3
"""Of the strip, over its length of 1 m; its thickness is as much."""


def _of_strip() -> dict[str, float]:
    return {"u_tip_z": DEFLECTION}


def _strip(width: float, at_clamp: float) -> Scene:
    """A cantilever under a force F at its end, F L^3 / (3 E I), in elements of a tenth of its length and ``at_clamp``:
    slivers where it is narrow."""
    youngs, thickness = 1e9, 1e-3
    force = 3.0 * youngs * thickness**3 / 12.0 * DEFLECTION
    return scene_of(
        "strip", {"kind": "plate", "length": 1.0, "width": width}, thickness, metal(youngs, 0.0),
        supports=clamped("x0"), loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, 0.0, force]}]},
        path=by_load(1), model={"theory": "bending", "reduction": "3d"},
        discretisation={"shell_size": 0.1, "edge_size": {"x0": at_clamp}},
        output={"points": {"tip": [1.0, 0.5 * width, 0.0]}},
    )  # fmt: skip


def _disc(jump: float) -> Scene:
    sizes = {"shell_size": 0.5, "edge_size": {"rim": 0.5 * jump}}
    return Scene.from_table(conductor({"kind": "disc", "radius": 1.0}, {}, discretisation=sizes))
