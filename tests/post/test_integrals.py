"""Integrals from the fields of an archive against closed forms and against what the solver recorded."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from embedding import Scene, load_scene, open_archive, solve
from embedding.archive import Recorder
from embedding.post import PostError, integrals
from embedding.scene.scales import EPSILON_0
from problems import charged_disc
from tests.archive.made_up_run import LENGTH, Problem, tell
from tests.post import runs

pytestmark = pytest.mark.usefixtures("unestimated")

PROBLEMS = Path(charged_disc.__file__).parent
DISC = """
name = "inflated disc"
[shell]
thickness = "0.5 mm"
shape = { kind = "disc", radius = "50 mm" }
material = { law = "neo-hookean", shear_modulus = "100 kPa" }
[[supports]]
where = "rim"
kind = "pinned"
[loads]
pressure_bottom = "400 Pa"
pressure_top = "100 Pa"
[[path]]
steps = 2
"""


@pytest.mark.parametrize("reduction", ["axisymmetric", "3d"])
def test_area_and_volume_of_a_spheroid(reduction: str, tmp_path: Path) -> None:
    """Half axes 0.85, 0.85, 1.35: volume 4/3 pi a^2 c, area 2 pi a (a + c asin(e) / e) with e^2 = 1 - a^2 / c^2."""
    a, c = 0.85 * LENGTH, 1.35 * LENGTH
    e = math.sqrt(1 - a**2 / c**2)
    exact = {"area": 2 * math.pi * a * (a + c * math.asin(e) / e), "volume": 4 / 3 * math.pi * a**2 * c}
    errors = []
    for size in (0.8, 0.4):
        path = tmp_path / "run.vtkhdf"
        tell(Recorder(path), Problem(reduction, size=size, order=3), steps=1)
        table = integrals(path)
        errors.append(max(abs(abs(float(table[name][0])) / value - 1) for name, value in exact.items()))
        assert all(0 < table[f"{name}_error"][0] < 5e-3 * value for name, value in exact.items())
    assert errors[1] < 0.7 * errors[0] and errors[1] < 2e-4, errors
    assert table.units["area"] == "m^2" and table.units["volume_error"] == "m^3"


def test_a_charged_sphere(tmp_path: Path) -> None:
    """C = 4 pi eps R, Q = C V, W = C V^2 / 2, no net force; errors fall, and are within what is said of them."""
    errors = []
    for size in (0.6, 0.3):
        table = integrals(runs.sphere(tmp_path, size))
        exact = {
            "capacitance": np.full(2, runs.CAPACITANCE),
            "charge_top": runs.CAPACITANCE * runs.VOLTAGE * np.array([0.5, 1.0]),
            "field_energy": runs.CAPACITANCE * runs.VOLTAGE**2 / 2 * np.array([0.25, 1.0]),
        }
        relative = {name: np.abs(table[name] / value - 1).max() for name, value in exact.items()}
        errors.append(max(relative.values()))
        for name in ("charge_top", "field_energy"):
            assert (np.abs(table[name] - exact[name]) <= table[f"{name}_error"]).all(), name
        pressure = open_archive(tmp_path / f"sphere{size}.vtkhdf").scalars["pressure_top"]
        pull = np.abs(pressure) * math.pi * runs.RADIUS**2
        assert (np.abs(table["force_z"]) <= table["force_z_error"]).all()
        assert (table["force_z_error"] < 0.01 * pull).all()
        assert np.abs(table["charge_bottom"]).max() < 1e-9 * table["charge_top"].max()
    assert errors[1] < 0.4 * errors[0] and errors[1] < 2e-3, errors
    assert {table.units[name] for name in ("charge_top", "capacitance", "force_z")} == {"C", "F", "N"}
    assert (table["capacitance_error"] < 1e-3 * table["capacitance"]).all()


@pytest.mark.parametrize(("shell", "ground"), [(20e3, 0.0), (0.0, -20e3)], ids=["charged shell", "charged ground"])
def test_a_sphere_over_a_conducting_half_space(shell: float, ground: float, tmp_path: Path) -> None:
    """W = C V^2 / 2 and F = V^2 C' / 2 of only the voltage between them, with the energy beyond the outer boundary,
    which is around the point of the surface below the shell. (W. R. Smythe, Static and Dynamic Electricity, 5.08)"""
    solution = runs.over_ground(tmp_path, shell, ground)
    table = integrals(tmp_path / "ground.vtkhdf", steps=[-1])
    exact = runs.over_ground_exact(abs(shell - ground))
    assert abs(table["field_energy"][0] - exact.energy) <= table["field_energy_error"][0] < 0.01 * exact.energy
    assert table["force_z"][0] == pytest.approx(exact.force, rel=1e-4)
    name = "capacitance" if shell else "capacitance_body0"
    assert table[name][0] == pytest.approx(exact.capacitance, rel=1e-4)
    assert abs(solution["charge_body0"][-1]) < 0.9 * exact.capacitance * 20e3, "the part within the radius"


def test_errors_at_a_rim_are_no_smaller_than_the_truth(tmp_path: Path) -> None:
    """Each side of a charged disc has half of Q = 8 eps R V, and nothing pulls it anywhere."""
    scene = load_scene(PROBLEMS / "charged_disc.toml", ["path=[{steps=1}]"])
    solve(scene, archive=tmp_path / "disc.vtkhdf", progress=False)
    table = integrals(tmp_path / "disc.vtkhdf")
    for name in ("charge_top", "charge_bottom"):
        assert abs(table[name][0] - 4 * EPSILON_0 * 0.02 * 1e3) <= table[f"{name}_error"][0]
    assert abs(table["force_z"][0]) <= table["force_z_error"][0]


def test_poles_have_a_permeance(tmp_path: Path) -> None:
    """Two poles at +-U in a grounded box of space: W = sum of U Phi / 2, in H and Wb."""
    solution = solve(Scene.from_toml(runs.POLES), archive=tmp_path / "poles.vtkhdf", progress=False)
    table = integrals(tmp_path / "poles.vtkhdf")
    flux = [solution[f"flux_body{number}"][0] for number in (0, 1)]
    assert flux[0] == pytest.approx(-flux[1], rel=1e-4)
    assert runs.POLE * (flux[0] - flux[1]) / 2 == pytest.approx(solution["field_energy"][0], rel=1e-6)
    assert table["permeance_body0"][0] == pytest.approx(flux[0] / runs.POLE)
    assert table.units["permeance_body0"] == "H" and "capacitance_body0" not in table
    assert open_archive(tmp_path / "poles.vtkhdf").scalar_units["potential_body1"] == "A"


def test_the_solver_and_the_fields_agree(tmp_path: Path) -> None:
    archive = open_archive(runs.sphere(tmp_path, 0.3, runs.SOFT))
    table, scalars = integrals(archive), archive.scalars
    assert scalars["stretch"][-1] > 1.1
    start = integrals(archive, steps=[0])["volume"][0] / scalars["volume_ratio"][0]
    np.testing.assert_allclose(table["volume"] / start, scalars["volume_ratio"], rtol=1e-6)
    np.testing.assert_allclose(table["charge_top"], scalars["charge"], rtol=3e-4)
    np.testing.assert_allclose(table["field_energy"], scalars["field_energy"], rtol=2e-3)


def test_pressures_on_a_clamped_disc(tmp_path: Path) -> None:
    """Whatever its shape, a shell over a flat rim feels the pressure difference times the area of the rim."""
    solve(Scene.from_toml(DISC), archive=tmp_path / "disc.vtkhdf", progress=False)
    table = integrals(tmp_path / "disc.vtkhdf")
    exact = 300.0 * math.pi * 0.05**2 * table["factor_mechanical"]
    np.testing.assert_allclose(table["force_z"], exact, rtol=1e-5)
    assert "volume" not in table
    assert (table["area"] > math.pi * 0.05**2).all()


def test_plane_strain_counts_per_metre(tmp_path: Path) -> None:
    path = tmp_path / "run.vtkhdf"
    tell(Recorder(path), Problem("plane-strain", size=0.4, order=3), steps=1)
    table = integrals(path)
    assert table["volume"][0] == pytest.approx(math.pi * 0.85 * 1.35 * LENGTH**2, rel=1e-3)
    assert [table.units[name] for name in ("area", "volume", "force_x", "charge_top")] == ["m", "m^2", "N/m", "C/m"]
    with pytest.raises(PostError, match="no column 'force_z'"):
        table["force_z"]
