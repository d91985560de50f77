"""Gaps between a shell and an electrode beside it, from the shell's size to 1e-5 of it."""

from __future__ import annotations

from functools import partial

from embedding.bench.extremes.cell import Cell
from embedding.bench.extremes.fields import SPHERE, conductor, disc_charge_over, sphere_charge
from embedding.scene import Scene

GAPS = (1.0, 1e-1, 1e-2, 1e-3, 1e-4)


def cells() -> list[Cell]:
    """Concentric spheres, and a disc over a plane."""
    found: list[Cell] = []
    for gap in GAPS:
        found.append(
            Cell(
                "gaps", "sphere in a grounded sphere", f"{gap:.0e}", partial(_spheres, gap),
                partial(_sphere, gap), "4 pi eps0 V / (1/R - 1/R_o)", tolerance=1e-4, slow=gap != 1e-2, seconds=300.0,
            )
        )  # fmt: skip
        if 1e-4 < gap < 1.0:  # the formula is for narrow gaps; a mesh of 1e-4 takes minutes
            found.append(
                Cell(
                    "gaps", "disc over a plane", f"{gap:.0e}", partial(_disc, gap), partial(_plates, gap),
                    "the discs of Kirchhoff and Shaw", tolerance=3e-3 if gap > 0.05 else 1e-3, slow=True, seconds=300.0,
                )
            )  # fmt: skip
    return found


def _sphere(gap: float) -> dict[str, float]:
    return {"charge": sphere_charge(1.0 + gap)}


def _plates(gap: float) -> dict[str, float]:
    return {"charge": disc_charge_over(gap)}


def _spheres(gap: float) -> Scene:
    return Scene.from_table(conductor(SPHERE, {"outer": "grounded", "radius": 1.0 + gap}))


def _disc(gap: float) -> Scene:
    plane = {"kind": "half-space", "level": -gap, "voltage": 0.0}
    return Scene.from_table(conductor({"kind": "disc", "radius": 1.0}, {"bodies": [plane]}))
