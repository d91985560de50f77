"""Shells whose field lies inside them or is given: films between electrodes, magnets in the field of others."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from ngsolve import BND, CF

from embedding import Discretisation, Model, NeoHookean, Plate, Scene, Shell, Strip, Support, explain
from embedding.ambient.sources import Electrodes, Source
from embedding.ambient.transmission import Matter
from embedding.coupling.physics import FieldPhysics
from embedding.coupling.system import System
from embedding.solving.newton import Newton
from embedding.solving.problem import Problem
from problems.exact import hard_magnetic_elastica as elastica
from tests.forms import Taylor, close_to, random_directions

T = 0.01
CONTRAST = 3.0
RUBBER = NeoHookean(shear_modulus=1e5)


def system(scene: Scene, **field: Any) -> System:
    """The system of ``scene`` with a field of its own."""
    problem = Problem(scene, explain(scene))
    dimension = problem.mesh.dim
    parts = {"electrodes": Electrodes(), "applied": (0.0,) * dimension, "grounded": False, "odd_planes": ()} | field
    return System(problem.domain, replace(problem.system.physics, field=FieldPhysics(**parts)))


def film(**source: float) -> System:
    """A square film, free to expand in its plane, with electrodes on both faces."""
    scene = Scene(
        shell=Shell(shape=Plate(length=0.01, width=0.01), thickness=0.01 * T, material=RUBBER),
        supports=(
            Support(where="x0", fix=("x",)),
            Support(where="y0", fix=("y",)),
            Support(where="surface", fix=("z",)),
        ),
        discretisation=Discretisation(shell_size=0.005, order=1),
    )
    electrodes = Electrodes(Source(**source), Source(voltage=0.0))
    return system(scene, electrodes=electrodes, matter=Matter(CONTRAST), extent="inside")


def solved(made: System, field: float) -> float:
    """The stretch of a film at the present load."""
    made.load(0.0, field, None)
    assert Newton(made, 1e-11, 30, lambda: (0.0, 0.0)).solve(lambda _: None).reason is None
    return 1.0 + float(max(made.unknowns.field("u").vec))


@pytest.mark.parametrize("stretch", [1.05, 1.15, 1.25])
def test_a_film_at_a_voltage(stretch: float) -> None:
    """eps (V / T)^2 = mu (l^-2 - l^-8)."""
    voltage = T * np.sqrt((stretch**-2 - stretch**-8) / CONTRAST)
    made = film(voltage=1.0)
    assert solved(made, voltage) == pytest.approx(stretch, rel=1e-9)
    assert made.potential is not None
    charge = made.potential.charge(made.potential.conductors[0])
    assert charge == pytest.approx(CONTRAST / T * stretch**4 * voltage, rel=1e-9)


@pytest.mark.parametrize("stretch", [1.1, 1.26, 1.6, 2.0])
def test_a_film_with_a_charge_passes_pull_in(stretch: float) -> None:
    voltage = T * np.sqrt((stretch**-2 - stretch**-8) / CONTRAST)
    made = film(charge=1.0)
    assert solved(made, CONTRAST / T * stretch**4 * voltage) == pytest.approx(stretch, rel=1e-9)
    assert made.potential is not None
    assert made.potential.voltage(made.potential.conductors[0]) == pytest.approx(voltage, rel=1e-9)


def strip(thickness: float, **field: Any) -> System:
    """A magnet, magnetised along itself, clamped at one end."""
    scene = Scene(
        shell=Shell(shape=Strip(length=0.01), thickness=0.01 * thickness, material=RUBBER),
        supports=(Support(where="x0", fix=("x", "y", "rotation")),),
        model=Model(theory="bending"),
    )
    parts = {"matter": Matter(1.0, (0.1, 0.0)), "applied": (0.0, 1.0), "extent": "given"} | field
    return system(scene, **parts)


def test_forces_in_a_given_field_are_a_gradient() -> None:
    """A field that varies, a material that is remanent and permeable: Taylor's test of residual and matrix."""
    made = strip(
        0.05, matter=Matter(1.4, (0.1, -0.05)), varying=lambda x: CF((0.3 * x[1], 0.3 * x[0] + 0.1 * x[0] * x[1]))
    )
    made.load(0.0, 0.7, None)
    made.unknowns.field("u").Set(CF((0.05, 0.1)), BND, definedon=made.domain.shell)
    free = np.asarray(made._solver.mask)
    taylor = Taylor(made.form, made.unknowns.state.vec, random_directions(free, 0.003, count=3))
    assert close_to(taylor.tangent_orders(rows=free), 2)


def tip(thickness: float, load: float) -> Any:
    """Place of the tip of :func:`strip` where the load of the elastica is ``load``, in lengths."""
    made = strip(thickness)
    newton = Newton(made, 1e-11, 40, lambda: (0.0, 0.0))
    stiffness = thickness**3 / 3
    for part in np.linspace(0.1, 1.0, 10):
        made.load(0.0, part * load * stiffness / (thickness * 0.1), None)
        assert newton.solve(lambda _: None).reason is None
    end = made.domain.mesh(1.0 - 1e-12, 0.0, VOL_or_BND=BND)
    return np.array(made.unknowns.field("u")(end)) + [1.0, 0.0]


def test_a_magnet_bends_as_the_elastica() -> None:
    """In the limit of a thin strip, whose stretching vanishes with the square of the thickness."""
    exact = elastica.tip(1.5)
    errors = [np.abs(tip(t, 1.5) - [1.0 - exact.shortening, exact.deflection]).max() for t in (0.04, 0.02)]
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
