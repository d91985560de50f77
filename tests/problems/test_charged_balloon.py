"""Charged balloon against the exact thick sphere: second order with the interface opened, first order closed."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from embedding import Solution
from embedding.scene.scales import EPSILON_0
from problems import charged_balloon
from tests.problems.measures import orders
from tests.problems.shared_runs import charged_in_3d

RATIOS = (0.1, 0.05, 0.025)
FINE = ("discretisation.order=4",)  # then the error of the mesh is 1e-7
STEPS = "path=[{steps = 4}]"


@cache
def charged(ratio: float, interface: str, *changes: str) -> Solution:
    """Four load levels up to a stretch of 1.2."""
    return charged_balloon.run(*charged_balloon.at(ratio, 1.2), f"model.interface={interface}", STEPS, *changes)


def test_opened_is_second_order_in_the_thickness() -> None:
    errors = [charged_balloon.error(charged(ratio, "opened", *FINE)) for ratio in RATIOS]
    assert errors[0] < 3e-4
    assert errors == pytest.approx([1.936e-4, 4.226e-5, 9.81e-6], rel=0.01)
    assert min(orders(RATIOS, errors)) > 2.0


def test_closed_is_first_order_in_the_thickness() -> None:
    errors = [charged_balloon.error(charged(ratio, "closed", *FINE)) for ratio in RATIOS]
    assert orders(RATIOS, errors) == pytest.approx([1.0, 1.0], abs=0.1)
    assert errors[0] > 50.0 * charged_balloon.error(charged(RATIOS[0], "opened", *FINE))


@pytest.mark.parametrize("ratio", RATIOS)
def test_closed_is_the_membrane(ratio: float) -> None:
    """Faces at the mid-surface: what the closed interface solves is the textbook membrane."""
    assert charged_balloon.error(charged(ratio, "closed", *FINE), "membrane") < 2e-7


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_default_mesh_is_below_the_theory(ratio: float) -> None:
    fine = charged(ratio, "opened", *FINE)
    assert charged(ratio, "opened")["stretch"] == pytest.approx(fine["stretch"], abs=1e-5)


@pytest.mark.estimated
def test_the_scene_file() -> None:
    solution = charged_balloon.run()
    assert solution["stretch"][-1] == pytest.approx(1.458, abs=1e-3)
    assert charged_balloon.error(solution) < 5e-5
    assert solution.error is not None
    assert charged_balloon.error(solution) < solution.error.value < 1e-3
    assert solution["stretch_max"][-1] - solution["stretch_min"][-1] < 2e-4, "a sphere stays a sphere"


@pytest.mark.slow
def test_3d_is_axisymmetric() -> None:
    flat, solid = charged(0.1, "opened", *FINE), charged_in_3d()
    assert solid["stretch"] == pytest.approx(flat["stretch"], abs=2e-5)
    assert solid["charge"] == pytest.approx(flat["charge"], rel=5e-5)
    assert solid["pressure_top"] == pytest.approx(flat["pressure_top"], rel=5e-5)


@pytest.mark.parametrize("interface", ["opened", "closed"])
def test_charge_and_field_energy(interface: str) -> None:
    """Q = 4 pi eps0 b V at the radius b of the shell's face, energy Q V / 2."""
    solution = charged(0.1, interface, *FINE)
    radius, half = 0.02, 0.001 if interface == "opened" else 0.0
    face = radius * solution["stretch"] + half / solution["stretch"] ** 2
    voltage, charge = solution["voltage"], solution["charge"]
    assert charge == pytest.approx(4.0 * math.pi * EPSILON_0 * face * voltage, rel=5e-7)
    assert solution["field_energy"] == pytest.approx(0.5 * charge * voltage, rel=1e-12)


def test_energy_balance() -> None:
    """At the voltage V the source gives V dQ, half of which the field keeps: E_elastic = Q V / 2 - int Q dV.

    (d(Q V / 2) = V dQ - dE_elastic, integrated from rest.) Q / V is even in V: fitted by a polynomial of V^2.
    """
    top = 540e3  # a stretch of 1.31
    field = (f"faces.{face}.voltage={top}" for face in ("top", "bottom"))
    solution = charged_balloon.run(*FINE, *field, "path=[{steps = 12}]")
    voltage, charge = solution["voltage"] / top, solution["charge"] * top
    fit = np.polynomial.Polynomial.fit(voltage**2, charge / voltage, 9)
    stored = 0.5 * charge * voltage - 0.5 * fit.integ(lbnd=0.0)(voltage**2)
    assert solution["elastic_energy"] == pytest.approx(stored, abs=1e-6 * stored[-1])


def test_free_space_has_no_end() -> None:
    """Where the meshed part of free space ends does not matter: the far field is that of a charge."""
    near, far = (charged(0.05, "opened", *FINE, f"ambient.radius={radius} mm") for radius in (50, 150))
    assert near["stretch"] == pytest.approx(far["stretch"], abs=5e-7)


def test_air_inside_and_charge_outside_add_up() -> None:
    """Inflated and charged together: the exact sphere under both, p_elastic = p + eps0 E^2 / 2."""
    ratios, errors = (0.1, 0.05), []
    for ratio in ratios:
        thickness, pressure = charged_balloon.at(ratio, 1.2)[0], 20e3 * ratio
        shell = charged_balloon.exact(charged_balloon.scene(thickness))
        voltage = shell.voltage(1.2, pressure)
        field = (f"faces.{face}.voltage={voltage!r}" for face in ("top", "bottom"))
        solution = charged_balloon.run(thickness, f"loads.pressure_bottom={pressure}", *field, STEPS, *FINE)
        known = [shell.stretch(float(v), pressure * float(v) / voltage) for v in solution["voltage"]]
        errors.append(float(np.abs(solution["stretch"] - known).max()))
    assert errors[0] < 3e-4
    assert orders(ratios, errors)[0] > 1.9


def test_a_held_charge() -> None:
    """Q^2 = 64 pi^2 eps0 mu T R^3 (l^3 - l^-3) on the membrane: one stretch for every charge."""
    stretch = 1.8
    charge = math.sqrt(64.0 * math.pi**2 * EPSILON_0 * 30e3 * 1e-3 * 0.02**3 * (stretch**3 - stretch**-3))
    held = ("faces={both={charge=" + repr(charge) + "}}", "model.interface=closed", "path=[{steps = 6}]")
    solution = charged_balloon.run(*held, *FINE)
    assert solution["stretch"][-1] == pytest.approx(stretch, abs=2e-6)
    known = charge / (4.0 * math.pi * EPSILON_0 * 0.02 * stretch)
    assert solution["voltage"][-1] == pytest.approx(known, rel=2e-6)
    assert (solution["unstable_modes"] == 0).all()
