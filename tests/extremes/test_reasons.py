"""Every way in which a solve can end, by a cause that was planted for it."""

from __future__ import annotations

import re
from typing import Any

import pytest

from embedding import Listener, Result, Scene, Solution, solve
from embedding.bench.extremes import remanence
from embedding.bench.extremes.fields import PULL_IN, STIFF, balloon_voltage, charged

R, T, MU = 0.02, 1e-3, 1e5
RUBBER = {"law": "neo-hookean", "shear_modulus": MU}
BALLOON = {"shape": {"kind": "sphere", "radius": R}, "thickness": T, "material": RUBBER}
PLATE = {"shape": {"kind": "plate", "length": 1.0, "width": 1.0}, "thickness": 1e-3, "material": STIFF}
LARGEST = 2 * MU * T / R * (7 ** (-1 / 6) - 7 ** (-7 / 6))
"""Of the pressure 2 mu T / R (1/l - l^-7) of a balloon, at l^6 = 7."""
FULL = {"both": {"voltage": 1.5 * balloon_voltage(PULL_IN)}}


def inflated(part: float, **changes: Any) -> dict[str, Any]:
    """A balloon under a part of its largest pressure."""
    return {"shell": BALLOON, "loads": {"pressure_bottom": part * LARGEST}, **changes}


def permeable(strength: float) -> dict[str, Any]:
    """A balloon that a field holds more than it holds itself, field and shell in turn."""
    return {
        "shell": {**BALLOON, "material": {"law": "neo-hookean", "shear_modulus": 3e4}, "relative_permeability": 10.0},
        "loads": {"pressure_bottom": 1.4e3},
        "ambient": {"field": "magnetic", "applied_field": [0.0, 0.0, strength]},
        "model": {"coupling": "staggered"},
        "solver": {"acceleration": "none", "min_step": 0.3},
        "path": [{"steps": 2, "field": 0.0}, {"steps": 2}],
    }


def bent(ratio: float, loads: dict[str, Any], **solver: float) -> dict[str, Any]:
    """A cantilever strip of rubber."""
    shell = {"shape": {"kind": "strip", "length": 1.0}, "thickness": ratio, "material": RUBBER}
    held = [{"where": "x0", "kind": "clamped"}]
    return {"shell": shell, "supports": held, "model": {"theory": "bending"}, "loads": loads, "solver": solver}


PLANTED: dict[Result, dict[str, Any]] = {
    Result.CONVERGED: inflated(0.5),
    Result.LIMIT_POINT: inflated(1.2, path=[{"steps": 2}], solver={"min_step": 0.1}),
    Result.PULL_IN: charged({"voltage": 1.5 * balloon_voltage(PULL_IN)}, grounded=True, path=[{"steps": 4}],
                            solver={"min_step": 0.1}),
    Result.COMPRESSIVE_MEMBRANE: inflated(-0.5),
    Result.INVERTED_AMBIENT: {
        "shell": BALLOON, "ambient": {"field": "electric", "outer": "grounded", "radius": 1.3 * R},
        "faces": {"both": {"voltage": 1e5}}, "path": [{"steps": 2, "volume_ratio": 4.0}], "solver": {"min_step": 0.3},
    },
    Result.LINEAR_SOLVER_FAILED: {
        "shell": PLATE, "supports": [{"where": "x0", "fix": ["x", "y", "z"]}], "path": [{"steps": 1}],
        "loads": {"edge_tractions": [{"edge": "x1", "traction": [0.0, 0.0, 1e-3]}]}, "solver": {"min_step": 0.6},
    },
    Result.MAX_STEPS: inflated(0.5, solver={"max_steps": 2}),
    Result.MAX_ARC: inflated(1.2, solver={"max_arc": 1.0}),
    Result.FIELD_VANISHED: charged(
        {"voltage": 4e5}, grounded=True, loads={"pressure_bottom": 1.1 * 3e4 * T / R}, path=[{"field": 0.0}, {}],
    ),
    Result.STAGGERED_DIVERGED: permeable(7e4),
    Result.STEP_BELOW_MINIMUM: inflated(0.9, path=[{"steps": 1}], solver={"max_iterations": 2, "min_step": 0.6}),
    Result.BEYOND_THE_MODEL: inflated(
        0.5, shell={**BALLOON, "thickness": 0.1 * R}, accuracy={"relative": 1e-6, "of": ["displacement"]},
    ),
    Result.ACCURACY_NOT_REACHED: {
        "shell": {"shape": {"kind": "disc", "radius": R}, "thickness": 1e-9, "material": STIFF},
        "supports": [{"where": "surface", "fix": ["x", "y", "z"]}], "ambient": {"field": "electric"},
        "faces": {"both": {"voltage": 1e3}}, "model": {"interface": "closed"},
        "accuracy": {"relative": 1e-6, "of": ["charge"], "max_unknowns": 1000},
    },
    Result.TOO_THIN: bent(
        1e-7, {"edge_tractions": [{"edge": "x1", "traction": [0.0, 4 / 3 * MU * 1e-7**3, 0.0]}]}, min_step=0.1
    ),
    Result.SHARPLY_BENT: bent(0.2, {"edge_moments": [{"edge": "x1", "moment": 0.2 * MU * 0.2**2}]}, max_arc=1.0),
    Result.INTERRUPTED: inflated(0.5), Result.OUT_OF_MEMORY: inflated(0.5),
}  # fmt: skip


RAISED = {Result.INTERRUPTED: KeyboardInterrupt, Result.OUT_OF_MEMORY: MemoryError}
"""Those that come from outside; tests/faults has memory that is truly short, and true signals."""


class Disturbing(Listener):
    """Raises in the second step."""

    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def iterated(self, step_number: int, target: dict[str, float], iteration: Any) -> None:
        """Raise as the signal, or an allocation, would."""
        if step_number == 2:
            raise self.error


def ended(reason: Result) -> Solution:
    listeners = [Disturbing(RAISED[reason])] if reason in RAISED else []
    return solve(Scene.from_table(PLANTED[reason]), throw=False, listeners=listeners)


LONG = {"kind": "ellipsoid", "semi_axes": [R, R, 2 * R]}
TORUS = {"kind": "torus", "radius": 2 * R, "tube_radius": R / 2}


@pytest.mark.parametrize("thickness", [1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("shape", [BALLOON["shape"], TORUS, LONG])
@pytest.mark.parametrize("stage", [{"steps": 2}, {"steps": 2, "control": "load"}, {}], ids=str)
def test_no_closed_membrane_has_a_limit_point_under_pressure_from_outside(
    shape: dict[str, Any], thickness: float, stage: dict[str, Any]
) -> None:
    """Stresses are -p R / (2 T) all over a sphere, and below 0 all over a torus (Timoshenko, Plates and Shells, sec.
    107), however small p: the whole wrinkles. So thin that its mesh makes the path turn before it is found to be in
    compression."""
    shell = {**BALLOON, "shape": shape, "thickness": thickness}
    scene = {"shell": shell, "loads": {"pressure_top": 100.0}, "path": [stage]}
    solution = solve(Scene.from_table(scene), throw=False)
    assert solution.result is Result.COMPRESSIVE_MEMBRANE, solution.message
    told = re.search(r"([\d.]+) % of the area", solution.message)
    assert told is not None and float(told[1]) > 50.0


def test_no_membrane_is_turned_inside_out() -> None:
    """Inside out, the same pressure would inflate it: an equilibrium, to which no path leads from rest."""
    law = {"law": "st-venant-kirchhoff", "youngs_modulus": 1e9, "poisson_ratio": 0.3}
    shell = {"shape": LONG, "thickness": 1e-7, "material": law}
    scene = {"shell": shell, "loads": {"pressure_top": 1e4}, "model": {"theory": "membrane"}, "path": [{}]}
    solution = solve(Scene.from_table(scene), throw=False)
    assert solution.result is Result.COMPRESSIVE_MEMBRANE, solution.message


@pytest.mark.parametrize("reason", PLANTED)
def test_planted(reason: Result) -> None:
    solution = ended(reason)
    assert solution.result is reason, solution.message
    assert reason.advice in solution.message


def test_every_reason_has_a_cause() -> None:
    assert set(PLANTED) == set(Result)


def test_too_thin_for_its_elements() -> None:
    """The shell bends well in larger ones; these are so stiff against stretching that digits are wanting."""
    cells = {(cell.row, cell.value): cell for cell in remanence.cells()}
    cell = cells["strip, field nearly against", "a = 100000"]
    solution = solve(cell.scene().with_overrides(["discretisation.edge_size={x0=3.16e-4, x1=3.16e-4}"]), throw=False)
    assert solution.result is Result.TOO_THIN, solution.message
