"""Scenes that are followed by arc length: limit points, ends in displacement, stability, other controls and units."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import Result, Scene, SceneError, Solution, open_archive, solve
from embedding.scene.path import Until
from embedding.solving import run
from embedding.solving.driver import Run
from embedding.solving.places import displacement_row
from problems.exact.buckling import COLUMNS

pytestmark = pytest.mark.usefixtures("unestimated")

R, MU = 0.02, 1e5
SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": R},
    "thickness": 0.05 * R,
    "material": {"law": "neo-hookean", "shear_modulus": MU},
}
ACCURATE = {"order": 4, "shell_size": R / 8}
PRESSURE = {"pressure_bottom": 8e3}
PLENTY = 8e3 / (MU * 0.05)
"""Full pressure times R / (mu T)."""


def followed(**changes: Any) -> Solution:
    return run(Scene.from_table({"shell": SPHERE, "loads": PRESSURE, "discretisation": ACCURATE, **changes}))


def pole(stretch: float, radius: float = R) -> dict[str, Any]:
    return {"where": [0.0, 0.0, radius], "axis": "z", "value": (stretch - 1) * radius}


def test_a_balloon_passes_its_limit_point() -> None:
    """Neo-Hooke: p R / (mu T) = 2 (l^-1 - l^-7), with its maximum 1.23946290240 at l = 7^(1/6) (Green and Adkins)."""
    solution = followed(path=[{"until": pole(3.0)}])
    assert solution.result is Result.CONVERGED, solution.message
    (limit,) = solution.critical_points
    assert limit.kind == "limit" and limit.unstable == (0, 1)
    assert limit.scalars["stretch"] == pytest.approx(7 ** (1 / 6), abs=1e-6)
    assert PLENTY * limit.factor_mechanical == pytest.approx(1.23946290240, abs=1e-8)
    for step in solution.steps:
        stretch = step.scalars["stretch"]
        assert PLENTY * step.factor_mechanical == pytest.approx(2 * (1 / stretch - stretch**-7), abs=1e-6)
        assert step.stable is (stretch < 7 ** (1 / 6))
    before, behind = solution.steps[limit.before_step - 2], solution.steps[limit.before_step - 1]
    assert before.scalars["stretch"] < limit.scalars["stretch"] < behind.scalars["stretch"]
    assert solution["stretch"][-1] == pytest.approx(3.0, abs=1e-6)
    assert solution.iterations <= 40


def test_both_limit_points_of_a_mooney_rivlin_balloon() -> None:
    """c2 / c1 = 0.1: roots of dp/dl = 0 of the membrane's closed form; unstable between them."""
    material = {"law": "mooney-rivlin", "c1": MU / 2.2, "c2": MU / 22}
    solution = followed(shell={**SPHERE, "material": material}, path=[{"until": pole(4.0)}])
    maximum, minimum = solution.critical_points
    # The table's loads are in units of 2 c1 = mu / 1.1.
    expected = [(1.47606984746, 1.35510686880), (3.14262133321, 1.14874772529)]
    for point, (stretch, load) in zip((maximum, minimum), expected, strict=True):
        assert point.scalars["stretch"] == pytest.approx(stretch, abs=1e-6)
        assert PLENTY * point.factor_mechanical == pytest.approx(load, abs=1e-7)
    assert (maximum.unstable, minimum.unstable) == ((0, 1), (1, 0))


def test_a_load_before_the_limit_is_met_exactly() -> None:
    solution = followed(loads={"pressure_bottom": 1.2 * MU * 0.05})
    assert solution.result is Result.CONVERGED and solution.critical_points == ()
    assert solution.steps[-1].factor_mechanical == 1.0
    stretch = solution["stretch"][-1]
    assert stretch < 7 ** (1 / 6)
    assert 2 * (1 / stretch - stretch**-7) == pytest.approx(1.2, abs=1e-8)


def test_a_load_that_is_never_reached() -> None:
    """The balloon grows until the path is long enough; the message says what was passed."""
    solution = followed(solver={"max_arc": 3.0}, discretisation={})
    assert solution.result is Result.MAX_ARC
    assert "passed a limit point at mechanical 0.7746" in solution.message
    assert 4.0 < solution["stretch"][-1] < 6.0
    short = followed(solver={"max_steps": 3}, discretisation={})
    assert short.result is Result.MAX_STEPS and len(short.steps) == 3


@pytest.mark.parametrize(("length", "stress"), [(1e-3, 1.0), (1e3, 1e6)])
def test_steps_do_not_depend_on_units(length: float, stress: float) -> None:
    """The same balloon a thousand times smaller or larger, softer or stiffer: the same steps."""
    scaled = {
        "shape": {"kind": "sphere", "radius": R * length},
        "thickness": 0.05 * R * length,
        "material": {"law": "neo-hookean", "shear_modulus": MU * stress},
    }
    loads = {"pressure_bottom": 8e3 * stress}
    ends = ([{"until": pole(2.0)}], [{"until": pole(2.0, R * length)}])
    plain = followed(path=ends[0], discretisation={})
    other = followed(shell=scaled, loads=loads, path=ends[1], discretisation={})
    assert other["stretch"] == pytest.approx(plain["stretch"], rel=1e-9)
    assert [len(s.iterations) for s in other.steps] == [len(s.iterations) for s in plain.steps]


def test_steps_may_be_bounded() -> None:
    path = [{"steps": 20, "control": "arc-length"}]
    solution = followed(path=path, loads={"pressure_bottom": 5e3}, discretisation={})
    factors = [0.0, *(step.factor_mechanical for step in solution.steps)]
    assert factors[-1] == 1.0
    assert max(b - a for a, b in zip(factors, factors[1:], strict=False)) < 1.5 / 20


def test_displacement_control_meets_every_part() -> None:
    """Four equal parts; the limit point between two of them is found on the way."""
    stage = {"control": "displacement", "steps": 4, "until": pole(2.0)}
    solution = followed(path=[stage], discretisation={})
    stretches = solution["stretch"]
    for wanted in (1.25, 1.5, 1.75, 2.0):
        assert min(abs(stretches - wanted)) < 1e-4
    assert [point.kind for point in solution.critical_points] == ["limit"]


@pytest.mark.estimated
@pytest.mark.parametrize("control", ["auto", "displacement"])
def test_an_end_that_is_where_the_stage_begins_is_one_step(control: str) -> None:
    """At rest, without load, and with an error estimate; behind another stage, the state that one ended in."""
    stage = {"control": control, "until": pole(1.0)}
    solution = followed(path=[stage], discretisation={})
    assert solution.result is Result.CONVERGED and solution.error is not None
    (step,) = solution.steps
    assert step.factor_mechanical == pytest.approx(0.0, abs=1e-12)
    assert step.scalars["stretch"] == pytest.approx(1.0, abs=1e-12)
    again = followed(path=[{"name": "out", "until": pole(1.5)}, {"until": pole(1.5)}])
    assert [step.stage for step in again.steps].count("load") == 1
    assert again.steps[-1].scalars["stretch"] == pytest.approx(1.5, abs=1e-6)


def test_down_the_falling_branch_and_by_volume() -> None:
    """From a stretch of 2 on to a lower pressure: larger still, on the unstable branch."""
    path = [{"until": pole(2.0)}, {"mechanical": 0.5}]
    solution = followed(path=path, discretisation={})
    stretch = solution["stretch"][-1]
    assert stretch > 2.0 and not solution.steps[-1].stable
    assert 2 * (1 / stretch - stretch**-7) == pytest.approx(0.5 * PLENTY, abs=1e-5)


def test_a_flat_membrane_starts_from_rest() -> None:
    """A circular membrane under pressure: P = p A / (mu T) has its maximum 1.8791734688 at the apex stretch 2.19594
    (Adkins and Rivlin 1952, by integration of the equilibrium equations)."""
    disc = {**SPHERE, "shape": {"kind": "disc", "radius": R}, "thickness": 0.01 * R}
    held = [{"where": "rim", "fix": ["x", "y", "z"]}]
    end = {"where": [0.0, 0.0, 0.0], "axis": "z", "value": 1.4 * R}
    loads = {"pressure_bottom": 2 * MU * 0.01}
    solution = followed(
        shell=disc, supports=held, loads=loads, path=[{"until": end}], discretisation={"order": 4, "shell_size": R / 16}
    )
    assert solution.result is Result.CONVERGED, solution.message
    (limit,) = solution.critical_points
    assert 2 * limit.factor_mechanical == pytest.approx(1.8791734688, abs=1e-6)
    assert solution.steps[-1].stable is None  # pressure on an open shell: no potential is used


def test_a_pull_in_is_passed() -> None:
    """Voltage as the parameter, followed through its maximum inside a grounded sphere of twice the radius."""
    electrodes = {"top": {"voltage": 4e5}, "bottom": {"voltage": 4e5}}
    surroundings = {"field": "electric", "outer": "grounded", "radius": 2 * R}
    path = [{"control": "arc-length", "until": pole(1.35)}]
    solution = followed(ambient=surroundings, faces=electrodes, loads={}, path=path, discretisation={})
    (limit,) = (point for point in solution.critical_points if point.kind == "limit")
    # So near a ground the sphere may leave its shape (P_2) at next to the same voltage, where a bifurcation is found.
    counts = [point.unstable for point in solution.critical_points]
    assert counts == [(number, number + 1) for number in range(len(counts))]
    assert limit.scalars["stretch"] == pytest.approx(1.24062, abs=5e-3)  # membrane; of second order in T/R = 0.05


def test_an_end_in_displacement_is_where_the_shell_is() -> None:
    stage = {"until": {"where": [0.0, 0.0, 2 * R], "axis": "z", "value": R}}
    with pytest.raises(SceneError, match="away from the mid-surface"):
        followed(path=[stage])


def test_a_point_that_does_not_get_there_is_told() -> None:
    """A balloon that grows never brings its pole inwards."""
    solution = followed(path=[{"until": pole(0.9)}], solver={"max_steps": 3}, discretisation={})
    assert solution.result is Result.MAX_STEPS
    told = re.search(r"the point of until is at (\S+) m along z, of -0.002 m asked for", solution.message)
    assert told is not None
    assert float(told[1]) == pytest.approx((solution["stretch"][-1] - 1) * R, rel=1e-2)


@pytest.mark.parametrize(("where", "axis"), [([0.0, 0.0, 0.0], "y"), ([0.0, 0.0, 0.0], "x")])
def test_a_point_that_is_held_goes_nowhere(where: list[float], axis: str) -> None:
    stage = column(None).path[0].model_copy(update={"until": Until(where=where, axis=axis, value=0.1)})  # type: ignore[arg-type]
    with pytest.raises(SceneError, match=f"path.0.until: not allowed: a support or a symmetry .* along {axis}"):
        run(column(None).model_copy(update={"path": (stage,)}))


def test_given_displacements_are_followed() -> None:
    """A sheet pulled to twice its length between sides that may narrow: no other unknown load than the sides' own."""
    sheet = {**SPHERE, "shape": {"kind": "plate", "length": R, "width": R}}
    supports = [
        {"where": "x0", "fix": ["x"]},
        {"where": "y0", "fix": ["y"]},
        {"where": "surface", "fix": ["z"]},
        {"where": "x1", "fix": ["x"], "displacement": [R, 0.0, 0.0]},
    ]
    solution = followed(shell=sheet, supports=supports, loads={}, discretisation={})
    assert solution.result is Result.CONVERGED, solution.message
    assert solution["stretch_max"][-1] == pytest.approx(2.0, rel=1e-9)
    assert solution["stretch_min"][-1] == pytest.approx(2**-0.5, rel=1e-9)  # uniaxial, incompressible


def test_critical_points_are_archived(tmp_path: Path) -> None:
    scene = Scene.from_table({"shell": SPHERE, "loads": PRESSURE, "path": [{"until": pole(1.6)}]})
    solution = solve(scene, archive=tmp_path / "run.vtkhdf")
    (kept,), (limit,) = open_archive(tmp_path / "run.vtkhdf").critical_points, solution.critical_points
    assert kept.mode.tolist() == limit.mode.tolist()
    assert (kept.kind, kept.unstable, kept.scalars) == (limit.kind, limit.unstable, limit.scalars)
    assert [step.stable for step in open_archive(tmp_path / "run.vtkhdf").steps] == [s.stable for s in solution.steps]


def column(branch: dict[str, Any] | None, *, length: float = 1.0, thickness: float = 0.01) -> Scene:
    """A strip clamped at one end, compressed at the other by one and a half times Euler's load."""
    euler = COLUMNS["clamped-free"] * 1e9 * thickness**3 / 12 / length**2
    return Scene.from_table(
        {
            "shell": {
                "shape": {"kind": "strip", "length": length},
                "thickness": thickness,
                "material": {"law": "st-venant-kirchhoff", "youngs_modulus": 1e9, "poisson_ratio": 0.0},
            },
            "supports": [{"where": "x0", "kind": "clamped"}],
            "loads": {"edge_tractions": [{"edge": "x1", "traction": [-1.5 * euler, 0.0, 0.0]}]},
            "path": [{"branch": branch} if branch else {}],
        }
    )


def test_the_load_of_a_column() -> None:
    """Euler's load, but for the column's own shortening by P / (E T), 2.1e-5, and its square."""
    solution = run(column(None))
    (found,) = solution.critical_points
    shortening = COLUMNS["clamped-free"] * 0.01**2 / 12
    assert found.kind == "bifurcation" and found.unstable == (0, 1)
    assert 1.5 * found.factor_mechanical == pytest.approx(1 + shortening, abs=1e-6)
    assert solution.result is Result.CONVERGED and not solution.steps[-1].stable


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_onto_the_bent_branch_of_a_column(side: float) -> None:
    """The elastica at P = 1.5 Euler loads, K(k) = pi/2 sqrt(1.5) with k = sin(alpha/2): tip 2 k / (K) aside, and
    2 E(k) / K - 1 along (Timoshenko and Gere, sec. 2.7)."""
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk

    made = Run(column({"amplitude": side * 1e-2}), [])
    solution = made.solve()
    assert solution.result is Result.CONVERGED, solution.message
    assert all(step.stable for step in solution.steps)
    quarter = math.pi / 2 * math.sqrt(1.5)
    m = brentq(lambda m: ellipk(m) - quarter, 0.1, 0.99)
    u = np.array(made.problem.system.unknowns.field("u").vec.FV().NumPy())
    tip = [displacement_row(made.problem, Until(where=(1.0, 0.0, 0.0), axis=axis, value=0.0), 0) @ u for axis in "xy"]
    # The elastica does not stretch; the strip does by 3e-5, and has order 3 on five elements.
    assert tip[0] == pytest.approx(2 * ellipe(m) / quarter - 2, abs=2e-4)
    assert abs(tip[1]) == pytest.approx(2 * math.sqrt(m) / quarter, abs=2e-4)
    mode = solution.critical_points[0].mode
    assert np.sign(tip[1]) == side * np.sign(mode[np.argmax(np.abs(mode))])


@pytest.mark.estimated
@pytest.mark.parametrize(("part", "number", "met"), [(0.5, 1, 0), (1.0, 7, 1), (1.0, 1, 1)])
def test_a_branch_that_is_not_met_is_told(part: float, number: int, met: int) -> None:
    """Below Euler's load a column has none, up to one and a half times that one: 9 Euler loads is the next."""
    straight = column({"number": number})
    stages = (straight.path[0].model_copy(update={"mechanical": part}),)
    solution = run(straight.model_copy(update={"path": stages}))
    assert solution.result is Result.CONVERGED
    (check,) = (one for one in solution.health if one.topic == "branch")
    assert check.value == met
    assert check.good is (number == met)
    assert (solution["displacement"][-1] > 0.1) == check.good
    assert ("not on that branch" in check.sentence) is not check.good


def test_switching_needs_a_way_off() -> None:
    with pytest.raises(Exception, match="must not be 0"):
        column({"amplitude": 0.0})
