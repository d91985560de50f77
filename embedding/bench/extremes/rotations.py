"""Rotations past 360 degrees: strips and plates that an end moment rolls up, several times over."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial

from embedding.bench.extremes.cell import RIGHT, TOLD, Cell
from embedding.bench.extremes.forms import rolled as rolled_up
from embedding.bench.extremes.tables import Table, clamped, metal, rubber, scene_of
from embedding.scene import Scene

TURNS = (0.9, 1.9, 4.9)
YOUNGS = 1e6
BODIES: dict[str, tuple[Table, Table]] = {
    "strip, metal": ({"kind": "strip", "length": 1.0}, metal(YOUNGS, 0.0)),
    "strip, rubber": ({"kind": "strip", "length": 1.0}, rubber(YOUNGS / 3.0)),
    "plate": ({"kind": "plate", "length": 1.0, "width": 0.2}, metal(YOUNGS, 0.0)),
}
THICKNESSES = (1e-2, 1e-3, 1e-4)


def cells() -> list[Cell]:
    """A row for each body and thickness, a column for each number of turns."""
    strips = [rolled(body, ratio, turns) for body in BODIES for ratio in THICKNESSES for turns in TURNS]
    return [cell for cell in strips if not cell.row.startswith("plate")] + [rolled("plate", 1e-3, TURNS[0])]


def rolled(body: str, ratio: float, turns: float) -> Cell:
    """A cantilever that an end moment rolls up, against the circle; thick strips widen or thin a little."""
    angle, widens = 2.0 * math.pi * turns, 1.0
    if "rubber" in body:
        widens = rolled_up(angle * ratio)[1]
    across = "z" if body == "plate" else "y"
    reference = {
        "u_tip_x": widens * math.sin(angle) / angle - 1.0,
        f"u_tip_{across}": widens * (1.0 - math.cos(angle)) / angle,
    }
    quick = body == "strip, metal" and ratio != 1e-3 and turns < 1.0
    return Cell(
        "rotations", f"{body}, T/L {ratio:.0e}", f"{turns:g} turns", partial(_rolled, body, ratio, turns),
        partial(_same, reference), "Rivlin's bent block" if "rubber" in body else "the circle", tolerance=3e-3,
        expected=_expected(body, ratio, turns), slow=not quick, seconds=300.0,
    )  # fmt: skip


def _expected(body: str, ratio: float, turns: float) -> str:
    """Meshes do not resolve five turns, and rubber curls by more than its theory has; both is told."""
    curls = "rubber" in body and turns * ratio > 1e-3
    return TOLD if turns > 4.0 or curls else RIGHT


def _same(numbers: Mapping[str, float]) -> Mapping[str, float]:
    return numbers


def _rolled(body: str, ratio: float, turns: float) -> Scene:
    shape, material = BODIES[body]
    angle = 2.0 * math.pi * turns
    moment = angle * YOUNGS * ratio**3 / 12.0
    if "rubber" in body:
        moment = YOUNGS / 3.0 * ratio**2 * rolled_up(angle * ratio)[0]
    tip = [1.0, 0.1 if body == "plate" else 0.0, 0.0]
    return scene_of(
        "rolled", shape, ratio, material, supports=clamped("x0"),
        loads={"edge_moments": [{"edge": "x1", "moment": moment}]},
        model={"theory": "bending"}, output={"points": {"tip": tip}}, solver={"max_arc": 100.0},
        discretisation={"shell_size": 0.1},
    )  # fmt: skip
