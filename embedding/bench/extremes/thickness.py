"""Thickness over size from 2e-1 to 1e-7: membrane and bending, curved and flat."""

from __future__ import annotations

from functools import partial

from embedding.bench.extremes.cell import Cell
from embedding.bench.extremes.forms import thick_sphere_pressure
from embedding.scene import Scene

RATIOS = (2e-1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
MODULUS, STRETCH = 1e5, 1.2


def cells() -> list[Cell]:
    """A row for each shape and theory, a column for each ratio."""
    return [inflated_sphere(theory, ratio) for theory in ("membrane", "bending") for ratio in RATIOS]


def inflated_sphere(theory: str, ratio: float) -> Cell:
    """A balloon under the pressure that belongs to a stretch, against the thick-walled sphere.

    Shells are off by the square of the ratio.
    """
    return Cell(
        "thickness", f"inflated sphere, {theory}", f"T/R {ratio:.0e}", partial(_sphere, theory, ratio),
        reference=lambda: {"stretch": STRETCH}, source="the thick-walled sphere",
        tolerance=max(ratio**2, 1e-6), reasons=frozenset(), slow=not 1e-6 < ratio < 1e-1,
    )  # fmt: skip


def _sphere(theory: str, ratio: float) -> Scene:
    pressure = MODULUS * thick_sphere_pressure(STRETCH, ratio)
    return Scene.from_table(
        {
            "name": "inflated_sphere",
            "shell": {
                "shape": {"kind": "sphere", "radius": 0.02},
                "thickness": 0.02 * ratio,
                "material": {"law": "neo-hookean", "shear_modulus": MODULUS},
            },
            "loads": {"pressure_bottom": pressure},
            "path": [{"steps": 3}],
            "model": {"theory": theory},
        }
    )
