"""Tubes in plane strain: dielectric with electrodes, and permeable across a field."""

from __future__ import annotations

import pytest

from problems import dielectric_tube, permeable_cylinder
from tests.problems.measures import orders

STEPS = "path=[{steps = 4}]"


def test_dielectric_tube_is_that_of_a_thin_wall_and_of_second_order_to_a_thick_one() -> None:
    ratios = (0.1, 0.05, 0.025)
    found = [dielectric_tube.run(*dielectric_tube.at(ratio), STEPS) for ratio in ratios]
    assert min(orders(ratios, [dielectric_tube.error(solution) for solution in found])) > 1.9
    assert max(dielectric_tube.error(solution, "membrane") for solution in found) < 1e-6


@pytest.mark.parametrize("permeability", [2.0, 10.0, 1e3, 1e6])
def test_held_permeable_tube(permeability: float) -> None:
    """Tractions on both faces and the field in the cavity: to the discretisation, whatever the thickness."""

    def errors(ratio: float, *mesh: str) -> dict[str, float]:
        scene, found = permeable_cylinder.rigid_run(ratio, permeability, *mesh)
        cavity = permeable_cylinder.inner_field(found) / permeable_cylinder.exact(scene).inner_field - 1.0
        return permeable_cylinder.error(scene, found) | {"cavity": abs(cavity)}

    for ratio in (0.2, 0.05):
        assert max(errors(ratio, *permeable_cylinder.FINE).values()) < 5e-7
    coarse, fine = (errors(0.1, "discretisation.order=4", f"discretisation.shell_size={h} mm") for h in (8, 4))
    assert all(fine[name] < 0.1 * coarse[name] for name in ("p_t", "tau_t", "p_b", "tau_b"))
