"""Open tube with traction-free ends against the exact thick-walled one: second order in T/R in both stretches."""

from __future__ import annotations

import numpy as np
import pytest

from problems import open_tube
from problems.exact import open_tube as exact
from tests.problems.measures import LAWS, orders

RATIOS = (0.1, 0.05, 0.025)


def errors(*changes: str) -> tuple[list[float], list[float]]:
    """Errors of the hoop and of the axial stretch over the thicknesses."""
    rows = np.array([open_tube.error(open_tube.run(*changes, *open_tube.at_thickness(t))) for t in RATIOS])
    return list(map(float, rows[:, 0])), list(map(float, rows[:, 1]))


@pytest.mark.parametrize("law", LAWS)
def test_second_order_in_the_thickness(law: str) -> None:
    hoop, axial = errors(law)
    assert orders(RATIOS, hoop) == pytest.approx([2.0, 2.0], abs=0.02)
    assert orders(RATIOS, axial) == pytest.approx([2.0, 2.0], abs=0.02)


def test_numbers() -> None:
    """The pressures 0.32 and 0.30 mu at T/R = 0.05: the shell theory's numbers, and their distance from exact ones."""
    found = open_tube.stretches(open_tube.run())[-1]
    assert found == pytest.approx([1.12597148741, 1.02788434775], abs=2e-9)
    assert exact.exact_stretches(0.32, 0.30, 0.05) == pytest.approx([1.12584343758, 1.02785287441], abs=1e-11)


@pytest.mark.parametrize("variant", ["net", "as-published"])
def test_other_loads_do_not_converge(variant: str) -> None:
    """Without the mean pressure's work on the ends the tube does not know how long it becomes."""
    for row in errors(f"loads.variant={variant}"):
        assert max(map(abs, orders(RATIOS, row))) < 0.1
        assert row[-1] > 4e-3


def test_pressed_end_faces_leave_the_difference_alone() -> None:
    """The mean pressure all around is hydrostatic: what remains is the tube under half the difference on each face."""
    wrong = []
    for ratio in RATIOS:
        found = open_tube.stretches(open_tube.run("loads.rim=pressurised", *open_tube.at_thickness(ratio)))[-1]
        known = exact.exact_stretches(0.2 * ratio, -0.2 * ratio, ratio)
        wrong.append(float(np.abs(found - known).max()))
    assert orders(RATIOS, wrong) == pytest.approx([2.0, 2.0], abs=0.05)


@pytest.mark.parametrize(("order", "expected"), [(2, 4.0), (3, 4.0), (4, 6.0)])
def test_convergence_with_the_mesh(order: int, expected: float) -> None:
    """At even orders twice the order of the elements; at odd ones the curved geometry is the limit."""
    sizes, known = (8.0, 4.0, 2.0), exact.membrane_stretches(0.32, 0.30, 0.05)
    wrong = []
    for size in sizes:
        mesh = (f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
        wrong.append(float(np.abs(open_tube.stretches(open_tube.run(*mesh))[-1] - known).max()))
    assert orders(sizes, wrong) == pytest.approx([expected] * 2, abs=0.3)
