"""What holds for every scene, on scenes drawn at random; ``-m slow`` draws a hundred for each property."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from embedding import Solution, solve
from tests.extremes.scenes_at_random import Drawn, decades, scenes

FEW, MANY = 2, 100


def drawn(*strategies: Any) -> Callable[[Any], Any]:
    """The property as two tests' worth of examples: a few by default, many in the slow suite."""

    def decorated(check: Any) -> Any:
        @pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.slow)])
        def test(count: int) -> None:
            settings(max_examples=count, suppress_health_check=list(HealthCheck))(given(*strategies)(check))()

        test.__doc__ = check.__doc__
        return test

    return decorated


def answer(one: Drawn) -> Solution:
    solution = solve(one.scene())
    assert solution.result.ok
    return solution


def close(value: float, other: float, relative: float, size: float = 0.0) -> bool:
    """Equal within ``relative``, where ``size`` is of what both are small differences."""
    return abs(value - other) <= relative * max(abs(value), abs(other), size)


@drawn(scenes(), decades(-4, 4), decades(-4, 4))
def test_units(one: Drawn, length: float, stress: float) -> None:
    """Lengths and moduli times any number: the same shape, forces times their product."""
    other = one.but(size=one.size * length, modulus=one.modulus * stress)
    here, there = answer(one), answer(other)
    for name in ("stretch", "stretch_max"):
        assert close(here[name][-1], there[name][-1], 1e-8), name
    lengths = 2 if one.kind == "tube" else 3
    for name in {"elastic_energy", "field_energy"} & set(here.steps[-1].scalars):
        assert close(here[name][-1] * stress * length**lengths, there[name][-1], 1e-8), name
    for name in ("pressure_top", "pressure_bottom"):
        assert close(here[name][-1] * stress, there[name][-1], 1e-8, one.stress * stress), name


@drawn(scenes())
def test_energies(one: Drawn) -> None:
    """Work is stored: both energies are positive at every step, and zero only at rest."""
    found = answer(one)
    assert min(found["elastic_energy"]) > 0.0
    if "field_energy" in found.steps[-1].scalars:
        assert found["field_energy"][-1] > 0.0
    if one.field in ("voltage", "charge"):
        assert found["charge"][-1] * found["voltage"][-1] > 0.0
        assert close(0.5 * found["charge"][-1] * found["voltage"][-1], found["field_energy"][-1], 1e-9)


@drawn(scenes(kinds=("sphere", "tube"), fields=("voltage", "charge", "applied")))
def test_sign_of_the_field(one: Drawn) -> None:
    """Forces are of second order in the field: turned round, it moves the shell to the same place."""
    here, there = answer(one), answer(one.but(sign=-1.0))
    for name in ("stretch", "stretch_max", "pressure_top", "pressure_bottom", "elastic_energy"):
        assert close(here[name][-1], there[name][-1], 1e-9), name
    if "charge" in here.steps[-1].scalars:
        assert close(here["charge"][-1], -there["charge"][-1], 1e-9)


@drawn(scenes(kinds=("disc",)))
def test_faces_of_a_disc(one: Drawn) -> None:
    """A disc does not know which of its faces is the top."""
    here, there = answer(one), answer(one.but(swapped=True))
    for name in ("stretch", "stretch_max", "elastic_energy", "displacement"):
        assert close(here[name][-1], there[name][-1], 1e-9), name
    assert here["pressure_top"][-1] == pytest.approx(there["pressure_bottom"][-1], rel=1e-12)


@drawn(scenes(kinds=("tube",), fields=("applied",)))
def test_direction_of_the_field(one: Drawn) -> None:
    """A round tube does not know from where the field comes: x or y, on meshes that are each other's mirror images."""
    here = answer(one.but(direction=(1.0, 0.0, 0.0), permittivity=2.0))
    there = answer(one.but(direction=(0.0, 1.0, 0.0), permittivity=2.0))
    for name in ("stretch", "stretch_max", "elastic_energy"):
        assert abs(here[name][-1] - there[name][-1]) <= 2.0 * stated(here, there, name), name


@drawn(scenes(kinds=("sphere",), fields=("voltage", "charge")), st.floats(1.05, 1.3))
def test_more_load_moves_more(one: Drawn, more: float) -> None:
    """Below the limit point a balloon grows with its pressure and with the field's strength, and a thicker one less."""
    here = answer(one)["stretch"][-1]
    assert answer(one.but(pressure=more * one.pressure))["stretch"][-1] > here
    assert answer(one.but(strength=more * one.strength))["stretch"][-1] > here
    held = one.but(thinness=more * one.thinness, pressure=one.pressure / more, strength=one.strength / more)
    assert answer(held)["stretch"][-1] < here


@drawn(scenes())
def test_orders_agree_within_what_they_state(one: Drawn) -> None:
    """Two discretisations of one scene differ by no more than the errors they state, twice for safety."""
    coarse, fine = answer(one), answer(one.but(order=3, shell_size=0.5 * one.shell_size))
    for name in ("stretch", "elastic_energy"):
        assert abs(coarse[name][-1] - fine[name][-1]) <= 2.0 * stated(coarse, fine, name), name


@drawn(scenes(kinds=("sphere",), fields=("none", "voltage")))
def test_reductions_agree_within_what_they_state(one: Drawn) -> None:
    """The same balloon with its axis, and in three dimensions between mirror planes."""
    flat, solid = answer(one), answer(one.but(reduction="3d", shell_size=0.6))
    for name in ("stretch", "elastic_energy"):
        assert abs(flat[name][-1] - solid[name][-1]) <= 2.0 * stated(flat, solid, name), name


def stated(one: Solution, other: Solution, name: str) -> float:
    """What the errors of discretisation of two solutions allow them to differ by, and rounding."""
    allowed = sum(found.errors[name].discretisation for found in (one, other))
    assert math.isfinite(allowed)
    return (allowed + 1e-9) * abs(one[name][-1])
