"""Studies along a parameter: each case starts from the state of the one before, and ends where a cold start ends."""

from __future__ import annotations

import signal
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import Scene, load_scene
from embedding.studies import Grid, Study, StudyResult, cases_of, run_study
from problems import dielectric_balloon
from problems.studies import common, magnetic_strip
from tests.balloons import SMALL
from tests.studies.samples import PRESSURE, keys, signals, study
from tests.studies.test_running import begun, stretch

THICKNESS, FIELD = "shell.thickness", "ambient.applied_field.1"
REACHED = {"stretch": "stretch", "reached": "pressure_difference"}


def along(path: str, parameters: Mapping[str, Any], **fields: Any) -> Study:
    """A continuation along ``path``."""
    return study(parameters, **{"design": {"kind": "grid", "along": path}, "quantities": REACHED, **fields})


def starts(result: StudyResult) -> list[str]:
    return [row.start for row in result.rows]


def test_each_case_starts_from_the_one_before(tmp_path: Path) -> None:
    """The numbers of the closed form and of cold starts, with fewer Newton iterations."""
    parameters = {PRESSURE: [300, 600, 900]}
    warm = run_study(along(PRESSURE, parameters, scene=Scene.from_toml(SMALL)), tmp_path / "warm")
    cold = run_study(study(parameters, scene=Scene.from_toml(SMALL), quantities=REACHED), tmp_path / "cold")
    assert starts(warm) == ["rest", "neighbour", "neighbour"]
    assert starts(cold) == ["rest"] * 3
    for one, other in zip(warm.rows, cold.rows, strict=True):
        assert one.quantities["reached"] == pytest.approx(one.parameters[PRESSURE], rel=1e-12)
        assert one.quantities["stretch"] == pytest.approx(other.quantities["stretch"], rel=1e-9)
        assert one.quantities["stretch"] == pytest.approx(stretch(one.quantities["reached"]), rel=2e-4)
    assert warm.rows[0].case == cold.rows[0].case
    assert not {row.case for row in warm.rows[1:]} & {row.case for row in cold.rows}
    spent = [sum(row.iterations for row in result.rows[1:]) for result in (warm, cold)]
    assert spent[0] <= 0.6 * spent[1]


def test_a_broken_chain_goes_on(tmp_path: Path) -> None:
    """A case that is killed is passed over; the next run solves it alone, from the one before it."""
    stated = along(PRESSURE, {PRESSURE: [300, 600, 900]})
    folder, names = tmp_path / "study", keys(stated)
    with signals(folder, {names[0]: signal.SIGKILL}):
        first = run_study(stated, folder)
    assert [row.status for row in first.rows] == ["killed", "done", "done"]
    assert starts(first) == ["", "rest: no case before it is done", "neighbour"]
    before = begun(folder, names)
    last = run_study(stated, folder)
    assert [name for name, at in begun(folder, names).items() if at != before[name]] == names[:1]
    assert last.counts() == {"done": 3}


def test_why_a_case_starts_from_rest(tmp_path: Path) -> None:
    """Beyond the limit pressure the path from the neighbour ends there; with a wall too thin for the pressure there is
    no way at all."""
    stated = along(PRESSURE, {PRESSURE: [1000, 2000, 900]}, quantities={"reached": "pressure_difference at last"})
    result = run_study(stated, tmp_path / "limit")
    assert [row.status for row in result.rows] == ["done", "diverged", "done"]
    assert starts(result) == ["rest", "neighbour", "neighbour"]
    assert result.rows[1].reason.startswith("LIMIT_POINT: ")
    assert result.rows[1].quantities["reached"] == pytest.approx(1239, rel=2e-3)

    result = run_study(along(THICKNESS, {THICKNESS: ["0.2 mm", "0.05 mm", "0.18 mm"]}), tmp_path / "thin")
    assert [row.status for row in result.rows] == ["done", "diverged", "done"]
    assert starts(result)[1].startswith("rest: Newton's method does not get there from its neighbour (")
    assert starts(result)[2] == "neighbour"

    sizes = "discretisation.shell_size"
    result = run_study(along(sizes, {sizes: ["5 mm", "4 mm"]}), tmp_path / "mesh")
    assert result.counts() == {"done": 2}
    assert starts(result) == ["rest", "rest: it has another mesh or other unknowns than its neighbour"]


def test_which_case_is_before_which() -> None:
    """Along an axis, whatever place it has; a case that is refused is no start for the next one."""
    parameters = {THICKNESS: ["0.2 mm", "50 mm", "0.3 mm"], PRESSURE: [500, 600]}
    before = [case.before for case in cases_of(along(THICKNESS, parameters))]
    assert before == [None, None, 0, 1, 0, 1]
    assert [case.before for case in cases_of(along(PRESSURE, parameters))] == [None, 0, None, None, None, 4]


@pytest.mark.slow
def test_a_strip_bends_on(tmp_path: Path) -> None:
    """Over the field, in bending by tens of degrees, to the same elastica as from rest."""
    stated = common.study("magnetic_strip", {"shell.remanence.0": [4], FIELD: [5, 6, 7]})
    fields = {name: getattr(stated, name) for name in ("scene", "parameters", "quantities")}
    warm = magnetic_strip.complete(run_study(Study(**fields, design=Grid(along=FIELD)), tmp_path / "warm"))
    cold = magnetic_strip.complete(run_study(stated, tmp_path / "cold"))
    assert starts(warm) == ["rest", "neighbour", "neighbour"]
    np.testing.assert_allclose(warm.columns()["deflection"], cold.columns()["deflection"], rtol=1e-6)  # float32
    assert np.all(magnetic_strip.relative(warm) < 3e-3)
    assert sum(row.iterations for row in warm.rows[1:]) < 0.3 * sum(row.iterations for row in cold.rows[1:])


VOLTAGE = "faces.bottom.voltage"
BALLOON = load_scene(dielectric_balloon.SCENE)


def charged(values: list[float], **design: Any) -> Study:
    parameters = {VOLTAGE: values, "shell.material.shear_modulus": ["30 kPa", "33 kPa"]}
    design = {"kind": "grid", **design}
    return Study(scene=BALLOON, parameters=parameters, quantities={"stretch": "stretch"}, design=design)


@pytest.mark.slow
@pytest.mark.parametrize("path", [VOLTAGE, "shell.material.shear_modulus"])
def test_shell_and_field_start_together(path: str, tmp_path: Path) -> None:
    """The balloon with a field in its wall and around it, over the voltage, and over the stiffness, whose scales are
    others; against the closed form of the thin balloon."""
    values = [5e3, 10e3, 14e3]
    warm = run_study(charged(values, along=path), tmp_path / "warm")
    cold = run_study(charged(values), tmp_path / "cold")
    assert starts(warm).count("neighbour") == (4 if path == VOLTAGE else 3)
    stretches = [np.array(result.columns()["stretch"]) for result in (warm, cold)]
    np.testing.assert_allclose(*stretches, rtol=1e-8)
    scenes = [case.scene for case in cases_of(warm.study)]
    known = [
        dielectric_balloon.exact(scene, "membrane").stretch(dielectric_balloon.voltage(scene), 600.0)
        for scene in scenes
        if scene is not None
    ]
    np.testing.assert_allclose(stretches[0], known, rtol=1e-4)
    followed = [number for number, row in enumerate(warm.rows) if row.start == "neighbour"]
    spent = [sum(result.rows[number].iterations for number in followed) for result in (warm, cold)]
    assert spent[0] < 0.25 * spent[1]
