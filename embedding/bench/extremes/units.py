"""The same shells in other units: lengths from micrometres to kilometres, moduli from 1e-2 to 1e12 Pa."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from embedding.bench.extremes.cell import Cell, Numbers, last_scalars
from embedding.bench.extremes.tables import clamped, metal, rubber, scene_of
from embedding.scene import Scene

if TYPE_CHECKING:
    from embedding.solving import Solution

LENGTHS = (1e-6, 1e-3, 1.0, 1e3)
MODULI = (1e-2, 1.0, 1e5, 1e9, 1e12)
BASE = (1.0, 1e5)
SAME = 1e-8
QUICK = {("cantilever", 1e-6, 1e12), ("balloon", 1e3, 1e-2), ("charged balloon", 1e-6, 1e-2)}
"""Cells of the default tests."""
EPSILON_0 = 8.8541878188e-12
WRITTEN = {1e-6: "um", 1e-3: "mm", 1.0: "m", 1e3: "km"}


def cells() -> list[Cell]:
    """A row for each shell and length, a column for each modulus."""
    return [
        _cell(shell, length, modulus) for shell in SCENES for length in LENGTHS for modulus in MODULI
        if (length, modulus) != BASE
    ]  # fmt: skip


def _cell(shell: str, length: float, modulus: float) -> Cell:
    quick = (shell, length, modulus) in QUICK
    return Cell(
        "units", f"{shell}, {length:g} m", f"{modulus:.0e} Pa", partial(SCENES[shell], length, modulus),
        partial(_base, shell), "the same shell of 1 m and 1e5 Pa", tolerance=SAME,
        answers=partial(_dimensionless, length, modulus), slow=not quick,
    )  # fmt: skip


def _base(shell: str) -> Numbers:
    """The answers in the units that the others are compared with."""
    from embedding.api import solve

    return _dimensionless(*BASE, solve(SCENES[shell](*BASE)))


def _dimensionless(length: float, modulus: float, solution: Solution) -> Numbers:
    """What all units must agree on: stretches, displacements over the length, energies over modulus and volume."""
    scalars = last_scalars(solution)
    found = {name: scalars[name] for name in ("stretch", "stretch_max") if name in scalars}
    found["elastic energy"] = scalars["elastic_energy"] / (modulus * length**ENERGY[solution.scene.name])
    found |= {name: value / length for name, value in scalars.items() if name.startswith("u_") and abs(value) > 0.0}
    if "charge" in scalars:
        found["charge"] = scalars["charge"] / (length**2 * math.sqrt(modulus * EPSILON_0))
        found["field energy"] = scalars["field_energy"] / (modulus * length**3)
    return found


ENERGY = {"balloon": 3, "cantilever": 2, "disc": 3, "charged_balloon": 3}
"""Powers of the length in an energy."""


def balloon(length: float, modulus: float) -> Scene:
    """A membrane inflated; its thickness is written in another unit."""
    return scene_of(
        "balloon", {"kind": "sphere", "radius": length}, f"{0.05 * length * 1e9:.17g} nm", rubber(modulus),  # type: ignore[arg-type]
        loads={"pressure_bottom": 0.05 * modulus}, path=[{"steps": 3}],
    )  # fmt: skip


def cantilever(length: float, modulus: float) -> Scene:
    """A strip bent far by a force; its length is a text with a unit."""
    unit, ratio = WRITTEN[length], 1e-2
    return scene_of(
        "cantilever", {"kind": "strip", "length": f"1 {unit}"}, ratio * length, metal(modulus, 0.3),
        supports=clamped("x0"),
        loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, modulus * length * ratio**3 / 3.0, 0.0]}]},
        output={"points": {"tip": [length, 0.0, 0.0]}},
    )  # fmt: skip


def disc(length: float, modulus: float) -> Scene:
    """A plate in three dimensions, clamped and pressed."""
    return scene_of(
        "disc", {"kind": "disc", "radius": length}, 0.02 * length, metal(modulus, 0.3), supports=clamped("rim"),
        loads={"pressure_bottom": modulus * 0.02**4 * 20.0}, path=[{"steps": 2}], model={"reduction": "3d"},
        output={"points": {"middle": [0.0, 0.0, 0.0]}}, discretisation={"order": 2},
    )  # fmt: skip


def charged_balloon(length: float, modulus: float) -> Scene:
    """A balloon with a pressure inside and a voltage."""
    electrode = {"voltage": 0.35 * length * math.sqrt(modulus / EPSILON_0)}
    return scene_of(
        "charged_balloon", {"kind": "sphere", "radius": length}, 0.05 * length, rubber(modulus),
        loads={"pressure_bottom": 0.02 * modulus}, ambient={"field": "electric"},
        faces={"top": electrode, "bottom": electrode}, path=[{"steps": 3}],
    )  # fmt: skip


SCENES = {"balloon": balloon, "cantilever": cantilever, "disc, 3D": disc, "charged balloon": charged_balloon}
