"""The families of the map, each a module beside this one with a function ``cells``."""

from __future__ import annotations

from importlib import import_module

from embedding.bench.extremes.cell import Cell

FAMILIES = (
    "thickness", "stretch", "rotations", "limit_points", "units", "steps",
    "ratios", "voltages", "strong_fields", "remanence", "radii", "gaps", "meshes",
)  # fmt: skip
"""In the order of the map."""


def cells_of(*families: str) -> list[Cell]:
    """The cells of ``families``, by default of all."""
    found: list[Cell] = []
    for name in families or FAMILIES:
        found += import_module(f"embedding.bench.extremes.{name}").cells()
    return found
