"""An applied field given as an expression is the same field: pressures, forces on shell and bodies, wires too close."""

from __future__ import annotations

from typing import Any

import pytest

from embedding import Scene, SceneError, solve

pytestmark = pytest.mark.usefixtures("unestimated")

UNIFORM, EXPRESSION = [0.0, 0.0, 4e4], {"expression": ["0", "0", "4e4"]}


def scene(permeability: float, **ambient: Any) -> Scene:
    """A sphere held where it is, in a magnetic field."""
    shell = {
        "shape": {"kind": "sphere", "radius": 0.02},
        "thickness": 1e-3,
        "material": {"law": "neo-hookean", "shear_modulus": 3e4},
        "relative_permeability": permeability,
    }
    return Scene.from_table(
        {
            "shell": shell,
            "supports": [{"where": "surface", "fix": ["x", "y", "z"]}],
            "ambient": {"field": "magnetic", **ambient},
            "path": [{"steps": 1}],
        }
    )


@pytest.mark.parametrize("permeability", [1.0, 5.0])
def test_pressures(permeability: float) -> None:
    """The total potential and that of the change alone say the same on both faces; mu0 H^2 / 6 around nothing."""
    total, change = (solve(scene(permeability, applied_field=field)) for field in (UNIFORM, EXPRESSION))
    for name in ("pressure_top", "pressure_bottom"):
        assert change[name][-1] == pytest.approx(total[name][-1], rel=1e-4)
    if permeability == 1.0:
        assert change["pressure_top"][-1] == pytest.approx(4e-7 * 3.14159265 * 4e4**2 / 6, rel=3e-4)


def test_a_solid_in_a_liquid() -> None:
    body = {"kind": "sphere", "centre": [0, 0, 0.05], "radius": 0.01, "relative_permeability": 7.0}
    made = (
        scene(5.0, applied_field=field, relative_permeability=3.0, bodies=[body]) for field in (UNIFORM, EXPRESSION)
    )
    total, change = map(solve, made)
    for name in ("force_z", "force_body0_z"):
        assert change[name][-1] == pytest.approx(total[name][-1], rel=1e-5)
    assert total["force_z"][-1] == pytest.approx(-total["force_body0_z"][-1], rel=3e-3)


def test_a_wire_through_the_elements_beside_the_shell_is_refused() -> None:
    table = scene(5.0, line_currents=[{"through": [0.021, 0, 0], "along": [0, 1, 0], "current": 10}])
    with pytest.raises(SceneError, match="the wire passes through the elements that touch the shell"):
        solve(table)
