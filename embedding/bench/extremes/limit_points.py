"""Limit points, snap-through, and loads a ten-thousandth beside a bifurcation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from embedding.bench.extremes.cell import FAILED, RIGHT, TOLD, Cell, Numbers, last_scalars
from embedding.bench.extremes.tables import Table, clamped, metal, rubber, scene_of
from embedding.scene import Scene

if TYPE_CHECKING:
    from embedding.solving import Solution

MODULUS = 1e5
LIMIT = 2.0 * (7.0 ** (-1 / 6) - 7.0 ** (-7 / 6))
"""The largest pressure of a neo-Hookean membrane balloon over mu T / R, at the stretch 7^(1/6)."""
SNAP = {"first": 0.61599, "second": 0.28399}
"""Limit pressures of a clamped shallow cap with the rise parameter 5, over the classical pressure (Marguerre's
equations; B. Budiansky, Theory of Thin Elastic Shells (1960) 64)."""
NEAR = (0.99, 0.9999, 1.0001, 1.01)


def cells() -> list[Cell]:
    """A row for each structure, a column for each way to go."""
    return [*balloons(), *caps(), *columns()]


# -- the balloon


def balloons() -> list[Cell]:
    """Past the pressure that a balloon can take: it ends there, or follows the path to twice the size."""
    ends = {"stretch": 7.0 ** (1 / 6), "factor": LIMIT / 1.3}
    true = frozenset({"LIMIT_POINT"})
    return [
        Cell("limit_points", "balloon", "by pressure, past the limit", partial(_balloon, [{"control": "load"}]),
             lambda: ends, "Green and Adkins (1960)", tolerance=2e-2, answers=_with_factor, reasons=true,
             expected=FAILED),
        Cell("limit_points", "balloon", "by arc length, past the limit", partial(_balloon, [{}]),
             lambda: {"stretch": 7.0 ** (1 / 6), "factor": LIMIT / 1.3}, "Green and Adkins (1960)", tolerance=1e-5,
             answers=partial(_critical, "limit"), reasons=frozenset({"MAX_ARC"}), expected=FAILED, slow=True),
        Cell("limit_points", "balloon", "by arc length, to twice the size",
             partial(_balloon, [{"until": {"where": [0.1, 0.0, 0.0], "axis": "x", "value": 0.1}}]),
             lambda: {"stretch": 2.0, "factor": 2.0 * (2.0**-1 - 2.0**-7) / 1.3}, "Green and Adkins (1960)",
             tolerance=1e-5, answers=_with_factor),
        Cell("limit_points", "balloon", "by volume", partial(_balloon, [{"volume_ratio": 8.0, "steps": 6}]),
             lambda: {"stretch": 2.0, "pressure_difference": 2e2 * (2.0**-1 - 2.0**-7)}, "Green and Adkins (1960)",
             tolerance=1e-5),
    ]  # fmt: skip


def _balloon(path: list[Table]) -> Scene:
    return scene_of(
        "balloon", {"kind": "sphere", "radius": 0.1}, 1e-4, rubber(MODULUS), loads={"pressure_bottom": 1.3e2}, path=path
    )


def _with_factor(solution: Solution) -> Numbers:
    """Scalars of the last step and its load factor."""
    factor = solution.steps[-1].factor_mechanical if solution.steps else math.nan
    return {**last_scalars(solution), "factor": factor}


def _critical(kind: str, solution: Solution) -> Numbers:
    """Scalars of the first critical point of a kind, and its load factor."""
    found = next((point for point in solution.critical_points if point.kind == kind), None)
    return {} if found is None else {**found.scalars, "factor": found.factor_mechanical}


# -- the cap


def caps() -> list[Cell]:
    """A clamped shallow cap that snaps through: both limit points on the path, or the first one under load."""
    height = 25.0e-3 / (4.0 * math.sqrt(3.0 * (1.0 - 0.09)))
    until = {"where": [0.0, 0.0, 10.0], "axis": "z", "value": -2.0 * height}
    return [
        Cell("limit_points", "cap, snap-through", "by arc length, through it",
             partial(_cap, height, [{"until": until}]), lambda: SNAP, "Marguerre's equations", tolerance=1e-3,
             answers=_turns, slow=True),
        Cell("limit_points", "cap, snap-through", "by pressure, past the limit",
             partial(_cap, height, [{"control": "load"}]), lambda: {"factor": SNAP["first"]}, "Marguerre's equations",
             tolerance=2e-2, answers=_with_factor, reasons=frozenset({"LIMIT_POINT"}), expected=FAILED, slow=True),
        Cell("limit_points", "cap, snap-through", "by arc length, to the load behind it",
             partial(_cap, height, [{}]), lambda: SNAP, "Marguerre's equations", tolerance=1e-3, answers=_turns),
    ]  # fmt: skip


def _cap(height: float, path: list[Table]) -> Scene:
    classical = 2.0 * 200e9 * (1e-3 / 10.0) ** 2 / math.sqrt(3.0 * (1.0 - 0.09))
    return scene_of(
        "cap", {"kind": "cap", "radius": 10.0, "half_angle": math.acos(1.0 - height / 10.0)}, 1e-3, metal(200e9, 0.3),
        supports=clamped("rim"), loads={"pressure_top": classical}, path=path,
    )  # fmt: skip


def _turns(solution: Solution) -> Numbers:
    """Load factors of the first two limit points."""
    found = [point.factor_mechanical for point in solution.critical_points if point.kind == "limit"]
    return dict(zip(("first", "second"), found, strict=False))


# -- the column


def columns() -> list[Cell]:
    """Euler's cantilever column near its load: straight, pushed aside a little, and buckled."""
    found = []
    for near in NEAR:
        modes = {"modes and one": 1.0 if near < 1.0 else 2.0} | ({"factor": 1.0 / near} if near > 1.0 else {})
        found.append(_column("column, straight", near, {}, partial(_same, modes), 1e-5, _modes))
        if near < 1.0:
            sensitive = TOLD if near > 0.999 else RIGHT
            aside = {"aside": 1e-8}
            known = partial(_beam_column, near)
            pushed = _column("column, pushed aside", near, aside, known, 1e-4, expected=sensitive)
            # what Euler's column leaves out, its strain P / EA, comes back 1 / (1 - near) times in the deflection
            found.append(replace(pushed, warnings=("limit point",)))
        else:
            leaves = {"path": [{"branch": {"number": 1, "amplitude": 5e-3}}]}
            sensitive = TOLD if near < 1.001 else RIGHT
            found.append(_column("column, buckled", near, leaves, partial(_elastica, near), 1e-4, expected=sensitive))
    return found


def _column(
    row: str, near: float, options: Table, reference: Callable[[], Mapping[str, float]], tolerance: float,
    answers: Callable[[Solution], Numbers] = last_scalars, expected: str = RIGHT,
) -> Cell:  # fmt: skip
    return Cell(
        "limit_points", row, f"{near:g} of Euler's load", partial(_loaded_column, near, **options), reference,
        "Euler's column", tolerance=tolerance, answers=answers, expected=expected,
        slow=not 0.999 < near < 1.001,
    )  # fmt: skip


def _loaded_column(near: float, aside: float = 0.0, path: list[Table] | None = None) -> Scene:
    ratio, youngs = 1e-3, 1e9
    critical = 0.25 * math.pi**2 * youngs * ratio**3 / 12.0
    force = [-near * critical, aside * critical, 0.0]
    return scene_of(
        "column", {"kind": "strip", "length": 1.0}, ratio, metal(youngs, 0.0), supports=clamped("x0"),
        loads={"edge_tractions": [{"edge": "x1", "traction": force}]}, path=path or [{}],
        model={"theory": "bending"}, output={"points": {"tip": [1.0, 0.0, 0.0]}},
    )  # fmt: skip


def _modes(solution: Solution) -> Numbers:
    """The unstable modes at the end, one added, and where the first bifurcation was passed."""
    return {"modes and one": 1.0 + last_scalars(solution)["unstable_modes"], **_critical("bifurcation", solution)}


def _same(numbers: Mapping[str, float]) -> Mapping[str, float]:
    return numbers


def _beam_column(near: float) -> Mapping[str, float]:
    """Tip of a cantilever under an axial force P and a lateral one H: (H/P) (tan(k L)/k - L), k^2 = P / EI; S.
    Timoshenko and J. Gere, Theory of Elastic Stability (1961), sec. 1.3."""
    k = 0.5 * math.pi * math.sqrt(near)
    return {"u_tip_y": 1e-8 / near * (math.tan(k) / k - 1.0)}


def _elastica(near: float) -> Mapping[str, float]:
    """|Tip| of the buckled cantilever: P / P_c = (2 K(k) / pi)^2, y = 2 k L / K(k); Timoshenko and Gere, sec. 2.7."""
    from scipy.optimize import brentq
    from scipy.special import ellipk

    k = brentq(lambda k: (2.0 * ellipk(k * k) / math.pi) ** 2 - near, 1e-9, 0.9, xtol=1e-15)
    return {"u_tip_y": 2.0 * k / float(ellipk(k * k))}
