"""Conducting sphere in a uniform field: the field on it, its dipole, forces on it and on its halves."""

from __future__ import annotations

import math

import pytest

from embedding.scene.scales import EPSILON_0
from problems import sphere_in_field
from problems.exact import conducting_spheres
from problems.sphere_in_field import HELD, Moments, Pull

E0, R = 3e6, 0.02


def test_the_neutral_sphere() -> None:
    pull, moments = Pull(), Moments()
    solution = sphere_in_field.run(*HELD, listeners=[pull, moments])
    known = sphere_in_field.known_pull(solution.scene, pull.cosine)
    assert pull.pull == pytest.approx(known, abs=4e-3 * known.max())
    halves = 2.25 * math.pi * EPSILON_0 * R**2 * E0**2
    assert moments.apart(R) == pytest.approx(halves, rel=1e-4)
    assert halves == pytest.approx(conducting_spheres.hemispheres_in_field(R, E0, EPSILON_0), rel=1e-14)
    assert abs(solution["charge"][-1]) < 1e-20
    assert abs(solution["voltage"][-1]) < 1e-6 * E0 * R
    assert abs(solution["force_z"][-1]) < 1e-5 * halves


def test_the_dipole() -> None:
    """The pull is eps0/2 (E0 (1 + 2 m) cos)^2 for the dipole 4 pi eps0 R^3 E0 m: m = 1."""
    moments = Moments()
    sphere_in_field.run(*HELD, listeners=[moments])
    constant, linear, square = moments.pull(R)
    assert [constant, linear] == pytest.approx([0.0, 0.0], abs=1e-4 * square)
    assert 0.5 * (math.sqrt(2.0 * square / EPSILON_0) / E0 - 1.0) == pytest.approx(1.0, abs=1e-4)


def test_the_halves_of_a_charged_sphere() -> None:
    """pi eps0 V^2 / 2 = Q^2 / (32 pi eps0 R^2) pulls them apart (Kelvin)."""
    moments = Moments()
    none = "ambient.applied_field=[0, 0, 0]"
    solution = sphere_in_field.run(*HELD, none, "faces.both={voltage = 10000}", listeners=[moments])
    apart = 0.5 * math.pi * EPSILON_0 * 1e8
    assert moments.apart(R) == pytest.approx(apart, rel=1e-4)
    assert apart == pytest.approx(conducting_spheres.charged_hemispheres(1e4, EPSILON_0), rel=1e-14)
    assert abs(solution["force_z"][-1]) < 1e-5 * apart


def test_grounded_is_neutral_here() -> None:
    """The potential of the applied field is zero at the centre."""
    solution = sphere_in_field.run(*HELD, "faces.both={voltage = 0}")
    assert abs(solution["charge"][-1]) < 1e-6 * 4.0 * math.pi * EPSILON_0 * R**2 * E0


@pytest.mark.parametrize("interface", ["closed", "opened"])
def test_a_charge_is_pulled_along(interface: str) -> None:
    """Q E0 in all, wherever the faces are; the voltage is that of the charge alone."""
    pull, charge = Pull(), 1e-7
    changes = (*HELD[:3], f"model.interface={interface}")
    solution = sphere_in_field.run(*changes, f"faces.both={{charge = {charge}}}", listeners=[pull])
    assert solution["force_z"][-1] == pytest.approx(charge * E0, rel=1e-6)
    face = R if interface == "closed" else R + 0.5e-3
    assert solution["voltage"][-1] == pytest.approx(charge / (4.0 * math.pi * EPSILON_0 * face), rel=5e-5)
    if interface == "closed":
        known = sphere_in_field.known_pull(solution.scene, pull.cosine, charge)
        assert pull.pull == pytest.approx(known, abs=4e-3 * known.max())


def test_the_balloon_grows_longer() -> None:
    solution = sphere_in_field.run()
    assert solution["stretch_max"][-1] > 1.02 * solution["stretch_min"][-1]
    assert abs(solution["force_z"]).max() < 1e-4 * 2.25 * math.pi * EPSILON_0 * R**2 * E0**2
