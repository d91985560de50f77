"""Meshes from absurdly coarse to beyond memory, with slivers and with jumps of size."""

from __future__ import annotations

from functools import partial
from typing import Any

from embedding.bench.extremes.cell import REFUSED, RIGHT, TOLD, Cell
from embedding.bench.extremes.fields import SPHERE, conductor, disc_charge, sphere_charge
from embedding.scene import Scene

SIZES = (10.0, 3.0, 1.0, 0.3)
JUMPS = (1e-1, 1e-2, 1e-3)


def cells() -> list[Cell]:
    """Charges of conductors on meshes of all kinds."""
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
    for reduction in ("axisymmetric", "3d"):
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


def _disc(jump: float) -> Scene:
    sizes = {"shell_size": 0.5, "edge_size": {"rim": 0.5 * jump}}
    return Scene.from_table(conductor({"kind": "disc", "radius": 1.0}, {}, discretisation=sizes))
