"""Running a study: every way a case can end is a row, a rerun does what is missing, and a kill loses nothing."""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from embedding import open_archive, solve
from embedding.errors import Problem, SceneError
from embedding.studies import Study, StudyError, StudyResult, cases_of, load_study, open_study, run_study
from embedding.studies.files import CaseFolder, StudyFolder, write_case
from embedding.studies.index import Index, read_index
from embedding.studies.pool import death
from embedding.studies.worker import Progress, outcome
from tests.studies.samples import PRESSURE, balloon, keys, process_of, signals, study

LIMIT = "2 kPa"
"""Above the limit pressure of the balloon, 1.24 kPa: no equilibrium."""

LATE, KILLED, DIVERGED = 0, 1, 2
"""Cases that do not come to their end. The late one stands still as soon as it has begun."""


def mixed(done: int, seconds: float) -> Study:
    """Three cases that fail, each in its way, and others that do not."""
    pressures = [100, 200, LIMIT, *np.linspace(300, 1000, done).tolist()]
    return study({PRESSURE: pressures}, limits={"seconds": seconds, "workers": 2})


def run_mixed(stated: Study, folder: Path) -> StudyResult:
    names = keys(stated)
    with signals(folder, {names[LATE]: signal.SIGSTOP, names[KILLED]: signal.SIGKILL}):
        return run_study(stated, folder)


def stretch(pressure: float) -> float:
    """Of the thin neo-Hookean balloon under ``pressure``, on its rising branch.

    p R / T = 2 mu (1/l - 1/l^7), see Green and Adkins (1970).
    """
    from scipy.optimize import brentq

    return float(brentq(lambda s: 2 * 1e5 * 2e-4 / 0.02 * (1 / s - s**-7) - pressure, 1, 1.38))


def check_rows(result: StudyResult, seconds: float) -> None:
    """Three rows with their reasons, and the closed form in all others."""
    rows = result.rows
    reasons = {
        LATE: ("over time", f"not done after {seconds:g} s"),
        KILLED: ("killed", "the process was ended by SIGKILL, as the system does where memory is short"),
        DIVERGED: ("diverged", "LIMIT_POINT: "),
    }
    for place, (status, reason) in reasons.items():
        assert rows[place].status == status
        assert rows[place].reason.startswith(reason)
        assert np.isnan(rows[place].quantities["stretch"])
    assert rows[DIVERGED].quantities["reached"] == pytest.approx(1239, rel=2e-3)
    for row in rows[3:]:
        assert (row.status, row.reason) == ("done", "")
        pressure = row.parameters[PRESSURE]
        assert isinstance(pressure, float)
        assert row.quantities["reached"] == pytest.approx(pressure, rel=1e-9)
        # the membrane acts on its mid-surface: what is left is the mesh
        assert row.quantities["stretch"] == pytest.approx(stretch(pressure), rel=2e-4)


def begun(folder: Path, names: Sequence[str]) -> dict[str, int]:
    """When the present attempts at cases were begun."""
    return {name: (folder / "cases" / name / "scene.toml").stat().st_mtime_ns for name in names}


def carried_out(done: int, seconds: float, folder: Path) -> None:
    """The whole life of a study with three cases that fail."""
    stated = mixed(done, seconds)
    names = keys(stated)
    first = run_mixed(stated, folder)
    check_rows(first, seconds)
    assert first.counts() == {"over time": 1, "killed": 1, "diverged": 1, "done": done}
    assert open_study(folder).table().equals(first.table())

    before = begun(folder, names)
    again = run_mixed(stated, folder)
    check_rows(again, seconds)
    assert [name for name, at in begun(folder, names).items() if at != before[name]] == names[:3]
    columns = ["case", PRESSURE, "stretch", "largest", "reached", "status", "reason"]
    assert again.table()[columns].equals(first.table()[columns])
    assert again.table()[3:].equals(first.table()[3:])

    # without signals, the two that were hindered are solved
    last = run_study(stated, folder)
    assert last.counts() == {"done": done + 2, "diverged": 1}
    assert last.rows[KILLED].quantities["stretch"] == pytest.approx(stretch(200.0), rel=2e-4)
    assert len(read_index(folder / "index.jsonl")) == done + 3


@pytest.mark.slow
def test_each_failure_is_a_row_and_a_rerun_does_just_those(tmp_path: Path) -> None:
    carried_out(2, 8.0, tmp_path / "study")


@pytest.mark.slow
def test_a_study_of_24_cases(tmp_path: Path) -> None:
    carried_out(21, 20.0, tmp_path / "study")


def test_a_killed_case_goes_on_from_its_last_step(tmp_path: Path) -> None:
    """To the last bit as without the kill; the steps that it had are not solved again."""
    stated, folder = study({PRESSURE: [700], "path.0.steps": [30]}), tmp_path / "study"

    def kill() -> None:
        os.kill(process_of(folder, keys(stated)[0]), signal.SIGKILL)

    with ThreadPoolExecutor(1) as threads:
        killing = threads.submit(kill)
        first = run_study(stated, folder)
        killing.result()
    assert first.counts() == {"killed": 1}
    known = [step.wall_seconds for step in open_archive(first.archive(0)).steps]
    assert 0 < len(known) < 30
    last, whole = run_study(stated, folder), run_study(stated, tmp_path / "whole")
    assert [(row.status, row.start) for row in (*last.rows, *whole.rows)] == [("done", "resumed"), ("done", "rest")]
    archives = [open_archive(result.archive(0)) for result in (last, whole)]
    assert [step.wall_seconds for step in archives[0].steps[: len(known)]] == known
    assert archives[0].scalars["stretch"].tolist() == archives[1].scalars["stretch"].tolist()
    assert last.rows[0].quantities == whole.rows[0].quantities


def test_what_cannot_go_on_is_solved_again(tmp_path: Path) -> None:
    """An archive that was left damaged."""
    folder = StudyFolder(tmp_path).case("key")
    write_case(folder, balloon())
    folder.archive.write_bytes(b"nothing")
    assert outcome(folder, Progress(folder))["start"] == "rest"
    write_case(folder, balloon(), go_on=True)
    assert folder.archive.exists()
    write_case(folder, balloon())
    assert [path.name for path in folder.path.iterdir()] == ["scene.toml"]


def test_a_case_is_what_solve_gives(tmp_path: Path) -> None:
    """Same numbers to the last bit as in this process, also in the archive; quantities asked for later are there."""
    stated = study({PRESSURE: [700]})
    result = run_study(stated, tmp_path / "study")
    scene = cases_of(stated)[0].scene
    assert scene is not None
    solution = solve(scene)
    assert result.rows[0].quantities["stretch"] == solution["stretch"][-1]
    archive = open_archive(result.archive(0))
    assert archive.result.name == "CONVERGED"
    assert archive.scalars["stretch"].tolist() == solution["stretch"].tolist()

    before = begun(tmp_path / "study", keys(stated))
    later = study({PRESSURE: [700]}, quantities={"energy": "elastic_energy", "least": "min of factor_mechanical"})
    found = run_study(later, tmp_path / "study")
    assert found.rows[0].quantities == {"energy": solution["elastic_energy"][-1], "least": 1.0}
    assert found.units["energy"] == "J"
    assert begun(tmp_path / "study", keys(stated)) == before


def test_an_error_is_a_row(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """What the process of a case makes of errors; the traceback goes to its log."""

    def fails(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("embedding.api.solve", fails)
    folder = CaseFolder(tmp_path / "case")
    write_case(folder, balloon())
    error: Exception = ZeroDivisionError("by\nzero")
    reason = f"ZeroDivisionError: by zero (see {folder.log})"
    assert outcome(folder, Progress(folder)) == {"status": "raised", "reason": reason, "states": {}}
    assert "Traceback" in capsys.readouterr().err
    error = SceneError([Problem("shell.shape", "cannot be meshed")])
    reason = "shell.shape: cannot be meshed"
    assert outcome(folder, Progress(folder)) == {"status": "refused", "reason": reason, "states": {}}


@pytest.mark.parametrize(
    ("code", "reason"),
    [
        (-9, "the process was ended by SIGKILL, as the system does where memory is short"),
        (-11, "the process was ended by SIGSEGV"),
        (-250, "the process was ended by signal 250"),
        (3, "the process ended with exit code 3"),
    ],
)
def test_how_a_process_ended(code: int, reason: str) -> None:
    assert death(code) == reason


SCRIPT = """
import sys
from embedding.studies import load_study, run_study
if __name__ == "__main__":
    run_study(load_study("study.toml"), sys.argv[1], workers=1)
"""


def test_a_killed_study_loses_nothing(tmp_path: Path) -> None:
    """Its own process is killed while a case stands still: the others are kept, and its case ends with it."""
    stated = study({PRESSURE: [500, 600, 700]})
    folder, names = tmp_path / "study", keys(stated)
    (tmp_path / "run.py").write_text(SCRIPT)
    StudyFolder(folder).prepare(stated)
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    script = [sys.executable, str(tmp_path / "run.py"), "."]
    with (
        signals(folder, {names[2]: signal.SIGSTOP}),
        subprocess.Popen(script, cwd=folder, env=environment) as killed,
    ):
        at = folder / "cases" / names[2] / "progress.json"
        while not at.exists():
            assert killed.poll() is None
            time.sleep(0.01)
        with pytest.raises(StudyError, match="another process is running this study"):
            run_study(stated, folder)
        killed.kill()
    case = json.loads(at.read_text())["process"]
    os.kill(case, signal.SIGCONT)
    while Path(f"/proc/{case}").exists() and "Z" not in Path(f"/proc/{case}/stat").read_text().split(")")[1]:
        time.sleep(0.01)
    assert [row.status for row in open_study(folder).rows] == ["done", "done", "missing"]

    # one of the lines is torn, and one was not written yet: the cases have their own records
    index = folder / "index.jsonl"
    index.write_bytes(index.read_bytes().splitlines(keepends=True)[0][:-20])
    before = begun(folder, names[:2])
    result = run_study(stated, folder)
    assert result.counts() == {"done": 3}
    assert begun(folder, names[:2]) == before


def test_the_index_keeps_whole_lines(tmp_path: Path) -> None:
    path = tmp_path / "index.jsonl"
    with Index(path) as index:
        index.append({"case": "a", "status": "killed", "seconds": float("nan")})
        index.append({"case": "a", "status": "done"})
        index.append({"case": "b", "status": "done"})
    whole = path.read_bytes()
    for length in range(len(whole) + 1):
        path.write_bytes(whole[:length])
        lines = whole[:length].count(b"\n")
        with Index(path) as index:
            assert len(index.records) == min(lines, 2) - (lines == 2)
        assert path.read_bytes().count(b"\n") == lines
        assert path.read_bytes().endswith(b"\n") or lines == 0
    path.write_bytes(whole.replace(b'"case": "b"', b'"cas', 1))
    with pytest.raises(StudyError, match="index.jsonl: line 3 is damaged: remove it"):
        read_index(path)


def test_a_quantity_that_is_no_scalar_ends_the_study(tmp_path: Path) -> None:
    stated = study({PRESSURE: [500, 600]}, quantities={"wide": "strech"}, limits={"workers": 1})
    with pytest.raises(StudyError, match='quantities.wide: no scalar strech: did you mean "stretch"?'):
        run_study(stated, tmp_path / "study")
    assert [row.status for row in open_study(tmp_path / "study").rows] == ["done", "missing"]


def test_folders_that_are_none(tmp_path: Path) -> None:
    (tmp_path / "letters").write_text("dear")
    stated = study({PRESSURE: [500]})
    with pytest.raises(StudyError, match="this folder holds something else than a study; name a new one"):
        run_study(stated, tmp_path)
    with pytest.raises(StudyError, match=r"cannot be written"):
        run_study(stated, tmp_path / "letters")
    with pytest.raises(StudyError, match=r"not the folder of a study: there is no study\.toml in it"):
        open_study(tmp_path)


def test_missing_packages_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(StudyError, match=r'studies need pebble: pip install "embedding\[studies\]"'):
        run_study(study({PRESSURE: [500]}), tmp_path / "study")


def test_the_folder_holds_the_study(tmp_path: Path) -> None:
    stated = study(
        {PRESSURE: {"low": 1, "high": "2 kPa"}},
        name="map",
        design={"kind": "latin-hypercube", "samples": 3, "seed": 5},
        limits={"seconds": "1 min", "workers": 2, "threads": 2},
    )
    StudyFolder(tmp_path).prepare(stated)
    assert load_study(tmp_path / "study.toml") == stated
