"""What a thick wall takes and stores beside the shell, membrane or bent: against integrals over the exact wall."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from embedding import Scene, solve
from embedding.shell.laws import Law, MooneyRivlinLaw, OgdenLaw
from embedding.solving.estimate.theory import Wall
from problems.common import law_of
from problems.exact import sphere

NEO_HOOKE = MooneyRivlinLaw(0.5, 0.0)
OGDEN = OgdenLaw((0.7, 0.1), (1.4, 4.0))
INFLATED = """
name = "inflated"
[shell]
thickness = "{thickness} mm"
shape = {{ kind = "sphere", radius = "20 mm" }}
material = {{ law = "neo-hookean", shear_modulus = "100 kPa" }}
[[path]]
volume_ratio = {volume}
steps = 4
[model]
theory = "{theory}"
[discretisation]
order = 4
"""


def stored(law: Law, first: float, second: float) -> float:
    """Energy of the laws above at in-plane stretches, over the sum of squares and of powers."""
    third = 1.0 / (first * second)
    if isinstance(law, OgdenLaw):
        terms = zip(law.moduli, law.exponents, strict=True)
        return sum(mu / a * (first**a + second**a + third**a - 3.0) for mu, a in terms)
    return 0.5 * (first**2 + second**2 + third**2 - 3.0)


@pytest.mark.parametrize("law", [NEO_HOOKE, OGDEN], ids=["neo-Hooke", "Ogden"])
@pytest.mark.parametrize("stretch", [0.95, 1.02, 1.3, 2.0])
@pytest.mark.parametrize(("tube", "axial"), [(False, 1.0), (True, 1.0), (True, 1.2)])
def test_energy_of_the_wall(law: Law, stretch: float, tube: bool, axial: float) -> None:
    thickness = 0.2

    def layer(radius: float) -> float:
        if tube:
            grown = math.sqrt((radius**2 - 1.0) / axial + stretch**2)
            return stored(law, grown / radius, axial) * radius
        grown = float(np.cbrt(radius**3 - 1.0 + stretch**3))
        return stored(law, grown / radius, grown / radius) * radius**2

    thick = quad(layer, 1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness, epsabs=0.0, epsrel=1e-12)[0]
    thin = thickness * stored(law, stretch, axial if tube else stretch)
    assert Wall(tube, thickness, stretch, axial).energy(law) == pytest.approx(thick / thin - 1.0, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("law", [NEO_HOOKE, OGDEN], ids=["neo-Hooke", "Ogden"])
@pytest.mark.parametrize("bends", [False, True])
@pytest.mark.parametrize(("tube", "axial"), [(False, 1.0), (True, 1.0), (True, 1.2)])
def test_pressure_is_the_slope_of_the_energy(law: Law, bends: bool, tube: bool, axial: float) -> None:
    """Of the thick wall: its energy is that of the shell times 1 + the difference; so is its pressure."""
    thickness, stretch, step = 0.2, 1.3, 1e-4

    def energies(at: float) -> tuple[float, float]:
        wall = Wall(tube, thickness, at, axial, bends)
        thin = thickness * stored(law, at, axial if tube else at) + wall.bending(law, at)
        return thin, thin * (1.0 + wall.energy(law))

    below, above = energies(stretch - step), energies(stretch + step)
    thin, thick = (high - low for low, high in zip(below, above, strict=True))
    assert Wall(tube, thickness, stretch, axial, bends).elastic(law) == pytest.approx(thick / thin - 1.0, abs=2e-6)


@pytest.mark.parametrize("theory", ["membrane", "bending"])
@pytest.mark.parametrize("thickness", [2.0, 1.0])
@pytest.mark.parametrize("stretch", [1.02, 1.1, 1.3])
def test_errors_of_an_inflated_balloon(theory: str, thickness: float, stretch: float) -> None:
    """Of pressure and energy at a volume. Where a part passes through zero the rest of the estimate counts as well."""
    text = INFLATED.format(thickness=thickness, volume=stretch**3, theory=theory)
    solution = solve(Scene.from_toml(text))
    law, ratio, scalars = law_of(solution.scene), thickness / 20.0, solution.steps[-1].scalars
    pressure = sphere.PRESSURES["thick"][0]
    known = {
        "pressure_difference": pressure(stretch, ratio, law),
        "elastic_energy": quad(
            lambda s: 4.0 * math.pi * 0.02**3 * s**2 * pressure(s, ratio, law), 1.0, stretch, epsabs=0.0, epsrel=1e-10
        )[0],
    }
    for name, value in known.items():
        error, stated = abs(scalars[name] / value - 1.0), solution.errors[name].value
        assert 0.5 * error < stated < 3.0 * error + 1e-4, name
