"""A shell that bends as an interface inside the field around it: the charged balloon once more."""

from __future__ import annotations

import pytest

from problems import charged_balloon
from tests.problems.measures import orders

BENDING = "model.theory=bending"
STEPS = "path=[{steps = 4}]"
RATIOS = (0.1, 0.05, 0.025)


def test_bending_of_a_charged_balloon() -> None:
    """Against the exact thick sphere, second order in the thickness like the membrane.

    It is no better than the membrane there: the faces lie at r +- (T/2) lambda n, right to first order, and what that
    leaves out is of the order of the bending terms.
    """
    errors = []
    for ratio in RATIOS:
        bent = charged_balloon.run(*charged_balloon.at(ratio, 1.2), STEPS, "discretisation.order=4", BENDING)
        errors.append(charged_balloon.error(bent))
    assert errors[0] < 6e-4
    assert orders(RATIOS, errors) == pytest.approx([2.0, 2.0], abs=0.2)


@pytest.mark.slow
def test_3d_is_axisymmetric() -> None:
    solid = charged_balloon.run(STEPS, BENDING, "model.reduction=3d", "discretisation.shell_size=10 mm")
    flat = charged_balloon.run(STEPS, BENDING)
    assert solid["stretch"] == pytest.approx(flat["stretch"], abs=1e-4)
    assert all(len(step.iterations) <= 10 for step in solid.steps)
