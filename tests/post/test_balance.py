"""The balance of energies closes, to the order of the rule that sums the work, in every kind of scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import Scene, load_scene, solve
from embedding.post import PostError, Table, energy_balance
from problems import charged_balloon
from tests.balloons import SMALL
from tests.bent import clamped, mesh, metal, scene_of
from tests.post import runs

pytestmark = pytest.mark.usefixtures("unestimated")

PROBLEMS = Path(charged_balloon.__file__).parent
STRIP = scene_of(
    {"kind": "strip", "length": 10.0}, 0.1, metal(youngs_modulus=1.2e6), supports=clamped("x0"),
    loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, 4.0, 0.0]}]}, discretisation=mesh(3, 1.0),
)  # fmt: skip
PLATE = scene_of(
    {"kind": "plate", "length": 10.0, "width": 1.0}, 0.1, metal(youngs_modulus=1.2e6), supports=clamped("x0"),
    loads={"edge_tractions": [{"edge": "x1", "traction": [0.0, 0.0, 4.0]}]}, discretisation=mesh(3, 2.5),
)  # fmt: skip
PULLED = scene_of(
    {"kind": "strip", "length": 1.0}, 0.1, {"law": "neo-hookean", "shear_modulus": 1.0},
    supports=[*clamped("x0"), {"where": "x1", "fix": ["x"], "displacement": [0.5, 0.0, 0.0]}],
    discretisation=mesh(3, 0.5),
)  # fmt: skip
DISC = Scene.from_toml(
    """
name = "disc"
[shell]
thickness = "5 mm"
shape = { kind = "disc", radius = "50 mm" }
material = { law = "neo-hookean", shear_modulus = "100 kPa" }
[[supports]]
where = "rim"
kind = "clamped"
[loads]
pressure_bottom = "2 kPa"
[discretisation]
shell_size = "10 mm"
"""
)


def balanced(scene: Scene, steps: int, folder: Path, stage: int = 0) -> Table:
    """The balance of a scene that is loaded in so many equal steps, and those of any other stage in twice as few."""
    changes = [f"path.{stage}.steps={steps}", f'path.{stage}.control="load"']
    changes += [f"path.{other}.steps={steps // 2}" for other in range(len(scene.path)) if other != stage]
    path = folder / "run.vtkhdf"
    solve(scene.with_overrides(changes), archive=path, progress=False)
    return energy_balance(path)


def worst(table: Table, name: str) -> float:
    """Largest size of a column, relative to the largest stored energy."""
    return float(np.abs(table[name]).max() / table["stored"].max())


SCENES: dict[str, tuple[Any, int, set[str]]] = {
    "pressure in a balloon": (Scene.from_toml(SMALL), 4, {"work_pressure"}),
    "pressure on a disc": (DISC, 8, {"work_pressure"}),
    "a force on a strip": (STRIP, 5, {"work_loads"}),
    "a force on a plate": (PLATE, 4, {"work_loads"}),
    "a support that moves": (PULLED, 4, {"work_supports"}),
}


@pytest.mark.parametrize("name", SCENES)
def test_the_balance_closes_as_its_rule(name: str, tmp_path: Path) -> None:
    """Halved steps: forces taken at the beginning are half as wrong, the trapezoidal rule a quarter, and the terms of
    first order have vanished from it."""
    scene, steps, works = SCENES[name]
    coarse, fine = (balanced(scene, n, tmp_path) for n in (steps, 2 * steps))
    assert works <= fine.columns.keys()
    assert worst(coarse, "residual_explicit") / worst(fine, "residual_explicit") == pytest.approx(2.0, abs=0.25)
    assert worst(coarse, "residual") / worst(fine, "residual") == pytest.approx(4.0, abs=0.9)
    assert (np.abs(fine["residual"]) <= 1.5 * fine["path_error"] + 1e-6 * fine["stored"].max()).all()
    assert worst(fine, "residual_cubic") < 0.1 * worst(fine, "residual") + 2e-6


@pytest.mark.slow
def test_a_voltage_on_a_dielectric_balloon(tmp_path: Path) -> None:
    """Pressure first, then a voltage."""
    scene = load_scene(PROBLEMS / "dielectric_balloon.toml")
    tables = [balanced(scene, n, tmp_path, stage=1) for n in (6, 12)]
    assert {"work_pressure", "work_sources"} <= tables[0].columns.keys()
    for name, power in (("residual_explicit", 1), ("residual", 2)):
        sizes = [worst(table, name) for table in tables]
        assert np.log2(sizes[0] / sizes[1]) == pytest.approx(power, abs=0.25), name
    assert worst(tables[1], "residual_cubic") < worst(tables[0], "residual_cubic") / 6
    assert worst(tables[1], "residual_cubic") < 1e-4


def test_a_charged_balloon_in_free_space(tmp_path: Path) -> None:
    """The source gives twice what the field keeps; the balance closes to the error of the path and of the ambient's
    mesh, which the equilibrium sees."""
    scene = load_scene(PROBLEMS / "charged_balloon.toml")
    coarse, fine = (balanced(scene, n, tmp_path) for n in (5, 10))
    assert worst(coarse, "residual") / worst(fine, "residual") == pytest.approx(4.0, abs=0.4)
    assert worst(fine, "residual_cubic") < 1e-4
    assert worst(fine, "residual") < 3e-3


@pytest.mark.parametrize(("shell", "ground"), [(20e3, 0.0), (0.0, -20e3)], ids=["charged shell", "charged ground"])
def test_a_voltage_over_a_half_space(shell: float, ground: float, tmp_path: Path) -> None:
    """Nothing moves: the source gives C V^2, as little as it matters which of both has the voltage."""
    runs.over_ground(tmp_path, shell, ground)
    table, energy = energy_balance(tmp_path / "ground.vtkhdf"), runs.over_ground_exact(20e3).energy
    assert table["field_energy"][-1] == pytest.approx(energy, rel=1e-5)
    assert table["work_sources"][-1] == pytest.approx(energy, rel=1e-5)
    np.testing.assert_array_equal(table["work_sources"], table["work"])
    assert np.abs(table["residual"]).max() < 1e-9 * energy


def test_stages_may_share_a_name(tmp_path: Path) -> None:
    """There and back: no curve goes around the kink."""
    scene = STRIP.with_overrides(["path=[{steps=6, control='load'}, {steps=6, control='load', mechanical=0.0}]"])
    solve(scene, archive=tmp_path / "run.vtkhdf", progress=False)
    table = energy_balance(tmp_path / "run.vtkhdf")
    assert worst(table, "residual_cubic") < 2e-4
    assert (np.abs(table["residual"]) <= 1.5 * table["path_error"] + 1e-6 * table["stored"].max()).all()


def test_one_step_does_not_tell_its_error(tmp_path: Path) -> None:
    table = balanced(STRIP, 1, tmp_path)
    assert worst(table, "residual") > 0.05
    assert np.isnan(table["path_error"]).all()
    for steps in (2, 3):
        table = balanced(STRIP, steps, tmp_path)
        assert (np.abs(table["residual"]) <= 1.5 * table["path_error"]).all()


def test_an_electret_does_not_begin_at_rest(tmp_path: Path) -> None:
    """Its field is there before any load: the balance counts from the first step."""
    text = runs.SOFT.split("[ambient]")[0] + 'polarisation = [0.0, 0.0, 2e-5]\n[ambient]\nfield = "electric"\n'
    text += '[loads]\npressure_bottom = "500 Pa"\n[[path]]\nsteps = 6\n'
    solve(Scene.from_toml(text), archive=tmp_path / "run.vtkhdf", progress=False)
    table = energy_balance(tmp_path / "run.vtkhdf")
    assert table["work"][0] == 0.0 and table["field_energy"][0] > 1e-5
    assert worst(table, "residual_cubic") < 1e-6


def test_a_given_charge(tmp_path: Path) -> None:
    """No battery is needed: the source brings the charge at the voltage that there is."""
    scene = load_scene(PROBLEMS / "charged_balloon.toml", ['faces={both={charge="1.9 uC"}}'])
    coarse, fine = (balanced(scene, n, tmp_path) for n in (4, 8))
    assert worst(coarse, "residual") / worst(fine, "residual") == pytest.approx(4.0, abs=0.4)
    assert worst(fine, "residual_cubic") < 2e-4


TIP = {"edge": "x1", "traction": [0.0, 0.0, 1e-8], "frame": "edge", "kind": "follower"}
PARTS: dict[str, Any] = {"supports": clamped("x0"), "discretisation": mesh(2, 5.0)}
REFUSED = {
    "where a field is applied": load_scene(PROBLEMS / "sphere_in_field.toml", ["path=[{steps=1}]"]),
    "is in equilibrium with its own field": load_scene(
        PROBLEMS / "charged_balloon.toml",
        ["path=[{steps=1}]", 'model.coupling="once"', 'faces={both={voltage="100 kV"}}'],
    ),
    "forces that follow an edge": scene_of(
        {"kind": "plate", "length": 10.0, "width": 5.0}, 0.1, metal(), loads={"edge_tractions": [TIP]}, **PARTS
    ),
    "moments on edges in space": scene_of(
        {"kind": "plate", "length": 10.0, "width": 5.0}, 0.1, metal(),
        loads={"edge_moments": [{"edge": "x1", "moment": 1e-7}]}, **PARTS,
    ),
}  # fmt: skip


@pytest.mark.parametrize("reason", REFUSED)
def test_what_is_not_recorded_is_said(reason: str, tmp_path: Path) -> None:
    solve(REFUSED[reason], archive=tmp_path / "a.vtkhdf", progress=False)
    with pytest.raises(PostError, match=reason):
        energy_balance(tmp_path / "a.vtkhdf")
