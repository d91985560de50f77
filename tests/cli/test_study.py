"""`embedding study` and `embedding table`: what they print and write, and what is refused."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pandas
import pytest

from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]
STUDY = """
name = "two balloons"
scene = "balloon.toml"

[parameters]
loads.pressure_bottom = ["500 Pa", "2 kPa"]

[quantities]
stretch = "stretch"
reached = "pressure_difference at last"
"""


@pytest.fixture
def study_file(scene_file: Path) -> Path:
    path = scene_file.parent / "two.toml"
    path.write_text(STUDY)
    return path


def test_a_study_and_its_table(study_file: Path, call: Call) -> None:
    outcome = call("study", study_file, "--workers", 1)
    assert outcome.code == 0
    assert outcome.out.splitlines()[0] == "two balloons: 2 cases, 1 done, 1 diverged"
    assert outcome.out.splitlines()[1].startswith("  case 2: diverged: LIMIT_POINT: stopped after ")
    assert outcome.out.splitlines()[2] == f"  {study_file.parent / 'two'}"
    assert outcome.err.splitlines()[0] == "two balloons: 2 cases"
    assert outcome.err.splitlines()[1].startswith("1/2 case 1: done in ")

    outcome = call("table", "two", "--csv", "two.csv", "--parquet", "two.parquet")
    assert outcome.code == 0
    heading, first, second, reason = outcome.out.splitlines()
    assert heading.split() == ["case", "loads.pressure_bottom", "[Pa]", "stretch", "reached", "[Pa]", "status"]
    assert first.split() == ["1", "500", "1.05219", "500", "done"]
    assert second.split()[:3] == ["2", "2000", "nan"]
    assert reason.startswith("  case 2: diverged: LIMIT_POINT: ")
    table = pandas.read_csv("two.csv")
    assert list(table["status"]) == ["done", "diverged"]
    assert list(table["loads.pressure_bottom [Pa]"]) == [500.0, 2000.0]
    assert list(pandas.read_parquet("two.parquet")["loads.pressure_bottom"]) == [500.0, 2000.0]

    pressure = ("--over", "loads.pressure_bottom")
    outcome = call("table", "two", "--chart", "two.png", "--of", "reached", *pressure)
    assert outcome.code == 0
    assert Path("two.png").read_bytes().startswith(b"\x89PNG")
    outcome = call("table", "two", "--chart", "three.png", "--of", "strech", *pressure)
    assert outcome.code == 2
    assert outcome.err.startswith("error: strech: the table has no numbers of that name; it has ")
    assert not Path("three.png").exists()

    report = json.loads(call("table", "two", "--json").out)
    assert report["counts"] == {"done": 1, "diverged": 1}
    assert report["units"]["reached"] == "Pa"
    assert report["rows"][0]["quantities"]["stretch"] == pytest.approx(1.0522, abs=1e-4)
    assert report["rows"][1]["quantities"]["stretch"] is None


def test_an_interrupt_ends_the_cases_and_is_130(study_file: Path) -> None:
    folder = study_file.parent
    study_file.write_text(STUDY.replace("[parameters]", "[parameters]\npath.0.steps = [9000]"))
    command = [sys.executable, "-m", "embedding.cli", "study", study_file.name, "--workers", "1", "--no-progress"]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(command, cwd=folder, env=environment, stderr=subprocess.PIPE, text=True) as study:
        while not (told := list((folder / "two").glob("cases/*/progress.json"))):
            assert study.poll() is None
            time.sleep(0.01)
        case = json.loads(told[0].read_text())["process"]
        study.send_signal(signal.SIGINT)
        _, message = study.communicate()
    assert (study.returncode, message) == (130, "error: interrupted\n")
    status = Path(f"/proc/{case}/status")
    assert not status.exists() or "State:\tZ" in status.read_text()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("study", "nowhere.toml"), "error: nowhere.toml: there is no such file\n"),
        (("study", "two.toml", "--workers", 0), "error: --workers: 0 is not allowed: must be at least 1\n"),
        (("table", "two.toml"), "not the folder of a study: there is no study.toml in it\n"),
        (("table", ".", "--csv", "two.txt"), "error: --csv: 'two.txt' must end in '.csv'\n"),
        (
            ("table", ".", "--chart", "two.png", "--of", "stretch"),
            "error: --chart: say --of COLUMN and --over COLUMN, or --over twice for a map\n",
        ),
        (("table", ".", "--parquet", "two"), "error: --parquet: 'two' must end in '.parquet'\n"),
    ],
)
def test_what_cannot_be_is_one_message(study_file: Path, call: Call, words: tuple[str, ...], message: str) -> None:
    outcome = call(*words)
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err.endswith(message)
    assert not (study_file.parent / "two").exists()
