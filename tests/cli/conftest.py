"""A small scene file, and a way to call the command line as a person would."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from embedding.cli import main
from tests.balloons import SMALL as SCENE


@dataclass(frozen=True)
class Outcome:
    """What a person sees of one call."""

    code: int
    out: str
    err: str


@pytest.fixture
def scene_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The scene in a folder of its own, which is the present folder."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "balloon.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def call(capfd: pytest.CaptureFixture[str]) -> Callable[..., Outcome]:
    """Call the command line with the given words."""

    def run(*words: object) -> Outcome:
        capfd.readouterr()
        code = main([str(word) for word in words])
        captured = capfd.readouterr()
        return Outcome(code, captured.out, captured.err)

    return run
