"""The studies of actuators that are shipped: every cell of their tables against a closed form."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from embedding import solve
from embedding.studies import StudyResult, cases_of, charts, run_study
from problems.common import Probe, Reading
from problems.membrane_pull_in import gap, tension
from problems.studies import balloon_stroke, common, disc_force, magnetic_strip, pull_in_map, shielding

LEVEL, TENSION = "ambient.bodies.0.level", "loads.edge_tractions.0.traction.0"
PARTS: dict[ModuleType, dict[str, list[int]]] = {
    balloon_stroke: {"shell.thickness": [0], "loads.pressure_bottom": [0, 3], "faces.bottom.voltage": [4, 9]},
    disc_force: {"path.2.until.value": [1], "faces.bottom.voltage": [2, 7]},
    pull_in_map: {LEVEL: [5], TENSION: [2]},
    magnetic_strip: {"shell.remanence.0": [2, 5], "ambient.applied_field.1": [3]},
    shielding: {"shell.thickness": [0, 7], "shell.relative_permeability": [1, 9]},
}


def check_balloon(result: StudyResult) -> None:
    """Membranes act on their mid-surface: what is left of the thin balloon is the mesh. Each pulls in where it must."""
    found = balloon_stroke.errors(result)
    assert found["cases that pull in on one side only"] == 0
    assert found["largest error of the stretch"] < 1e-5
    assert {row.reason.partition(":")[0] for row in result.rows} == {"", "PULL_IN"}


def check_disc(result: StudyResult) -> None:
    """A uniform strain is exact."""
    found = disc_force.errors(result)
    assert found["cases that pull in on one side only"] == 0
    assert found["largest error of the force"] < 1e-9
    assert found["largest error of the stroke"] < 1e-9


def check_pull_in(result: StudyResult) -> None:
    """What the closed form leaves out is of second order in the gap, and the same multiple of it everywhere."""
    ratios = np.array([gap(scene) / tension(scene)[1] for scene, _ in common.cases(result)])
    columns = result.columns()
    error = np.array(columns["pull_in"]) / np.array(columns["known"]) - 1.0
    assert np.all(np.abs(error) < 0.5 * ratios**2)
    left = pull_in_map.remainders(result)
    np.testing.assert_allclose(left, 0.77, atol=0.015)


def check_strip(result: StudyResult) -> None:
    """The strip stretches as the square of its thickness over its length."""
    shell = result.study.scene.shell
    assert np.all(magnetic_strip.relative(result) < 7.0 * (shell.thickest / shell.shape.size) ** 2)


def check_shield(result: StudyResult) -> None:
    """Second order in the thickness over the radius, at any permeability."""
    ratio = np.array(result.columns()["shell.thickness"]) / result.study.scene.shell.shape.size
    assert np.all(shielding.relative(result) < 0.3 * ratio**2)


CHECKS = {
    balloon_stroke: check_balloon, disc_force: check_disc, pull_in_map: check_pull_in, magnetic_strip: check_strip,
    shielding: check_shield,
}  # fmt: skip
NAMES = [pytest.param(module, id=module.NAME) for module in PARTS]
COUNTS = {"balloon_stroke": 240, "disc_force": 27, "pull_in_map": 36, "magnetic_strip": 60, "shielding": 96}


def solved(module: ModuleType, part: dict[str, list[int]] | None, folder: Path) -> StudyResult:
    result: StudyResult = module.complete(run_study(common.study(module.NAME, part), folder))
    return result


@pytest.mark.parametrize("module", NAMES)
def test_some_cases(module: ModuleType, tmp_path: Path) -> None:
    CHECKS[module](solved(module, PARTS[module], tmp_path / "study"))


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("module", NAMES)
def test_every_case(module: ModuleType, tmp_path: Path) -> None:
    result = solved(module, None, tmp_path / "study")
    assert len(result.rows) == COUNTS[module.NAME]
    CHECKS[module](result)
    chart = charts.save(module.draw(result), tmp_path / "chart.png")
    assert chart.stat().st_size > 20_000


def test_the_strip_is_an_elastica_as_it_gets_thin() -> None:
    """Half the thickness at the same load of the elastica: a quarter of the error."""
    found = []
    (case,) = cases_of(common.study("magnetic_strip", {"shell.remanence.0": [2], "ambient.applied_field.1": [5]}))
    assert case.scene is not None
    for factor in (1.0, 0.5):
        field, thickness = factor**2 * 3e3, factor * case.scene.shell.thickest
        scene = case.scene.with_overrides([f"shell.thickness={thickness!r}", f"ambient.applied_field.1={field!r}"])
        probe = Probe({"tip": Reading((scene.shell.shape.size, 0.0, 0.0), "y")})
        solve(scene, listeners=[probe])
        found.append(probe.values["tip"][-1] - magnetic_strip.known(scene))
    assert found[0] / found[1] == pytest.approx(4.0, rel=0.1)
