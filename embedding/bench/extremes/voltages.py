"""Voltages and charges from none to far beyond pull-in."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from embedding.bench.extremes.cell import FAILED, Cell, Numbers, nothing
from embedding.bench.extremes.fields import PULL_IN, R, balloon_strain, balloon_voltage, charged
from embedding.scene import Scene
from embedding.scene.scales import EPSILON_0

if TYPE_CHECKING:
    from embedding.solving import Solution

PARTS = (0.0, 1e-6, 1e-3, 0.5, 1.5)
BEYOND = (1.01, 1.5, 4.8, 50.0, 1e4)
LARGEST = balloon_voltage(PULL_IN)
SOURCE = "the charged membrane in a grounded sphere, largest at w = 0.5418"
WAYS: dict[str, dict[str, Any]] = {
    "10 steps": {"path": [{"steps": 10}], "solver": {"min_step": 1e-3}},
    "one step": {"path": [{"steps": 1}], "solver": {"min_step": 1e-2}},
    "steps of its own": {"path": [{}], "solver": {"max_steps": 8}},
}


def cells() -> list[Cell]:
    """A balloon at parts of its pull-in voltage in open space, where there is none, and beyond it where there is."""
    found = [
        Cell(
            "voltages", f"balloon in open space, {way}", f"{part:g} V_p", partial(_open, part, way),
            partial(_displacement, part), "the charged membrane, l - l^-5 = w", tolerance=1e-3,
            slow=part not in (0.0, 1e-6) or way != "10 steps",
        )
        for way in ("10 steps", "steps of its own") for part in PARTS
    ]  # fmt: skip
    for way in WAYS:
        for part in BEYOND:
            answer: Callable[[Solution], Numbers] = _reached if way != "steps of its own" else _limit
            found.append(
                Cell(
                    "voltages", f"balloon in a grounded sphere, {way}", f"{part:g} V_p", partial(_grounded, part, way),
                    nothing if way == "one step" or part > 1e3 else _pull_in, SOURCE, tolerance=1e-2, answers=answer,
                    reasons=frozenset({"PULL_IN", "MAX_STEPS"} if way == "steps of its own" else {"PULL_IN"}),
                    expected=FAILED, slow=True, seconds=300.0,
                )
            )  # fmt: skip
    found += [
        Cell(
            "voltages", f"slack strip over an electrode, {way}", "4.8 V_p", partial(_slack, way),
            reasons=frozenset({"PULL_IN"}), expected=FAILED, slow=True, seconds=300.0,
        )
        for way in ("10 steps", "steps of its own")
    ]  # fmt: skip
    return found + [
        Cell(
            "voltages", f"load over stiffness 1e4, {drive}", "1e4", partial(_strong, drive),
            reasons=frozenset({"INVERTED_AMBIENT"}), expected=FAILED, slow=True, seconds=300.0,
        )
        for drive in ("voltage", "charge")
    ]  # fmt: skip


def _displacement(part: float) -> Numbers:
    if part == 0.0:
        return {"stretch": 1.0}
    return {"displacement": R * balloon_strain(part**2 * PULL_IN)}


def _pull_in() -> Numbers:
    return {"voltage": LARGEST}


def _reached(solution: Solution) -> Numbers:
    """The last voltage at which there was an equilibrium."""
    return {"voltage": float(solution["voltage"][-1])} if solution.steps else {}


def _limit(solution: Solution) -> Numbers:
    """The voltage of the first limit point."""
    limits = [point.scalars["voltage"] for point in solution.critical_points if point.kind == "limit"]
    return {"voltage": limits[0]} if limits else {}


def _open(part: float, way: str) -> Scene:
    return Scene.from_table(charged({"voltage": part * LARGEST}, **WAYS[way]))


def _grounded(part: float, way: str) -> Scene:
    return Scene.from_table(charged({"voltage": part * LARGEST}, grounded=True, **WAYS[way]))


def _strong(drive: str) -> Scene:
    """The pull of the field on the shell at rest is 1e4 times what its stiffness mu T / R can take."""
    voltage = balloon_voltage(1e4)
    strength = voltage if drive == "voltage" else 4 * math.pi * EPSILON_0 * R * voltage
    return Scene.from_table(charged({drive: strength}, path=[{"steps": 10}], solver={"min_step": 1e-3}))


def _slack(way: str) -> Scene:
    """A strip that its tension and the voltage load together, from rest: at 4.8 times what its tension bears, at any
    part of both."""
    return Scene.from_table(
        {
            "shell": {
                "shape": {"kind": "strip", "length": 0.1},
                "thickness": 1e-5,
                "material": {"law": "neo-hookean", "shear_modulus": 1e7},
            },
            "supports": [{"where": "x0", "kind": "pinned"}, {"where": "x1", "fix": ["y"]}],
            "loads": {"edge_tractions": [{"edge": "x1", "traction": [0.3994, 0.0, 0.0]}]},
            "ambient": {"field": "electric", "bodies": [{"kind": "half-space", "level": -5e-3, "voltage": 0.0}]},
            "faces": {"both": {"voltage": 6.05e3}},
            "model": {"interface": "closed"},
            "discretisation": {"edge_size": {"x0": 2.5e-3, "x1": 2.5e-3}},
            **WAYS[way],
        }
    )
