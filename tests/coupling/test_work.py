"""What loads and moving supports work on, against closed forms."""

from __future__ import annotations

import math

import pytest

from tests.bent import Bent, clamped, mesh, metal

STRIP = {"kind": "strip", "length": 12.0}
THICKNESS, MODULUS = 0.1, 1.2e6
RIGIDITY = MODULUS * THICKNESS**3 / 12


@pytest.mark.parametrize("size", [2.0, 1.0])
def test_a_moment_bends_a_strip_into_half_a_circle(size: float) -> None:
    """Its angle is M L / (E I), half of its work is stored (elastica with constant moment)."""
    angle = math.pi
    moment = angle * RIGIDITY / 12.0
    bent = Bent(
        STRIP, THICKNESS, metal(youngs_modulus=MODULUS), supports=clamped("x0"),
        loads={"edge_moments": [{"edge": "x1", "moment": moment}]}, discretisation=mesh(3, size), path=({},),
    )  # fmt: skip
    assert bent.scalars["load_work"] == pytest.approx(moment * angle, rel=2e-4)
    assert bent.scalars["elastic_energy"] == pytest.approx(moment * angle / 2, rel=2e-4)


def test_small_loads_store_half_of_their_work() -> None:
    """P^2 L^3 / (6 E I) under a force at the tip (Euler-Bernoulli)."""
    tip = {"edge_tractions": [{"edge": "x1", "traction": [0.0, 1e-3, 0.0]}]}
    bent = Bent(
        STRIP, THICKNESS, metal(youngs_modulus=MODULUS), supports=clamped("x0"), loads=tip, discretisation=mesh(3, 1.0)
    )
    exact = 1e-6 * 12.0**3 / (6 * RIGIDITY)
    assert bent.scalars["elastic_energy"] == pytest.approx(exact, rel=1e-3)
    assert bent.scalars["load_work"] == pytest.approx(2 * exact, rel=1e-3)


def test_a_support_that_moves_stretches_a_strip() -> None:
    """To the stretch 1 + e, whose energy per length is E T e^2 / 2 for small e."""
    pulled = 1e-4 * 12.0
    supports = [*clamped("x0"), {"where": "x1", "fix": ["x"], "displacement": [pulled, 0.0, 0.0]}]
    bent = Bent(STRIP, THICKNESS, metal(youngs_modulus=MODULUS), supports=supports, discretisation=mesh(3, 1.0))
    stored = 12.0 * MODULUS * THICKNESS * 1e-8 / 2
    assert bent.scalars["elastic_energy"] == pytest.approx(stored, rel=1e-3)
    assert bent.scalars["support_work"] == pytest.approx(2 * stored, rel=1e-3)
    assert "load_work" not in bent.scalars
