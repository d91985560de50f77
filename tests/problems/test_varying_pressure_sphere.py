"""Varying face pressures on a closed sphere, judged by a thick solid: only the consistent load is of second order."""

from __future__ import annotations

import numpy as np
import pytest

from problems import varying_pressure_sphere
from problems.common import Positions
from tests.problems.measures import orders
from tests.solids import referee_load
from tests.solids.membrane import Variant, membrane_sphere

RATIOS = (0.1, 0.05, 0.025)


def errors(variant: Variant) -> list[float]:
    changes = (f"loads.variant={variant}", "path.0.steps=5")
    return [varying_pressure_sphere.error(*varying_pressure_sphere.at_thickness(t), *changes) for t in RATIOS]


def test_the_consistent_load_is_of_second_order() -> None:
    found = errors("embedding-aware")
    assert found == pytest.approx([6.17e-4, 1.55e-4, 3.87e-5], rel=0.01)
    assert orders(RATIOS, found) == pytest.approx([2.0, 2.0], abs=0.02)


@pytest.mark.parametrize(
    ("variant", "expected"),
    [("net", [5.38e-2, 5.35e-2, 5.34e-2]), ("as-published", [3.44e-2, 3.47e-2, 3.48e-2])],
)
def test_other_loads_do_not_converge(variant: Variant, expected: list[float]) -> None:
    found = errors(variant)
    assert found == pytest.approx(expected, rel=0.01)
    assert max(map(abs, orders(RATIOS, found))) < 0.05


@pytest.mark.parametrize("variant", ["embedding-aware", "net", "as-published"])
@pytest.mark.parametrize(
    ("mesh", "tolerance"),
    [
        (("model.reduction=axisymmetric",), 1e-7),
        (("model.reduction=3d", "discretisation.shell_size=6 mm"), 5e-6),
    ],
)
def test_every_load_is_the_one_it_claims_to_be(mesh: tuple[str, ...], variant: Variant, tolerance: float) -> None:
    """Against an independent code for the membrane on a line, with the same three loads."""
    positions = Positions()
    changes = (f"loads.variant={variant}", "path.0.steps=5", *mesh)
    scene = varying_pressure_sphere.run(*changes, listeners=[positions]).scene
    surface = varying_pressure_sphere.mid_surface(scene, positions)
    loading = varying_pressure_sphere.loading(scene)
    assert surface.distance(membrane_sphere(0.05, *loading, variant, angles=surface.theta)) < tolerance


def test_the_scene_states_the_referee_load() -> None:
    for ratio in (0.05, 0.1):
        scene = varying_pressure_sphere.scene(*varying_pressure_sphere.at_thickness(ratio))
        cosines = np.linspace(0.0, 1.0, 5)
        for stated, referee in zip(varying_pressure_sphere.loading(scene), referee_load(ratio), strict=True):
            assert stated(cosines) == pytest.approx(referee(cosines), abs=1e-12)
    assert varying_pressure_sphere.scene(*varying_pressure_sphere.at_thickness(0.05)).loads == (
        varying_pressure_sphere.scene().loads
    )
