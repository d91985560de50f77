"""Permittivity and permeability of the shell over that of space, from 1e-6 to 1e10."""

from __future__ import annotations

from functools import partial
from typing import Any

from embedding.bench.extremes.cell import Cell, Numbers
from embedding.bench.extremes.fields import SPHERE, STIFF, STILL, shell_in_a_field
from embedding.scene import Scene

RATIOS = (1e-6, 1e-3, 0.5, 2.0, 1e3, 1e6, 1e10)
FIELD = 1e4
ROWS: dict[str, tuple[int, float, str, str]] = {
    "dielectric sphere, T/R 0.05": (3, 0.05, "electric", "axisymmetric"),
    "dielectric sphere, T/R 0.001": (3, 1e-3, "electric", "axisymmetric"),
    "permeable cylinder, T/R 0.05": (2, 0.05, "magnetic", "auto"),
    "permeable sphere in 3D, T/R 0.05": (3, 0.05, "magnetic", "3d"),
}
"""Dimension of the shape, thickness, kind of field, reduction."""
SHIELDED = 1e6
"""Within such a shell there is no field to speak of; what is left there is compared with nothing."""


def cells() -> list[Cell]:
    """Rigid shells of three regions in a uniform field, by the pressures on their faces."""
    return [_cell(row, ratio) for row in ROWS for ratio in RATIOS]


def _cell(row: str, ratio: float) -> Cell:
    dimension, thick, _, reduction = ROWS[row]
    return Cell(
        "ratios", row, f"{ratio:.0e}", partial(_scene, row, ratio),
        reference=partial(_pressures, row, ratio), source="the shell of three regions (Jackson, eq. 5.121)",
        tolerance=max(0.5 * thick**2, 3e-5) if reduction != "3d" else 3e-3,
        slow=reduction == "3d" or (dimension, thick) == (3, 1e-3) or 1e-6 < ratio < 1e10, seconds=120.0,
    )  # fmt: skip


def _pressures(row: str, ratio: float) -> Numbers:
    dimension, thick, kind, _ = ROWS[row]
    faces = shell_in_a_field(dimension, thick, ratio, FIELD, electric=kind == "electric")
    if dimension == 2 or not 1 / SHIELDED < ratio < SHIELDED:  # p_b of a cylinder has no mean
        return {"pressure_top": faces.top}
    return {"pressure_top": faces.top, "pressure_bottom": faces.bottom}


def _scene(row: str, ratio: float) -> Scene:
    dimension, thick, kind, reduction = ROWS[row]
    shape: dict[str, Any] = SPHERE if dimension == 3 else {"kind": "infinite-cylinder", "radius": 1.0}
    name = "relative_permittivity" if kind == "electric" else "relative_permeability"
    applied = [0.0, 0.0, FIELD] if dimension == 3 else [FIELD, 0.0, 0.0]
    held = STILL if dimension == 3 else [{"where": "surface", "fix": ["x", "y"]}]
    return Scene.from_table(
        {
            "name": "shell_in_a_field",
            "shell": {"shape": shape, "thickness": thick, "material": STIFF, name: ratio},
            "supports": held,
            "ambient": {"field": kind, "applied_field": applied},
            "model": {"reduction": reduction},
        }
    )
