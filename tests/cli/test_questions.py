"""`embedding probe|integrals|balance|compare`: tables for people, for programs, and one message for what is wrong."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from rich.console import Console

from embedding.archive import Recorder
from tests.archive.made_up_run import LENGTH, VOLTAGE, Problem, tell
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two archives, of two meshes, in the present folder."""
    monkeypatch.chdir(tmp_path)
    for name, size in (("one", 0.8), ("same", 0.8), ("other", 0.5)):
        tell(Recorder(tmp_path / f"{name}.vtkhdf"), Problem("axisymmetric", size=size, order=3), steps=2)
    return tmp_path


def test_probes(folder: Path, call: Call) -> None:
    at = ("--at", 0, 0, -0.01, "--at", "5 mm", "-5 mm", "0 mm")
    outcome = call("probe", "one.vtkhdf", *at, "--step", 2, "--json", "--csv", "p.csv")
    assert outcome.code == 0, outcome.err
    told = json.loads(outcome.out)
    assert told["columns"]["where"] == ["inside", "inside"] and told["units"]["E_z"] == "V/m"
    assert told["columns"]["E_z"] == [pytest.approx(0.4 * 1.8 * VOLTAGE / LENGTH, rel=1e-4)] * 2
    assert told["columns"]["y"] == [0.0, -0.005] and told["columns"]["step"] == [2, 2]
    assert len((folder / "p.csv").read_text().splitlines()) == 3
    people = call("probe", "one.vtkhdf", "--at", 9, 0, 0).out
    assert "phi [V]" in people and "beyond the meshed space" in people and " - " in people


def test_a_line_and_its_picture(folder: Path, call: Call) -> None:
    outcome = call("probe", "one.vtkhdf", "--from", 0, 0, 0, "--to", "50 mm", 0, 0, "--points", 7, "--picture", "l.png")
    assert outcome.code == 0, outcome.err
    assert "distance [m]" in outcome.out and (folder / "l.png").stat().st_size > 10_000


def test_material_points(folder: Path, call: Call) -> None:
    words = ("probe", "one.vtkhdf", "--shell", "--at", LENGTH, 0, 0, "--step", 2, "--json")
    told = json.loads(call(*words, "--field", "p_b", "--field", "p_t").out)["columns"]
    assert told["p_t"] == [pytest.approx(40, rel=1e-4)] and told["p_b"] == [pytest.approx(40, rel=1e-2)]
    told = json.loads(call(*words, "--side", "top").out)["columns"]
    assert told["where"] == ["outside"] and "phi" in told


def test_no_number_is_cut_short(folder: Path, call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    """A table with more columns than there is room for comes in parts, each with the step and the point."""
    monkeypatch.setattr("embedding.cli.tables.console", lambda: Console(width=60))
    told = call("probe", "one.vtkhdf", "--shell", "--at", LENGTH, 0, 0).out
    assert "\u2026" not in told
    headings = [line for line in told.splitlines() if "step" in line]
    assert len(headings) > 1 and all("point" in line for line in headings)


@pytest.mark.parametrize(
    ("words", "part"),
    [
        ((), "--at: give points with --at, or a line"),
        (("--at", 0, 0, 0, "--from", 0, 0, 0), "--at: give points with --at, or a line"),
        (("--from", 0, 0, 0), "a line needs both --from and --to"),
        (("--shell", "--from", 0, 0, 0, "--to", 1, 0, 0), "--shell: give material points with --at"),
        (("--at", 0, 0, "5 V"), '--at: 0 0 5 V is not a point: "V" is a unit of'),
        (("--at", 0, 0, 0, "--side", "left"), "no side 'left'"),
        (("--at", 0, 0, 0, "--field", "H"), "no field 'H'; there are u, phi, E"),
        (("--at", 0, 0, 0, "--step", 3), "--step: 3 is not allowed: the archive has steps 1 to 2"),
        (("--at", 0, 0, 0, "--csv", "x.txt"), "--csv: 'x.txt' must end in '.csv'"),
    ],
)
def test_probes_that_cannot_be(folder: Path, call: Call, words: tuple[object, ...], part: str) -> None:
    outcome = call("probe", "one.vtkhdf", *words)
    assert (outcome.code, outcome.out) == (2, "") and part in outcome.err


def test_integrals(folder: Path, call: Call) -> None:
    told = json.loads(call("integrals", "one.vtkhdf", "--json").out)
    assert told["columns"]["step"] == [1, 2] and told["units"]["area"] == "m^2"
    assert "±" in call("integrals", "one.vtkhdf", "--step", 1, "--csv", "i.csv").out
    assert (folder / "i.csv").read_text().startswith("step,factor_mechanical,factor_field,area [m^2],area_error [m^2]")


def test_balance(scene_file: Path, call: Call) -> None:
    call("run", scene_file, "--no-progress", "--out", "mine.vtkhdf")
    outcome = call("balance", "mine.vtkhdf")
    assert outcome.code == 0 and "work_pressure [J]" in outcome.out and "path_error [J]" in outcome.out
    told = json.loads(call("balance", "mine.vtkhdf", "--json", "--csv", "b.csv").out)["columns"]
    assert abs(told["residual_cubic"][-1]) < 0.05 * told["stored"][-1]


def test_a_comparison(folder: Path, call: Call) -> None:
    same = call("compare", "one.vtkhdf", "same.vtkhdf")
    assert same.code == 0 and "the same to 1e-06 at 2 common loads" in same.out
    other = call("compare", "one.vtkhdf", "other.vtkhdf", "--csv", "c.csv")
    assert other.code == 4 and "different" in other.out and "outside.E" in other.out
    told = json.loads(call("compare", "one.vtkhdf", "other.vtkhdf", "--tolerance", 10, "--json").out)
    assert told["same"] and told["common_steps"] == 2 and told["scene"] == []
    assert (folder / "c.csv").exists()
