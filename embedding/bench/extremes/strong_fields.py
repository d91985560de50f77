"""Soft permeable balloons in magnetic fields: from one that hardly changes them to one far beyond what they bear."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from embedding.bench.extremes.cell import FAILED, RIGHT, Cell, Numbers, nothing
from embedding.bench.extremes.fields import BALLOON, MU, R, T
from embedding.scene import Scene
from embedding.scene.scales import MU_0

WEAK, STRONG = 1e-4, 1e4
"""mu0 H^2 over the stiffness mu T / R."""
RATIOS = (10.0, 1e6)
STRETCH = 1.2
"""By the pressure alone, before there is a field."""
WAYS: dict[str, dict[str, Any]] = {"6 steps": {"control": "load", "steps": 6}, "steps of its own": {}}
SOURCE = "the balloon without a field (Green and Adkins 1960)"


def cells() -> list[Cell]:
    """A row for each permeability and way to go; there is no closed form of a balloon that the field draws out."""
    return [*(_cell(ratio, way, load) for ratio in RATIOS for way in WAYS for load in (WEAK, STRONG)), _bending()]


def _cell(ratio: float, way: str, load: float) -> Cell:
    """A weak field leaves the balloon as it was. A strong one has a largest value, behind which the path goes back to
    no field: to the other balloon of the same pressure."""
    weak, own = load == WEAK, way == "steps of its own"
    reference = partial(_stretch, STRETCH) if weak else partial(_stretch, blown_up()) if own else nothing
    return Cell(
        "strong_fields", f"balloon, permeability {ratio:g}, {way}", f"{load:g}", partial(_scene, ratio, way, load),
        reference, SOURCE, tolerance=1e-4 if weak else 2e-3,
        reasons=frozenset({"FIELD_VANISHED" if own else "PULL_IN"}), expected=RIGHT if weak else FAILED,
        slow=(ratio, load) != (10.0, WEAK) or own, seconds=300.0,
    )  # fmt: skip


def _bending() -> Cell:
    return Cell(
        "strong_fields", "balloon that bends, permeability 10, 6 steps", f"{STRONG:g}",
        partial(_scene, 10.0, "6 steps", STRONG, theory="bending"), source=SOURCE, reasons=frozenset({"PULL_IN"}),
        expected=FAILED, slow=True, seconds=300.0,
    )  # fmt: skip


def _stretch(stretch: float) -> Numbers:
    return {"stretch": stretch}


def blown_up() -> float:
    """The stretch beyond the limit point at which the pressure 2 mu T / R (l^-1 - l^-7) is that of ``STRETCH``."""
    from scipy.optimize import brentq

    pressure = _pressure(STRETCH)
    return float(brentq(lambda stretch: _pressure(stretch) - pressure, 7.0 ** (1 / 6), 5.0, xtol=1e-14))


def _pressure(stretch: float) -> float:
    return 2.0 * MU * T / R * (1.0 / stretch - stretch**-7)


def _scene(ratio: float, way: str, load: float, theory: str = "membrane") -> Scene:
    return Scene.from_table(
        {
            "shell": {**BALLOON, "relative_permeability": ratio},
            "loads": {"pressure_bottom": _pressure(STRETCH)},
            "ambient": {"field": "magnetic", "applied_field": [0.0, 0.0, math.sqrt(load * MU * T / R / MU_0)]},
            "model": {"theory": theory},
            "path": [{"steps": 2, "field": 0.0, "control": "load"}, WAYS[way]],
            "solver": {"min_step": 1e-2, "max_steps": 15},
        }
    )
