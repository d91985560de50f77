"""Balloon inside a grounded sphere of four times its radius: membrane formula, thick sphere, pull-in."""

from __future__ import annotations

import math

import pytest

from embedding import Result
from embedding.scene.scales import EPSILON_0
from problems import charged_balloon, grounded_balloon
from tests.problems.measures import orders

FINE = ("discretisation.order=4",)
STEPS = "path=[{steps = 4}]"


@pytest.mark.parametrize(("mesh", "tolerance"), [((), 1e-5), (FINE, 3e-7)])
def test_membrane_formula(mesh: tuple[str, ...], tolerance: float) -> None:
    """w = eps0 V^2 / (4 mu T R) = (l - l^-5) (1 - l R / R_o)^2 with the interface closed, w(1.2) = 0.39108."""
    w = 0.391079989712
    voltage = math.sqrt(w * 4.0 * 30e3 * 1e-3 * 0.02 / EPSILON_0)
    solution = grounded_balloon.run(*grounded_balloon.at_voltage(voltage), "model.interface=closed", STEPS, *mesh)
    assert solution["stretch"][-1] == pytest.approx(1.2, abs=tolerance)
    assert grounded_balloon.error(solution, "membrane") < tolerance


def test_opened_is_second_order_in_the_thickness() -> None:
    ratios, errors = (0.1, 0.05, 0.025), []
    for ratio in ratios:
        thickness = f"shell.thickness={20 * ratio!r} mm"
        shell = grounded_balloon.exact(grounded_balloon.scene(thickness))
        voltage = grounded_balloon.at_voltage(shell.voltage(1.2))
        errors.append(grounded_balloon.error(grounded_balloon.run(thickness, *voltage, STEPS, *FINE)))
    assert errors[0] < 6e-4
    assert min(orders(ratios, errors)) > 1.9


def test_the_scene_file() -> None:
    solution = grounded_balloon.run()
    assert solution["stretch"][-1] == pytest.approx(1.3638, abs=5e-4)
    assert grounded_balloon.error(solution) < 5e-4
    face = 0.02 * solution["stretch"] + 0.0005 / solution["stretch"] ** 2
    capacitance = 4.0 * math.pi * EPSILON_0 / (1.0 / face - 1.0 / 0.08)
    assert solution["charge"] == pytest.approx(capacitance * solution["voltage"], rel=1e-4)
    assert solution["field_energy"] == pytest.approx(0.5 * solution["charge"] * solution["voltage"], rel=1e-12)


def test_pull_in_is_found_and_named() -> None:
    limit = grounded_balloon.exact(grounded_balloon.scene()).pull_in()
    assert limit is not None
    changes = ("path=[{steps = 5}]", "solver.min_step=1e-3")  # the smallest step is 80 V
    solution = grounded_balloon.run(*grounded_balloon.at_voltage(400e3), *changes, throw=False)
    assert solution.result is Result.PULL_IN
    assert solution["voltage"][-1] == pytest.approx(limit.load, rel=5e-4)
    assert solution["stretch"][-1] == pytest.approx(limit.stretch, abs=0.03)


def test_the_ground_pulls() -> None:
    """At one voltage the balloon is larger beside a ground than in free space, and the larger the nearer it is."""
    voltage = grounded_balloon.at_voltage(200e3)
    free = charged_balloon.run(*voltage, STEPS)["stretch"][-1]
    far, near = (
        grounded_balloon.run(*voltage, STEPS, f"ambient.radius={radius} mm")["stretch"][-1] for radius in (160, 60)
    )
    assert free < far < near
