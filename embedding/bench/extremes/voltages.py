"""Voltages and charges from none to far beyond pull-in."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from embedding.bench.extremes.cell import FAILED, Cell, Numbers, nothing
from embedding.bench.extremes.electrodes import (
    ELECTRODE,
    FRINGES,
    GAP,
    PELESKO,
    PLATE,
    SHEETS,
    at_pull_in,
    limit_of,
    plate,
    plate_load,
    strip,
    strip_at,
)
from embedding.bench.extremes.fields import PULL_IN, R, balloon_strain, balloon_voltage, charged
from embedding.scene import Scene
from embedding.scene.scales import EPSILON_0

if TYPE_CHECKING:
    from embedding.solving import Solution

PARTS = (0.0, 1e-6, 1e-3, 0.5, 1.5)
BEYOND = (1.0001, 1.01, 1.5, 4.8, 50.0, 1e4)
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
            answer: Callable[[Solution], Numbers] = told if way != "steps of its own" else _limit
            found.append(
                Cell(
                    "voltages", f"balloon in a grounded sphere, {way}", f"{part:g} V_p", partial(_grounded, part, way),
                    _pull_in, SOURCE, tolerance=1e-3, answers=answer,
                    reasons=frozenset({"PULL_IN", "MAX_STEPS"} if way == "steps of its own" else {"PULL_IN"}),
                    expected=FAILED, slow=True, seconds=600.0,
                )
            )  # fmt: skip
    found += [
        Cell(
            "voltages", f"slack strip over an electrode, {way}", "4.8 V_p", partial(_slack, way),
            reasons=frozenset({"PULL_IN"}), expected=FAILED, slow=True, seconds=600.0,
        )
        for way in ("10 steps", "steps of its own")
    ]  # fmt: skip
    return found + membranes() + plates() + [
        Cell(
            "voltages", f"load over stiffness 1e4, {drive}", "1e4", partial(_strong, drive),
            reasons=frozenset({"INVERTED_AMBIENT"}), expected=FAILED, slow=True, seconds=600.0,
        )
        for drive in ("voltage", "charge")
    ]  # fmt: skip


def _displacement(part: float) -> Numbers:
    if part == 0.0:
        return {"stretch": 1.0}
    return {"displacement": R * balloon_strain(part**2 * PULL_IN)}


def _pull_in() -> Numbers:
    return {"voltage": LARGEST}


def told(solution: Solution) -> Numbers:
    """The largest voltage, as a user reads it."""
    found = re.search(r"the load is largest at .*field ([0-9.e+-]+)", solution.message)
    faces = solution.scene.faces.both
    if found is None or faces is None or faces.voltage is None:
        return {}
    return {"voltage": float(found[1]) * faces.voltage}


def _limit(solution: Solution) -> Numbers:
    """The voltage of the first limit point."""
    limits = [point.scalars["voltage"] for point in solution.critical_points if point.kind == "limit"]
    return {"voltage": limits[0]} if limits else {}


NARROW = 1e-2
"""Gap of the membranes, over their size."""
STAGES: dict[str, list[dict[str, Any]]] = {"10 steps": [{"control": "load", "steps": 10}], "steps of its own": [{}]}


def membranes() -> list[Cell]:
    """A strip and a disc that were tensioned before, at parts of the voltage of the thin gap and beyond it."""
    gave_way = frozenset({"PULL_IN", "MAX_STEPS", "FIELD_VANISHED"})
    found = []
    for way, stages in STAGES.items():
        own = way == "steps of its own"
        found.append(
            Cell(
                "voltages", f"stretched strip over an electrode, {way}", "0.9 V_p", partial(strip, NARROW, 0.9, stages),
                partial(strip_at, NARROW, 0.9), PELESKO, tolerance=2e-3, slow=True, seconds=600.0,
            )
        )  # fmt: skip
        for row, (scene, _, _) in SHEETS.items():
            for part in (1.01, 1e4):
                at = partial(at_pull_in, row, NARROW) if own else partial(_voltage_at, row)
                found.append(
                    Cell(
                        "voltages", f"stretched {row} over an electrode, {way}", f"{part:g} V_p",
                        partial(scene, NARROW, part, stages), at, PELESKO, tolerance=1e-3,
                        answers=limit_of if own else told, reasons=gave_way if own else frozenset({"PULL_IN"}),
                        expected=FAILED, slow=True, seconds=600.0,
                    )
                )  # fmt: skip
    return found


def _voltage_at(row: str) -> Numbers:
    return {"voltage": at_pull_in(row, NARROW)["voltage"]}


def plates() -> list[Cell]:
    """A rigid plate on a spring that is no number of the scene, so that its pull-in is known as a load alone: at about
    463 V."""
    source = "the plate on a spring of Nathanson (1967), less the fringes of its electrode"
    found = []
    for voltage in (500.0, 5e6):
        for way, stages in STAGES.items():
            known = way != "10 steps" or voltage < 1e3
            found.append(
                Cell(
                    "voltages", f"plate on a film over an electrode, {way}", f"{voltage:g} V",
                    partial(plate, voltage, stages), _plate if known else nothing, source, tolerance=5e-3,
                    answers=plate_load, reasons=frozenset({"PULL_IN", "MAX_STEPS", "FIELD_VANISHED"}),
                    expected=FAILED, slow=True, seconds=600.0,
                )
            )  # fmt: skip
    return found


def _plate() -> Numbers:
    return {"load": PLATE * (1.0 - FRINGES * GAP / ELECTRODE)}


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
