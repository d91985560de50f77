"""The named fields of a state, in SI units, against closed forms."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import Scene, open_archive, solve
from embedding.archive import Archive
from embedding.scene.scales import EPSILON_0, MU_0

pytestmark = pytest.mark.usefixtures("unestimated")

R, VOLTAGE, LIQUID = 0.02, 5e3, 2.5
SPHERE: dict[str, Any] = {
    "shape": {"kind": "sphere", "radius": R},
    "thickness": 2e-4,
    "material": {"law": "neo-hookean", "shear_modulus": 1e5},
}


def archived(tmp_path: Path, **table: Any) -> Archive:
    path = tmp_path / "run.vtkhdf"
    solve(Scene.from_table({"path": [{"steps": 1}], **table}), archive=path)
    return open_archive(path)


@pytest.mark.parametrize(("order", "within"), [(2, 1e-2), (3, 1.5e-3)])
def test_flux_and_energy_around_a_charged_sphere(tmp_path: Path, order: int, within: float) -> None:
    """E = V R / r^2 in a liquid; D = eps E, w = eps E^2 / 2; beside the shell, where the field is largest."""
    archive = archived(
        tmp_path,
        shell=SPHERE,
        ambient={"field": "electric", "relative_permittivity": LIQUID},
        faces={"both": {"voltage": VOLTAGE}},
        supports=[{"where": "surface", "fix": ["x", "y", "z"]}],
        model={"interface": "closed"},
        discretisation={"order": order},
    )
    block = archive.block("outside")
    radius = np.linalg.norm(block.points, axis=1)
    near = radius < 2 * R
    exact = VOLTAGE * R / radius**2
    assert (block.units["D"], block.units["energy_density"]) == ("C/m^2", "J/m^3")
    for name, known in (
        ("E", exact),
        ("D", LIQUID * EPSILON_0 * exact),
        ("energy_density", 0.5 * LIQUID * EPSILON_0 * exact**2),
    ):
        values = block.field(name)
        found = np.linalg.norm(values, axis=1) if values.ndim == 2 else values
        assert np.abs(found / known - 1.0)[near].max() < within * (2 if name == "energy_density" else 1)
    assert np.abs(archive.block("inside").field("D")).max() < 1e-6 * LIQUID * EPSILON_0 * VOLTAGE / R


def test_flux_density_in_a_uniform_magnetic_field(tmp_path: Path) -> None:
    """A shell that is not magnetic leaves it as it is."""
    strength = 1e4
    archive = archived(
        tmp_path,
        shell={**SPHERE, "relative_permeability": 1.0},
        ambient={"field": "magnetic", "applied_field": [0.0, 0.0, strength]},
        discretisation={"order": 2},
    )
    for side in ("inside", "outside"):
        block = archive.block(side)
        assert block.units["B"] == "T"
        assert block.field("B")[:, 2] == pytest.approx(MU_0 * strength, rel=1e-3)
        assert block.field("energy_density") == pytest.approx(0.5 * MU_0 * strength**2, rel=1e-3)


def test_the_thickness_of_a_balloon(tmp_path: Path) -> None:
    """T over the stretch of the area, as it keeps its volume."""
    archive = archived(tmp_path, shell=SPHERE, loads={"pressure_bottom": 500.0}, discretisation={"order": 2})
    block = archive.block("shell")
    assert block.units["thickness"] == "m"
    assert block.field("thickness") == pytest.approx(2e-4 / archive.scalars["stretch"][-1] ** 2, rel=1e-4)
