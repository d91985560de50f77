"""The error statement against the true error, where an exact thick-walled solution exists."""

from __future__ import annotations

import math

import numpy as np
import pytest

from embedding import (
    Ambient,
    Electrode,
    Faces,
    InfiniteCylinder,
    Loads,
    Model,
    NeoHookean,
    Scene,
    Shell,
    Sphere,
    Stage,
    load_scene,
    solve,
)
from embedding.geometry.remeshing import one_order_more
from embedding.scene import EPSILON_0
from embedding.solving.estimate.enriched import Enriched
from problems import capacitances, circular_membrane
from problems.common import law_of
from problems.exact import circular_membrane as exact_membrane
from problems.exact import cylinder, sphere
from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.material import neo_hookean
from tests.coupling.scenes import coupled, distort

MU = 1e5
RADIUS = 0.02


def shell(shape: Sphere | InfiniteCylinder, ratio: float) -> Shell:
    return Shell(shape=shape, thickness=ratio * RADIUS, material=NeoHookean(shear_modulus=MU))


@pytest.mark.parametrize("ratio", [0.1, 0.05, 0.01])
@pytest.mark.parametrize("interface", ["auto", "closed"])
def test_charged_balloon(ratio: float, interface: str) -> None:
    exact = ChargedBalloon(RADIUS, ratio * RADIUS, neo_hookean(MU), EPSILON_0)
    voltage = math.sqrt(4 * 0.798122427984 * MU * ratio * RADIUS**2 / EPSILON_0)
    electrode = Electrode(voltage=voltage)
    scene = Scene(
        shell=shell(Sphere(radius=RADIUS), ratio),
        ambient=Ambient(field="electric"),
        faces=Faces(top=electrode, bottom=electrode),
        path=(Stage(steps=4),),
        model=Model(interface=interface),
    )
    check(solve(scene), exact.stretch(voltage), "stretch")


@pytest.mark.parametrize("ratio", [0.1, 0.05, 0.01])
@pytest.mark.parametrize("stretch", [1.05, 1.5])
def test_pressurised_tube(ratio: float, stretch: float) -> None:
    pressure = cylinder.membrane_pressure(stretch, ratio)
    scene = Scene(
        shell=shell(InfiniteCylinder(radius=RADIUS), ratio),
        loads=Loads(pressure_bottom=MU * pressure),
        path=(Stage(steps=6),),
    )
    check(solve(scene), cylinder.thick_stretch(pressure, ratio), "stretch")


@pytest.mark.parametrize("ratio", [0.1, 0.05, 0.01])
def test_volume_control_states_the_error_of_the_pressure(ratio: float) -> None:
    scene = Scene(shell=shell(Sphere(radius=RADIUS), ratio), path=(Stage(steps=2, volume_ratio=1.05**3),))
    check(solve(scene), MU * sphere.thick_pressure(1.05, ratio), "pressure_difference")


@pytest.mark.parametrize("name", ["disc", "bowl of 90 degrees"])
@pytest.mark.parametrize("order", [2, 3])
def test_the_energy_around_a_held_conductor(name: str, order: int) -> None:
    """The field is singular at its rim: the change to the next order would by itself state a third of the error."""
    conductor = capacitances.RIMMED[name]
    thin = "shell.thickness=2e-8"  # the reference has its faces at the mid-surface
    solution = capacitances.run(f"shell.shape={conductor.shape}", thin, f"discretisation.order={order}")
    error = solution.error
    assert error is not None
    assert error.quantity == "field_energy"
    true = abs(solution["charge"][-1] / solution["voltage"][-1] / conductor.known - 1.0)
    assert 0.5 * true <= error.value <= 2.0 * true


def check(solution: object, exact: float, quantity: str, most: float = 3.0) -> None:
    error = solution.errors[quantity]  # type: ignore[attr-defined]
    assert error.quantity == quantity
    assert error.value == pytest.approx(sum(error.parts.values()))
    true = abs(solution[quantity][-1] - exact) / exact  # type: ignore[index]
    assert 0.9 * true <= error.value <= most * true


def test_the_next_order_starts_with_the_ambient_where_it_is() -> None:
    """The interior of the ambient goes along, and need not walk again to where the faces are."""
    problem = coupled("3d", "conductor")
    distort(problem, 0.3)
    with one_order_more(problem.domain) as domain:
        richer = Enriched(problem, domain)
        for side, motion in problem.system.motions.items():
            follower = richer.system.motions[side]
            assert np.array_equal(follower.w.vec.FV().NumPy(), motion.w.vec.FV().NumPy())
            assert richer.system.follow()
            assert np.array_equal(follower.w.vec.FV().NumPy(), motion.w.vec.FV().NumPy())


@pytest.mark.parametrize(("order", "size"), [(2, 0.02), (2, 0.01), (3, 0.02), (4, 0.02)])
def test_extremes_at_the_ends_of_elements(order: int, size: float) -> None:
    """A membrane that is blown up is stretched most at its apex, on the axis, and least along its rim."""
    height = 0.08
    meshed = f"discretisation.order={order}", f"discretisation.shell_size={size}"
    solution = solve(load_scene(circular_membrane.SCENE, (f"path.0.until.value={height}", *meshed)))
    known = exact_membrane.at_deflection(height / circular_membrane.RADIUS, law_of(solution.scene)).apex_stretch
    scalars, errors = solution.steps[-1].scalars, solution.errors
    assert 0.8 < errors["stretch_max"].value / abs(scalars["stretch_max"] / known - 1.0) < 1.5
    assert scalars["stretch_min"] == pytest.approx(1.0, abs=1e-12)
