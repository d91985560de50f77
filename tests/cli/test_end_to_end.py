"""The whole way through: scene file, solver, archive and back; also when it fails or is interrupted."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from embedding.archive import open_archive
from embedding.view import can_render
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]
PNG = b"\x89PNG\r\n"
ROOT = Path(__file__).parents[2]


def test_run_and_info(scene_file: Path, call: Call) -> None:
    outcome = call("run", scene_file)
    assert outcome.code == 0, outcome.err
    assert outcome.out.startswith("small balloon: converged after 2 steps\n")
    assert "estimated error" in outcome.out
    assert outcome.err.count("\n") == 4, "a title, two steps, the end"

    told = call("info", "small_balloon.vtkhdf")
    assert told.code == 0, told.err
    assert "converged" in told.out
    assert "pressure_difference [Pa]" in told.out
    assert "block shell" in told.out

    report = json.loads(call("info", "small_balloon.vtkhdf", "--json").out)
    assert report["name"] == "small balloon"
    assert report["reduction"] == "axisymmetric"
    assert report["result"]["name"] == "CONVERGED"
    assert [step["number"] for step in report["steps"]] == [1, 2]
    assert report["steps"][-1]["scalars"]["pressure_difference"] == pytest.approx(500.0)
    assert report["units"]["pressure_difference"] == "Pa"
    assert "u" in report["blocks"]["shell"]


def test_plot(scene_file: Path, call: Call) -> None:
    call("run", scene_file, "--no-progress", "--out", "mine.vtkhdf")
    history = call("plot", "mine.vtkhdf", "--history")
    assert (history.code, history.out, history.err) == (0, "mine.history.png\n", "")
    assert Path("mine.history.png").read_bytes().startswith(PNG)

    drawn = call("plot", "mine.vtkhdf", "--step", 1, "--out", "first.png")
    if can_render():
        assert (drawn.code, drawn.err) == (0, "")
        assert Path("first.png").read_bytes().startswith(PNG)
    else:
        assert drawn.code == 2
        assert "libegl1" in drawn.err
    assert not list(scene_file.parent.glob(".*")), "no partial files"


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("--step", 3), "--step: 3 is not allowed: the archive has steps 1 to 2"),
        (("--step", 0), "--step: 0 is not allowed"),
        (("--step", "last"), "--step"),
        (("--step", 1, "--history"), "leave out one of --step and --history"),
        (("--out", "x.pdf"), "'x.pdf' must end in '.png'"),
    ],
)
def test_plots_that_cannot_be(scene_file: Path, call: Call, words: tuple[object, ...], part: str) -> None:
    call("run", scene_file, "--no-progress", "--out", "mine.vtkhdf")
    before = sorted(scene_file.parent.iterdir())
    outcome = call("plot", "mine.vtkhdf", *words)
    assert outcome.code == 2
    assert part in outcome.err
    assert sorted(scene_file.parent.iterdir()) == before


def test_run_as_json_agrees_with_the_archive(scene_file: Path, call: Call) -> None:
    report = json.loads(call("run", scene_file, "--json", "--no-progress", "--out", "mine.vtkhdf").out)
    archive = open_archive("mine.vtkhdf")
    assert report["scalars"]["stretch"] == archive.scalars["stretch"][-1]
    assert report["estimated_error"]["value"] < 1e-3


def test_explain(scene_file: Path, call: Call) -> None:
    outcome = call("explain", scene_file)
    assert outcome.code == 0
    assert "axisymmetric" in outcome.out
    decisions = json.loads(call("explain", scene_file, "--json").out)["decisions"]
    assert {"topic", "choice", "reason", "number", "measure", "threshold"} == set(decisions[0])
    assert list(scene_file.parent.iterdir()) == [scene_file]


def test_beyond_the_limit_point(scene_file: Path, call: Call) -> None:
    """A neo-Hookean balloon bears 1.24 mu T/R = 1240 Pa; asked for more, the solve ends with that reason."""
    outcome = call("run", scene_file, "--set", "loads.pressure_bottom=2 kPa", "--no-progress")
    assert outcome.code == 3
    assert outcome.out == ""
    assert outcome.err.startswith("error: ")
    assert "limit point" in outcome.err
    assert "small_balloon.vtkhdf" in outcome.err
    assert "Traceback" not in outcome.err
    archive = open_archive("small_balloon.vtkhdf")
    assert archive.result.name == "LIMIT_POINT"
    assert 1230.0 < archive.scalars["pressure_difference"][-1] <= 1240.0


def test_info_of_something_else(scene_file: Path, call: Call) -> None:
    for words, part in (
        ((scene_file,), "not an HDF5 file"),
        (("none.vtkhdf",), "no such archive"),
        ((".",), "folder"),
    ):
        outcome = call("info", *words)
        assert outcome.code == 2
        assert outcome.out == ""
        assert part in outcome.err
        assert outcome.err.count("\n") == 1
    assert json.loads(call("info", scene_file, "--json").out)["error"]["kind"] == "archive"


def test_an_interrupt_keeps_the_accepted_steps(scene_file: Path) -> None:
    words = ["run", str(scene_file), "--set", "path.0.steps=5000"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(
        [sys.executable, "-m", "embedding.cli", *words],
        cwd=scene_file.parent, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    deadline = time.monotonic() + 60
    while not (scene_file.parent / "small_balloon.vtkhdf").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    assert out == ""
    assert "error: " in err and "interrupted" in err
    assert "Traceback" not in err
    archive = open_archive(scene_file.parent / "small_balloon.vtkhdf")
    assert archive.result.name == "INTERRUPTED"
    assert 1 <= len(archive) < 5000


def test_every_kind_of_plot(scene_file: Path, call: Call) -> None:
    call("run", scene_file, "--no-progress", "--out", "mine.vtkhdf")
    for kind, name in (("response", "mine.response.png"), ("faces", "mine.faces.png"), ("page", "mine.html")):
        drawn = call("plot", "mine.vtkhdf", "--kind", kind)
        assert (drawn.code, drawn.out) == (0, f"{name}\n"), drawn.err
        assert (scene_file.parent / name).stat().st_size > 5_000
    assert call("plot", "mine.vtkhdf", "--kind", "response", "--x", "volume_ratio", "--y", "stretch").code == 0
    assert call("plot", "mine.vtkhdf", "--kind", "page", "--field", "p_b", "--out", "pb.html").code == 0


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("--field", "colour"), "--field: no field 'colour' in the block shell; there are u, p_t, p_b, stretch"),
        (("--ambient-field", "E"), "--ambient-field: no field 'E' in the block outside; nothing is meshed around"),
        (("--kind", "response", "--x", "voltage"), "--x: no scalar 'voltage'; there are step,"),
        (("--kind", "response", "--field", "u"), "--field: a response does not take it; it takes --x, --y"),
        (("--kind", "slice"), "nothing is meshed around the shell, so there is no field to cut"),
        (("--kind", "page", "--out", "x.png"), "--out: 'x.png' must end in '.html'"),
        (("--reach", "0"), "--reach: 0 is not allowed: must be from 1 to 100"),
    ],
)
def test_other_plots_that_cannot_be(scene_file: Path, call: Call, words: tuple[object, ...], part: str) -> None:
    call("run", scene_file, "--no-progress", "--out", "mine.vtkhdf")
    outcome = call("plot", "mine.vtkhdf", *words)
    assert outcome.code == 2 and part in outcome.err
