"""Paths with a field by arc length: pull-in, pressure limits at a voltage, the way back, hysteresis; closed forms of
the charged membrane, E = V R_o / (b (R_o - b)) on a sphere of radius b."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from embedding import Result, Scene, Solution
from embedding.scene.scales import EPSILON_0
from embedding.solving import run
from embedding.solving.hysteresis import loops, traced
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.material import mooney_rivlin, neo_hookean

R, T, MU = 0.02, 0.001, 3e4
SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": R},
    "thickness": T,
    "material": {"law": "neo-hookean", "shear_modulus": MU},
}
COARSE: dict[str, Any] = {}
FINE = {"order": 4}


def voltage_of(w: float) -> float:
    """w = eps V^2 / (4 mu T R)."""
    return math.sqrt(w * 4 * MU * T * R / EPSILON_0)


def balloon(outer: float = math.inf, law: Any = None) -> ChargedBalloon:
    return ChargedBalloon(R, T, law or neo_hookean(MU), EPSILON_0, outer, "membrane")


def charged(voltage: float, path: list[dict[str, Any]], ground: float | None = None, **changes: Any) -> Solution:
    """A balloon with its field at the mid-surface, as in the closed forms."""
    outer = {"outer": "grounded", "radius": ground} if ground else {}
    return run(
        Scene.from_table(
            {
                "shell": SPHERE,
                "ambient": {"field": "electric", **outer},
                "faces": {"top": {"voltage": voltage}, "bottom": {"voltage": voltage}},
                "model": {"interface": "closed"},
                "path": path,
                **changes,
            }
        )
    )


def at_pole(stretch: float, **changes: Any) -> dict[str, Any]:
    return {"until": {"where": [0.0, 0.0, R], "axis": "z", "value": (stretch - 1) * R}, **changes}


@pytest.mark.parametrize(("mesh", "tolerance"), [(COARSE, 1e-4), (FINE, 1e-6)])
def test_pull_in_inside_a_grounded_sphere(mesh: dict[str, Any], tolerance: float) -> None:
    """w = (l - l^-5) (1 - l / 4)^2 has its maximum 0.541797260201 at l = 1.61644100288: followed by voltage, out of
    rest and without a field, over the maximum and on as the voltage falls."""
    full = 4e5
    solution = charged(full, [at_pole(1.7)], 4 * R, discretisation=mesh)
    assert solution.result is Result.CONVERGED, solution.message
    (limit,) = solution.critical_points
    assert (limit.kind, limit.unstable) == ("limit", (0, 1))
    assert limit.scalars["stretch"] == pytest.approx(1.61644100288, abs=tolerance)
    assert limit.factor_field * full == pytest.approx(voltage_of(0.541797260201), rel=tolerance)
    assert limit.scalars["voltage"] == pytest.approx(limit.factor_field * full, rel=1e-9)
    for step in solution.steps:
        stretch = step.scalars["stretch"]
        w = (stretch - stretch**-5) * (1 - stretch / 4) ** 2
        assert step.factor_field * full == pytest.approx(voltage_of(w), rel=tolerance)
        assert step.stable is (stretch < 1.6164)
    assert solution.iterations <= 35


def test_far_beyond_pull_in() -> None:
    """Half a gap further the sphere has become unstable in other shapes, too, and is followed all the same."""
    solution = charged(4e5, [at_pole(2.5)], 4 * R)
    assert solution.result is Result.CONVERGED, solution.message
    limit, *others = solution.critical_points
    assert limit.kind == "limit"
    assert [point.kind for point in others] == ["bifurcation"] * len(others)
    stretch, unstable = solution["stretch"][-1], solution["unstable_modes"]
    w = (stretch - stretch**-5) * (1 - stretch / 4) ** 2
    assert solution["voltage"][-1] == pytest.approx(voltage_of(w), rel=1e-3)
    assert unstable[-1] == 1 + len(others) and all(np.diff(unstable) >= 0)


@pytest.mark.parametrize(("mesh", "tolerance"), [(COARSE, 1e-4), (FINE, 2e-6)])
def test_pressure_at_a_voltage(mesh: dict[str, Any], tolerance: float) -> None:
    """At w = 0.3 the pressure P = p R / (2 mu T) has its maximum 0.474823005576 at the stretch 1.50539895499."""
    pressure = 2 * MU * T / R
    solution = charged(
        voltage_of(0.3),
        [{"mechanical": 0.0}, at_pole(1.8)],
        loads={"pressure_bottom": 0.6 * pressure},
        discretisation=mesh,
    )
    assert solution.result is Result.CONVERGED, solution.message
    (limit,) = solution.critical_points
    assert (limit.kind, limit.unstable, limit.factor_field) == ("limit", (0, 1), 1.0)
    assert limit.scalars["stretch"] == pytest.approx(1.50539895499, abs=tolerance)
    assert 0.6 * limit.factor_mechanical == pytest.approx(0.474823005576, abs=tolerance)
    charging = [step for step in solution.steps if step.factor_mechanical == 0.0]
    assert len(charging) > 1 and all(step.stable for step in charging)


def test_in_free_space_the_voltage_has_no_limit() -> None:
    """w = l - l^-5 grows for ever: w(1.2) = 0.798122427984, and every state is stable."""
    solution = charged(voltage_of(0.798122427984), [{}], discretisation=FINE)
    assert solution.result is Result.CONVERGED and solution.critical_points == ()
    assert solution["stretch"][-1] == pytest.approx(1.2, abs=1e-6)
    assert all(step.stable for step in solution.steps)
    factors = [step.factor_field for step in solution.steps]
    assert factors == sorted(factors) and factors[-1] == 1.0


def test_release() -> None:
    """The voltage is taken away again, to rest, on the same path."""
    solution = charged(voltage_of(0.4), [{"name": "on"}, {"name": "off", "field": 0.0}], 4 * R)
    assert solution.result is Result.CONVERGED, solution.message
    assert solution.steps[-1].factor_field == 0.0
    assert solution["stretch"][-1] == pytest.approx(1.0, abs=1e-6)
    for step in solution.steps:
        stretch = step.scalars["stretch"]
        w = (stretch - stretch**-5) * (1 - stretch / 4) ** 2
        assert 0.4 * step.factor_field**2 == pytest.approx(w, abs=1e-4)


def test_back_to_no_field() -> None:
    """Under a pressure close to its own limit the voltage has one, too; beyond it the path ends where the pressure
    alone holds the larger of its two stretches, and the message says so."""
    pressure, full = 1.1 * MU * T / R, 4e5
    path = [{"field": 0.0}, {"name": "charging"}]
    solution = charged(full, path, loads={"pressure_bottom": pressure})
    assert solution.result is Result.FIELD_VANISHED
    (limit,) = solution.critical_points
    exact = balloon().pull_in(pressure)
    assert exact is not None
    assert limit.scalars["stretch"] == pytest.approx(exact.stretch, abs=1e-4)
    assert limit.factor_field * full == pytest.approx(exact.load, rel=1e-4)
    larger = brentq(lambda stretch: 2 * (1 / stretch - stretch**-7) - 1.1, 7 ** (1 / 6), 3.0)
    assert solution["stretch"][-1] == pytest.approx(larger, abs=1e-3)
    assert f"mechanical 1, field {limit.factor_field:.5g}" in solution.message


def test_hysteresis_of_a_charged_balloon() -> None:
    """A Mooney-Rivlin balloon at a fixed voltage has a largest and a least pressure: between them it is unstable, and a
    pressure that goes up and down jumps at either."""
    exact, voltage = balloon(law=mooney_rivlin(MU / 2.2, MU / 22)), voltage_of(0.3)
    material = {"law": "mooney-rivlin", "c1": MU / 2.2, "c2": MU / 22}
    full = 2 * MU * T / R
    solution = charged(
        voltage,
        [{"mechanical": 0.0}, at_pole(4.2, name="inflating")],
        shell={**SPHERE, "material": material},
        ambient={"field": "electric", "radius": 10 * R},
        loads={"pressure_bottom": full},
        discretisation=FINE,
    )
    assert solution.result is Result.CONVERGED, solution.message

    def slope(stretch: float) -> float:
        return (exact.pressure(stretch * (1 + 1e-6), voltage) - exact.pressure(stretch * (1 - 1e-6), voltage)) / full

    (loop,) = loops(solution)
    for point, bracket, unstable in ((loop.rising, (1.3, 2.2), (0, 1)), (loop.falling, (2.2, 4.0), (1, 0))):
        stretch = brentq(slope, *bracket)
        assert point.scalars["stretch"] == pytest.approx(stretch, abs=1e-4)
        assert loop.factor(point) * full == pytest.approx(exact.pressure(stretch, voltage), rel=1e-6)
        assert point.unstable == unstable
    between = (solution["stretch"] > loop.rising.scalars["stretch"]) & (
        solution["stretch"] < loop.falling.scalars["stretch"]
    )
    assert between.any() and np.array_equal(solution["unstable_modes"], between)

    curves = traced(solution, loop, "stretch")
    assert all(np.diff(curves.rising[:, 0]) >= 0) and all(np.diff(curves.falling[:, 0]) <= 0)
    for curve, point in ((curves.rising, loop.rising), (curves.falling, loop.falling)):
        (left, landed), jump = curve[curve[:, 0] == loop.factor(point)][:, 1], loop.factor(point)
        assert left == point.scalars["stretch"]
        assert abs(landed - left) > 0.3
        assert exact.pressure(landed, voltage) / full == pytest.approx(jump, abs=0.01)  # a chord between two steps
