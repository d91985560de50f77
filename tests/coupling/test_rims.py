"""The rim of an open shell, where its faces meet: a shell like free space is not there, and no material is lost."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest

from embedding import load_scene, solve
from embedding.scene.scales import MU_0
from problems import turned_in_a_field

LENGTH, THICKNESS, FIELD, SLOPE = 20e-3, 0.5e-3, 1e3, 1e4
"""Of the strip and of the disc's radius in m; in A/m and A/m^2."""
UNIFORM = f"[{FIELD}, {FIELD}, 0]"
VARYING = f"{{expression=['{FIELD} + {SLOPE}*x', '{FIELD} - {SLOPE}*y', '0'], unit='A/m'}}"
ALONG = f"{{expression=['-{SLOPE / 2}*x', '-{SLOPE / 2}*y', '{FIELD} + {SLOPE}*z'], unit='A/m'}}"


@cache
def held(shape: str, permeability: float, applied: str, size: float) -> dict[str, Any]:
    """Force and torque on a strip or disc that is held everywhere, with elements of ``size`` thicknesses at rims."""
    rims = ("x0", "x1") if shape == "strip" else ("rim",)
    extent, axes = ("length", "xy") if shape == "strip" else ("radius", "xyz")
    scene = load_scene(
        turned_in_a_field.SCENE,
        (
            f"shell.shape={{kind='{shape}', {extent}={LENGTH}}}",
            f"shell.thickness={THICKNESS}",
            f"shell.relative_permeability={permeability}",
            f"supports=[{{where='surface', fix={list(axes)}}}]",
            "loads.edge_moments=[]",
            f"ambient.applied_field={applied}",
            f"discretisation.edge_size={{{', '.join(f'{rim}={size * THICKNESS}' for rim in rims)}}}",
        ),
    )
    return dict(solve(scene).steps[-1].scalars)


@pytest.mark.parametrize(("shape", "applied"), [("strip", UNIFORM), ("strip", VARYING), ("disc", ALONG)])
@pytest.mark.parametrize("size", [6.0, 2.0])
def test_a_shell_like_free_space_is_not_there(shape: str, applied: str, size: float) -> None:
    """No force and no torque, whatever the mesh, where Maxwell's pressure on one face alone is a million times more."""
    found = held(shape, 1.0, applied, size)
    pressure = MU_0 * FIELD**2 * LENGTH
    for name in {"force_x", "force_y", "force_z"} & set(found):
        assert abs(found[name]) < 1e-9 * pressure
    assert abs(found.get("torque_z", 0.0)) < 1e-9 * pressure * LENGTH


@pytest.mark.parametrize("size", [6.0, 2.0])
def test_no_material_is_lost(size: float) -> None:
    """A strip with little more than the permeability of free space, in a field that varies: to first order in chi

    mu0 chi T int H . grad H dx, up to chi and the thickness.
    """
    chi = 1e-3
    found = held("strip", 1.0 + chi, VARYING, size)
    unit = MU_0 * chi * THICKNESS * LENGTH * SLOPE
    assert found["force_x"] == pytest.approx(unit * (FIELD + SLOPE * LENGTH / 2), rel=2e-3)
    assert found["force_y"] == pytest.approx(-unit * FIELD, rel=2e-3)


def test_the_error_of_a_rim_is_of_second_order_in_its_elements() -> None:
    torques = [held("strip", 1.5, UNIFORM, size)["torque_z"] for size in (6.0, 3.0, 1.5)]
    assert abs(torques[1] - torques[0]) < 0.03 * abs(torques[2])
    assert abs(torques[2] - torques[1]) < 0.35 * abs(torques[1] - torques[0])
