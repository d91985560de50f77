"""Every law in a balloon: the pressure of membrane theory, and all limit points.

Published limit points as (stretch, p R / (mu T)), or in Pa at T/R = 0.01. Locating them by a spline through the steps
costs up to 3e-7 of the stretch (`problems.sphere_inflation.limit_points`), and 2e-8 of the load.
"""

from __future__ import annotations

import numpy as np
import pytest

from embedding import Solution
from problems import cylinder_inflation, sphere_inflation
from problems.common import law_of, thickness_ratio
from problems.exact import cylinder
from tests.problems.measures import EVERY_LAW

MU = 422500.0
MATERIALS = EVERY_LAW | {
    "mooney-rivlin, c2 / c1 = 1 / 10": "{law = 'mooney-rivlin', c1 = '50 kPa', c2 = '5 kPa'}",
    "mooney-rivlin, c2 / c1 = 1 / 7": f"{{law = 'mooney-rivlin', c1 = {7 / 16 * MU}, c2 = {MU / 16}}}",
}
GENT = ((1.39767326520, 1.25408146704), (4.08502297851, 0.712018906253))
PER_MODULUS = {
    "neo-hookean": ((1.38308755427, 1.23946290240),),
    "mooney-rivlin, c2 / c1 = 1 / 10": ((1.47606984746, 1.35510686880), (3.14262133321, 1.14874772529)),
    "gent": GENT,
}
"""Green and Adkins; Mooney and Rivlin's law in the form of Beatty, Gent's with Jm = 97.2."""
IN_PASCAL = {
    "mooney-rivlin, c2 / c1 = 1 / 7": (
        (1.535190143542765, 5945.956379577728),
        (2.593978434621859, 5571.8912536121),
    ),
    "ogden": ((1.374050289994588, 5494.123081698992), (4.3202827261645265, 2355.5287124964584)),
}
"""Holzapfel, Nonlinear Solid Mechanics (2000), example 6.3; Kiendl et al., CMAME 291 (2015) 280, figure 4."""
FINE = "path=[{volume_ratio = 2.197, steps = 4}, {volume_ratio = 4.5, steps = 24}, {volume_ratio = 125, steps = 60}]"
SHORT = "path=[{volume_ratio = 2.197, steps = 4}, {volume_ratio = 3.375, steps = 6}, {volume_ratio = 27, steps = 8}]"


def inflated(name: str, *changes: str) -> Solution:
    return sphere_inflation.run(f"shell.material={MATERIALS[name]}", *changes)


@pytest.mark.parametrize("name", MATERIALS)
def test_pressure_and_limit_points(name: str) -> None:
    solution = inflated(name, FINE)
    assert sphere_inflation.error(solution) < 1e-8
    found = sphere_inflation.limit_points(solution)
    exact = sphere_inflation.reference_limit_points(solution.scene)
    assert len(found) == len(exact)
    for point, known in zip(found, exact, strict=True):
        assert point.stretch == pytest.approx(known.stretch, abs=1e-6)
        assert point.load == pytest.approx(known.load, abs=1e-7)
    unit = solution.scene.shell.material.shear_modulus * thickness_ratio(solution.scene)
    published = PER_MODULUS.get(name) or [(s, p / unit) for s, p in IN_PASCAL.get(name, ())]
    for point, known_point in zip(exact, published, strict=False):
        # A maximum found by its load is known to the root of rounding, 2e-8, in the stretch.
        assert point == pytest.approx(known_point, rel=3e-8)


@pytest.mark.parametrize("name", ["gent", *(pytest.param(name, marks=pytest.mark.slow) for name in ("yeoh", "ogden"))])
def test_in_three_dimensions(name: str) -> None:
    """All in-plane stretches are equal here, where the root in Ogden's law has no derivative."""
    octant = inflated(name, SHORT, "model.reduction=3d", "discretisation.shell_size=6 mm")
    assert sphere_inflation.error(octant) < 1e-6
    assert octant["stretch"][-1] == pytest.approx(3.0, abs=1e-5)


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_st_venant_and_kirchhoff(reduction: str) -> None:
    """p = (T/R) Y / (1 - nu) (l - 1/l), from the energy Y / (1 - nu) e^2 with e = (l^2 - 1) / 2."""
    material = "{law = 'st-venant-kirchhoff', youngs_modulus = '1 MPa', poisson_ratio = 0.3}"
    solution = sphere_inflation.run(
        f"shell.material={material}", "path=[{volume_ratio = 1.331, steps = 4}]", f"model.reduction={reduction}",
        "model.theory=membrane",
        "discretisation.shell_size=6 mm",
    )  # fmt: skip
    stretch = solution["stretch"]
    exact = thickness_ratio(solution.scene) * 1e6 / 0.7 * (stretch - 1 / stretch)
    assert np.abs(solution["pressure_difference"] / exact - 1).max() < 1e-6
    assert stretch[-1] == pytest.approx(1.1, abs=1e-7)


@pytest.mark.parametrize("material", EVERY_LAW.values(), ids=EVERY_LAW)
def test_tube_in_plane_strain(material: str) -> None:
    solution = cylinder_inflation.run(f"shell.material={material}")
    law, ratio = law_of(solution.scene), thickness_ratio(solution.scene)
    assert solution["stretch"][-1] > 1.05
    exact = [cylinder.membrane_pressure(float(stretch), ratio, law) for stretch in solution["stretch"]]
    assert solution["pressure_difference"] == pytest.approx(np.array(exact), rel=1e-8)


def test_a_law_of_ones_own() -> None:
    """Gent's law by its energy: the published limit points, and in 3D the same as by its name."""
    own = "shell.material={law = 'strain-energy', expression = '-4860*log(1 - (I1 - 3)/97.2)', unit = 'kPa'}"
    points = sphere_inflation.limit_points(sphere_inflation.run(own, FINE))
    for point, (stretch, load) in zip(points, GENT, strict=True):
        assert (point.stretch, point.load) == (pytest.approx(stretch, abs=1e-6), pytest.approx(load, abs=1e-7))
    coarse = (SHORT, "model.reduction=3d", "discretisation.shell_size=10 mm", "discretisation.order=2")
    found, named = sphere_inflation.run(own, *coarse), inflated("gent", *coarse)
    for scalar in ("stretch", "pressure_difference", "elastic_energy"):
        assert found[scalar] == pytest.approx(named[scalar], rel=1e-10)
