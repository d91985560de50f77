"""What people see while a study runs: bars on a terminal, lines elsewhere, nothing if they want nothing."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from embedding.studies import cases_of
from embedding.studies.display import StudyDisplay
from embedding.studies.files import StudyFolder, write_case
from embedding.studies.worker import Progress
from tests.studies.samples import PRESSURE, study

DONE: dict[str, Any] = {"status": "done", "reason": "", "seconds": 1.5}
KILLED: dict[str, Any] = {"status": "killed", "reason": "by [a hand]"}


def shown(folder: Path, **of_console: Any) -> str:
    """A study of four cases, one known, of which one ends well, one does not, and one is at step 3 of 8."""
    cases = cases_of(study({PRESSURE: [1, 2, 3, 4]}))
    written = io.StringIO()
    console = Console(file=written, width=100, **of_console)
    home = StudyFolder(folder)
    for case in cases:
        assert case.scene is not None
        write_case(home.case(case.key), case.scene)
        progress = Progress(home.case(case.key))
        progress.stage, progress.step, progress.planned = "inflate", 3, 8
        progress.tell()
    with StudyDisplay("map", 4, 1, console=console) as display:
        display.refresh(home, cases[1:])
        display.finished(cases[1], DONE)
        display.finished(cases[2], KILLED)
        display.refresh(home, cases[3:])
        display.progress.refresh()
    return written.getvalue()


def test_lines_without_a_terminal(tmp_path: Path) -> None:
    assert shown(tmp_path).splitlines() == [
        "map: 4 cases, 1 known",
        "2/4 case 2: done in 1.5 s",
        "3/4 case 3: killed: by [a hand]",
    ]


def test_bars_on_a_terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    text = shown(tmp_path, force_terminal=True, color_system=None)
    assert "3/4 case 3: killed: by [a hand]\n" in text.replace("\r", "")
    last = text[text.rindex("map ") :]
    assert "3/4" in last
    assert "case 4 inflate" in last
    assert "3/8" in last
    assert "case 2" not in last


def test_silence(tmp_path: Path) -> None:
    assert shown(tmp_path, quiet=True) == ""
