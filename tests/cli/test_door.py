"""Bad input at the door: one message, the right exit code, no traceback, no waiting for the solver."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import embedding
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]


def test_all_problems_of_a_scene_in_one_message(scene_file: Path, call: Call) -> None:
    scene_file.write_text(scene_file.read_text().replace("thickness", "thicknes"))
    outcome = call("run", scene_file)
    assert outcome.code == 2
    assert outcome.out == ""
    first, *rest = outcome.err.splitlines()
    assert first.startswith("error: ") and "balloon.toml: 2 problems" in first
    assert len(rest) == 2
    assert 'did you mean "thickness"?' in outcome.err
    assert list(scene_file.parent.iterdir()) == [scene_file]


@pytest.mark.parametrize("command", ["run", "explain"])
def test_scene_errors_as_json(scene_file: Path, call: Call, command: str) -> None:
    outcome = call(command, scene_file, "--set", "shell.thickness=-1 mm", "--json")
    assert outcome.code == 2
    assert outcome.err == ""
    error = json.loads(outcome.out)["error"]
    assert error["kind"] == "scene"
    assert [problem["path"] for problem in error["problems"]] == ["shell.thickness"]


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("run", "missing.toml"), "missing.toml: there is no such file"),
        (("run",), "SCENE requires an argument"),
        (("run", "a.toml", "--threds", "3"), "--threds"),
        (("runn", "a.toml"), 'Did you mean "run"?'),
        (("run", "a.toml", "--set"), "--set requires an argument"),
        (("run", ".", "--no-progress"), "this is a directory"),
    ],
)
def test_bad_words(scene_file: Path, call: Call, words: tuple[str, ...], part: str) -> None:
    outcome = call(*words)
    assert outcome.code == 2
    assert outcome.out == ""
    assert outcome.err.startswith("error: ")
    assert part in outcome.err
    assert "Traceback" not in outcome.err


def test_usage_errors_as_json(call: Call) -> None:
    outcome = call("run", "--json")
    assert outcome.code == 2
    assert outcome.err == ""
    assert json.loads(outcome.out)["error"]["kind"] == "usage"


def test_help_and_version(call: Call) -> None:
    versioned = call("--version")
    assert versioned.code == 0
    assert versioned.out.strip() == embedding.__version__
    helped = call("--help")
    assert helped.code == 0
    assert all(command in helped.out for command in ("run", "explain"))


def test_scene_errors_and_help_do_not_load_the_solver(scene_file: Path) -> None:
    scene_file.write_text("nonsense = 1")
    program = (
        "import os, sys; from embedding.cli import main; code = main(sys.argv[1:]);"
        "assert os.environ['OPENBLAS_NUM_THREADS'];"
        "heavy = {'ngsolve', 'pyvista', 'matplotlib', 'h5py'} & set(sys.modules);"
        "print(sorted(heavy), code)"
    )
    root = Path(__file__).parents[2]
    for words, code in ((["explain", str(scene_file)], "2"), (["run", "--help"], "0")):
        done = subprocess.run(
            [sys.executable, "-c", program, *words],
            capture_output=True,
            text=True,
            cwd=root,
            check=True,
            timeout=60,
        )
        assert done.stdout.splitlines()[-1] == f"[] {code}"
