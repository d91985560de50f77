"""Inflated balloon: limit points, volume and pressure control, axisymmetric and in three dimensions.

The accuracy of the limit points is that of the discretisation (below 1e-8 of p R / (mu T) for the axisymmetric scene,
3e-7 for the one in three dimensions) and of the spline through the steps, see `test_how_well_limit_points_are_located`.
"""

from __future__ import annotations

from functools import cache

import pytest

from embedding import Listener, Result, Solution, SolveError, solve
from embedding.solving.events import StepRecord
from embedding.solving.state import State
from problems import sphere_inflation
from problems.exact import sphere
from tests.problems.measures import orders

LIMIT_STRETCH, LIMIT_LOAD = 7.0 ** (1.0 / 6.0), 1.23946290240
RATIOS = (0.1, 0.05, 0.01)
# c2 / c1 = 0.1, shear modulus 110 kPa: stiff enough at large stretches for a minimum behind the maximum.
MOONEY_RIVLIN = "shell.material={law = 'mooney-rivlin', c1 = '50 kPa', c2 = '5 kPa'}"
SHORT = "path=[{volume_ratio = 2.197, steps = 4}, {volume_ratio = 3.375, steps = 12}, {volume_ratio = 125, steps = 8}]"
TOO_MUCH = ("loads.pressure_bottom=1650 Pa", "path=[{steps = 6}]", "solver.min_step=1e-3")  # 1.33 limit loads
SOLID = ("model.reduction=3d", "discretisation.shell_size=6 mm")


@cache
def to_the_end(*changes: str) -> Solution:
    return sphere_inflation.run(*changes)


def test_limit_point_and_far_beyond() -> None:
    solution = to_the_end()
    (found,) = sphere_inflation.limit_points(solution)
    assert found.stretch == pytest.approx(LIMIT_STRETCH, abs=1e-6)
    assert found.load == pytest.approx(LIMIT_LOAD, abs=1e-6)
    assert solution["stretch"][-1] == pytest.approx(5.0, abs=1e-9)
    assert sphere_inflation.error(solution) < 1e-8


def test_mooney_rivlin_has_a_maximum_and_a_minimum() -> None:
    solution = to_the_end(MOONEY_RIVLIN)
    maximum, minimum = sphere_inflation.limit_points(solution)
    assert maximum == pytest.approx((1.47606984746, 1.35510686880), abs=1e-6)
    assert minimum == pytest.approx((3.14262133321, 1.14874772529), abs=1e-5)
    exact = sphere_inflation.reference_limit_points(solution.scene)
    assert exact[0] == pytest.approx((1.47606984746, 1.35510686880), abs=1e-10)
    assert exact[1] == pytest.approx((3.14262133321, 1.14874772529), abs=1e-10)
    assert sphere_inflation.error(solution) < 1e-8


@pytest.mark.parametrize(("law", "places"), [(None, (5e-8,)), (MOONEY_RIVLIN, (5e-7, 5e-6))])
def test_how_well_limit_points_are_located(law: str | None, places: tuple[float, ...]) -> None:
    """The spline through exact pressures at the computed stretches: what is left is its own error."""
    solution = to_the_end(*([law] if law else []))
    found = sphere_inflation.extrema(solution["stretch"], sphere_inflation.reference(solution))
    known = sphere_inflation.reference_limit_points(solution.scene)
    for point, exact, place in zip(found, known, places, strict=True):
        assert point.stretch == pytest.approx(exact.stretch, abs=place)
        assert point.load == pytest.approx(exact.load, abs=1e-8)


def test_axisymmetric_and_solid_agree() -> None:
    """The octant in three dimensions: the same steps, the same limit point."""
    flat, octant = sphere_inflation.run(SHORT), sphere_inflation.run(SHORT, *SOLID)
    assert octant["stretch"] == pytest.approx(flat["stretch"], abs=1e-5)
    assert sphere_inflation.pressures(octant) == pytest.approx(sphere_inflation.pressures(flat), abs=1e-5)
    for solution in (flat, octant):
        found = sphere_inflation.limit_points(solution)[0]
        assert found == pytest.approx((LIMIT_STRETCH, LIMIT_LOAD), abs=1e-5)
        assert solution["stretch"][-1] == pytest.approx(5.0, abs=1e-7)


def test_the_whole_sphere_floats_freely() -> None:
    """Without mirror planes, six rigid motions are held by nothing but themselves."""
    whole = ("model.reduction=3d", "model.symmetry=none", "discretisation.shell_size=12 mm")
    solution = sphere_inflation.run(*whole, "path=[{volume_ratio = 4, steps = 3}]")
    assert sphere_inflation.error(solution) < 1e-5


@pytest.mark.parametrize(
    ("reduction", "order", "sizes", "expected"),
    [
        ("axisymmetric", 2, (8.0, 4.0, 2.0), 4.0),
        ("axisymmetric", 3, (8.0, 4.0, 2.0), 4.0),
        ("axisymmetric", 4, (8.0, 4.0, 2.0), 6.0),
        ("3d", 2, (8.0, 4.0), 4.0),
        ("3d", 3, (8.0, 4.0), 4.0),
    ],
)
def test_convergence_with_the_mesh(reduction: str, order: int, sizes: tuple[float, ...], expected: float) -> None:
    """At even orders twice the order of the elements; at odd ones the curved geometry is the limit."""
    errors, unknowns = [], []
    for size in sizes:
        mesh = (f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
        path = "path=[{volume_ratio = 2.6457, steps = 2}]"
        solution = sphere_inflation.run(f"model.reduction={reduction}", *mesh, path)
        errors.append(sphere_inflation.error(solution))
        unknowns.append(solution.cost.unknowns["u"] ** (-1.0 if reduction == "axisymmetric" else -0.5))
    assert min(orders(unknowns, errors)) > expected - 0.3


def test_second_order_in_the_thickness() -> None:
    """Limit stretch and limit load against the exact thick sphere."""
    places, loads = [], []
    for ratio in RATIOS:
        solution = sphere_inflation.run(f"shell.thickness={0.02 * ratio!r}", SHORT)
        (found,) = sphere_inflation.limit_points(solution)
        (exact,) = sphere_inflation.reference_limit_points(solution.scene, "thick")
        places.append(abs(found.stretch - exact.stretch))
        loads.append(abs(found.load - exact.load))
    assert orders(RATIOS, places) == pytest.approx([2.0, 2.0], abs=0.02)
    assert orders(RATIOS, loads) == pytest.approx([2.0, 2.0], abs=0.02)


def test_pressure_control_below_the_limit() -> None:
    """Second order against the thick sphere also at prescribed pressure; p_t = 20 kPa outside."""
    errors = []
    for ratio in RATIOS:
        difference = 1.0e5 * ratio  # 0.81 of the limit load
        pressures = ("loads.pressure_top=20e3", f"loads.pressure_bottom={20e3 + difference!r}")
        solution = sphere_inflation.run(f"shell.thickness={0.02 * ratio!r}", *pressures, "path=[{steps = 5}]")
        errors.append(abs(float(solution["stretch"][-1]) - sphere.stretch_at(ratio, ratio)))
        assert solution["stretch"][-1] == pytest.approx(sphere.stretch_at(ratio, ratio, None, "membrane"), abs=1e-7)
    assert orders(RATIOS, errors) == pytest.approx([2.0, 2.0], abs=0.02)


class LastGood(Listener):
    """What the solver last reported as accepted, and what it reported as cut."""

    def __init__(self) -> None:
        self.record: StepRecord | None = None
        self.cuts: list[str] = []

    def accepted(self, state: State, record: StepRecord) -> None:
        self.record = record

    def cut(self, step_number: int, fraction: float, reason: str) -> None:
        self.cuts.append(reason)


@pytest.mark.estimated
@pytest.mark.parametrize(
    ("changes", "limit"),
    [
        ((), (LIMIT_STRETCH, LIMIT_LOAD)),
        ((MOONEY_RIVLIN,), (1.47606984746, 1.35510686880)),
        (("model.reduction=3d", "discretisation.shell_size=12 mm"), (LIMIT_STRETCH, LIMIT_LOAD)),
    ],
)
def test_pressure_control_past_the_limit_fails(changes: tuple[str, ...], limit: tuple[float, float]) -> None:
    """A typed failure with reason, advice and every step up to just before the limit, as a value."""
    seen = LastGood()
    solution = solve(sphere_inflation.scene(*changes, *TOO_MUCH), throw=False, listeners=[seen])
    assert solution.result is Result.LIMIT_POINT
    assert not solution.result.ok
    assert solution.result.advice in solution.message
    assert "limit point under the prescribed loads" in solution.message
    assert "volume_ratio" in solution.message
    assert solution.error is None
    assert seen.cuts and seen.record == solution.steps[-1]
    assert f"mechanical {solution.steps[-1].factor_mechanical:.4g}" in solution.message
    # Steps are halved down to 1e-3 of the planned ones, so that is how close to the limit the last good one is.
    nearest = 2 * 1e-3 * 1.65 / 6
    assert limit[1] - nearest < sphere_inflation.pressures(solution)[-1] < limit[1] + 1e-5
    assert limit[0] - 0.02 < solution["stretch"][-1] < limit[0]
    assert sphere_inflation.error(solution) < (1e-5 if "model.reduction=3d" in changes else 1e-8)


def test_the_failure_is_raised_unless_asked_for_as_a_value() -> None:
    with pytest.raises(SolveError, match="limit point under the prescribed loads") as raised:
        sphere_inflation.run(*TOO_MUCH)
    solution = raised.value.solution
    assert solution.result is Result.LIMIT_POINT
    assert 1.3 < solution["stretch"][-1] < LIMIT_STRETCH


def test_volume_control_goes_on_where_pressure_control_cannot() -> None:
    """Pressure up, volume over the limit and back, pressure down: always the same curve."""
    path = (
        "path=[{steps = 5}, {volume_ratio = 8, steps = 20}, {volume_ratio = 2.2, steps = 3},"
        " {mechanical = 0.5, steps = 3}]"
    )
    solution = sphere_inflation.run("loads.pressure_bottom=1 kPa", path)
    loads = sphere_inflation.pressures(solution)
    assert loads[4] == pytest.approx(1.0, abs=1e-12)
    assert loads.max() > 1.23
    assert solution["stretch"][24] == pytest.approx(2.0, abs=1e-9)
    assert loads[-1] == pytest.approx(0.5, abs=1e-12)
    assert sphere_inflation.error(solution) < 1e-8
