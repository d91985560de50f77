"""What holds for every scene, on scenes drawn at random; ``-m slow`` draws fifty for each property."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from embedding import (
    Ambient,
    Discretisation,
    Electrode,
    Faces,
    NeoHookean,
    Scene,
    Shell,
    Solution,
    Sphere,
    SphereBody,
    Stage,
    Support,
    solve,
)
from tests.extremes.scenes_at_random import Drawn, decades, scenes

FEW, MANY = 2, 50


def drawn(*strategies: Any, few: int = FEW) -> Callable[[Any], Any]:
    """The property for a ``few`` scenes by default, none of them where one costs seconds, and for many in the slow
    suite."""

    def decorated(check: Any) -> Any:
        counts = [few] if few else []

        @pytest.mark.parametrize("count", [*counts, pytest.param(MANY, marks=pytest.mark.slow)])
        def test(count: int) -> None:
            settings(max_examples=count, suppress_health_check=list(HealthCheck))(given(*strategies)(check))()

        test.__doc__ = check.__doc__
        return test

    return decorated


def answer(one: Any, *given: float) -> Solution:
    solution = solve(one.scene(*given))
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


@drawn(scenes(kinds=("sphere", "tube"), fields=("voltage", "charge", "applied")), few=0)
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


@drawn(scenes(kinds=("tube",), fields=("applied",)), few=0)
def test_direction_of_the_field(one: Drawn) -> None:
    """A round tube does not know from where the field comes: x or y, on meshes that are each other's mirror images."""
    here = answer(one.but(direction=(1.0, 0.0, 0.0), permittivity=2.0))
    there = answer(one.but(direction=(0.0, 1.0, 0.0), permittivity=2.0))
    for name in ("stretch", "stretch_max", "elastic_energy"):
        assert abs(here[name][-1] - there[name][-1]) <= 2.0 * stated(here, there, name), name


@drawn(scenes(kinds=("sphere",), fields=("voltage", "charge")), st.floats(1.05, 1.3), few=0)
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


@drawn(scenes(kinds=("sphere",), fields=("none", "voltage")), few=0)
def test_reductions_agree_within_what_they_state(one: Drawn) -> None:
    """The same balloon with its axis, and in three dimensions between mirror planes."""
    flat, solid = answer(one), answer(one.but(reduction="3d", shell_size=0.6))
    for name in ("stretch", "elastic_energy"):
        assert abs(flat[name][-1] - solid[name][-1]) <= 2.0 * stated(flat, solid, name), name


@dataclass(frozen=True)
class Beside:
    """A balloon that keeps its shape beside a ball: conductors of any size, as far apart as they like."""

    radius: float
    ball: float
    gap: float
    order: int = 3

    def scene(self, shell: float, ball: float) -> Scene:
        """Their voltages are in MV per m of the balloon's radius."""
        shell, ball = 1e6 * self.radius * shell, 1e6 * self.radius * ball
        distance = self.radius * (1.0 + self.ball + self.gap)
        body = SphereBody(centre=(0.0, 0.0, distance), radius=self.ball * self.radius, voltage=ball)
        return Scene(
            shell=Shell(
                shape=Sphere(radius=self.radius), thickness=1e-3 * self.radius, material=NeoHookean(shear_modulus=1e5)
            ),
            supports=(Support(where="surface", fix=("x", "y", "z")),),
            ambient=Ambient(field="electric", bodies=(body,)),
            faces=Faces(both=Electrode(voltage=shell)),
            path=(Stage(steps=1),),
            discretisation=Discretisation(order=self.order),
        )


PAIRS = st.builds(Beside, radius=decades(-5, 1), ball=st.floats(0.3, 2.0), gap=st.floats(0.3, 3.0))


@drawn(PAIRS, few=1)
def test_reciprocity(pair: Beside) -> None:
    """The charge that a voltage on one conductor draws to the other is the same either way: exactly, on any mesh."""
    on_ball = answer(pair, 1.0, 0.0)["charge_body0"][-1]
    on_shell = answer(pair, 0.0, 1.0)["charge"][-1]
    assert on_ball < 0.0
    assert close(on_ball, on_shell, 1e-9)


@drawn(PAIRS, st.floats(-2.0, 2.0), few=1)
def test_action_and_reaction(pair: Beside, ratio: float) -> None:
    """The forces on a charged pair in free space are opposite, within what is stated of each."""
    found = answer(pair, 1.0, ratio)
    size = abs(answer(pair, 1.0, -1.0)["force_z"][-1])
    allowed = sum(
        found.errors[name].discretisation * abs(found[name][-1]) for name in ("force_z", "force_body0_z")
    )
    assert abs(found["force_z"][-1] + found["force_body0_z"][-1]) <= 2.0 * allowed + 1e-9 * size


def stated(one: Solution, other: Solution, name: str) -> float:
    """What the errors of discretisation of two solutions allow them to differ by, and rounding."""
    allowed = sum(found.errors[name].discretisation for found in (one, other))
    assert math.isfinite(allowed)
    return (allowed + 1e-9) * abs(one[name][-1])
