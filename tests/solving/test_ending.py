"""Errors where a path ends at a displacement: of the load that it takes, against exact spheres and membranes."""

from __future__ import annotations

import pytest

from embedding import Scene, Solution, load_scene, solve
from problems import charged_balloon, circular_membrane, membrane_pull_in, slit_annulus
from problems.common import law_of, thickness_ratio
from problems.exact import circular_membrane as exact_membrane

RADIUS, GROWN = 20e-3, 1.3
SIZED = f"path=[{{until={{where=[0, 0, {RADIUS}], axis='z', value={RADIUS * (GROWN - 1.0)}}}}}]"
COARSE, FINE = 0.3 * RADIUS, 0.15 * RADIUS


def balloon(thickness: float, order: int, size: float) -> Solution:
    meshed = f"discretisation.order={order}", f"discretisation.shell_size={size}"
    return solve(charged_balloon.scene(SIZED, f"shell.thickness={thickness}", *meshed))


@pytest.mark.parametrize("thickness", [0.1 * RADIUS, 0.02 * RADIUS])
@pytest.mark.parametrize(("order", "size"), [(2, COARSE), (2, FINE), (3, COARSE)])
def test_the_voltage_of_a_balloon_of_a_given_size(thickness: float, order: int, size: float) -> None:
    solution = balloon(thickness, order, size)
    known = charged_balloon.exact(solution.scene).voltage(GROWN)
    error, stated = solution.steps[-1].scalars["voltage"] / known - 1.0, solution.errors["voltage"]
    assert 0.9 < stated.value / abs(error) < 2.0
    assert solution.error is not None and solution.error.quantity == "voltage"


@pytest.mark.parametrize("height", [0.03, 0.1488846433310154])
@pytest.mark.parametrize(("order", "size"), [(1, 0.01), (2, 0.02), (2, 0.01), (3, 0.02)])
def test_the_pressure_of_a_membrane_of_a_given_height(height: float, order: int, size: float) -> None:
    """Before and beyond its limit point, where less pressure makes it higher."""
    meshed = f"discretisation.order={order}", f"discretisation.shell_size={size}"
    solution = solve(load_scene(circular_membrane.SCENE, (f"path.0.until.value={height}", *meshed)))
    law, ratio = law_of(solution.scene), thickness_ratio(solution.scene)
    known = exact_membrane.at_deflection(height / circular_membrane.RADIUS, law).pressure * law.shear_modulus * ratio
    error, stated = solution.steps[-1].scalars["pressure_difference"] / known - 1.0, solution.errors
    assert 0.9 < stated["pressure_difference"].value / abs(error) < 1.1
    assert solution.error is not None and solution.error.quantity == "pressure_difference"


def test_an_accuracy_is_that_of_the_load() -> None:
    solution = solve(charged_balloon.scene(SIZED, "shell.thickness=1 mm", "accuracy=1e-3"))
    known = charged_balloon.exact(solution.scene).voltage(GROWN)
    assert len(solution.attempts) > 1 and solution.error is not None
    assert solution.error.value < 1e-3
    assert abs(solution.steps[-1].scalars["voltage"] / known - 1.0) < 1.25 * solution.error.value


PULLED = "path.1.until.value=-1e-3"
LIFTED = "path=[{until={where=[10, -1e-12, 0], axis='z', value=0.5}}]"


@pytest.mark.parametrize(
    ("scene", "answer"),
    [
        (membrane_pull_in.scene(membrane_pull_in.STRIP, PULLED), "voltage"),
        (load_scene(slit_annulus.SCENE, (LIFTED, "discretisation.order=2")), "elastic_energy"),
    ],
    ids=["a voltage after a stretch", "edge forces"],
)
def test_what_counts_as_the_answer(scene: Scene, answer: str) -> None:
    error = solve(scene).error
    assert error is not None and error.quantity == answer and error.value > 0.0
