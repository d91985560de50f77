"""`embedding bench` as people call it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from embedding.bench.spending import DEFAULT_SCENE
from tests.cli.conftest import Outcome

Call = Callable[..., Outcome]
SMALL = ("--set", "model.reduction=axisymmetric", "--set", "path.0.steps=1")


def test_the_table(call: Call, tmp_path: Path) -> None:
    scene = tmp_path / "mine.toml"
    scene.write_text(DEFAULT_SCENE.read_text().replace('name = "charged_balloon"', 'name = "mine"'))
    told = call("bench", scene, *SMALL)
    lines = told.out.splitlines()
    assert told.code == 0 and lines[0].startswith("mine: axisymmetric, converged after 1 steps")
    assert lines[1].split() == ["part", "seconds", "share", "calls"]
    assert lines[-1].split()[:2] == ["whole", "process"] and lines[-1].endswith("100.0%")


def test_as_json(call: Call) -> None:
    told = json.loads(call("bench", *SMALL, "--json").out)
    assert told["total"] > 0 and {"names", "seconds", "own", "calls"} == set(told["parts"][0])


def test_mistakes(call: Call) -> None:
    told = call("bench", "--set", "shell.thickness=-1")
    assert told.code == 2 and "shell.thickness" in told.err
