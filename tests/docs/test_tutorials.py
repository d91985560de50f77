"""Tutorials, typed along: their files, commands and scripts, in the order of the page; and their numbers."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from embedding import open_archive
from embedding.cli import main
from embedding.studies import open_study
from embedding.view.rendering import can_render
from tests.docs.test_pages import ROOT

TUTORIALS = ROOT / "docs" / "tutorials"
BLOCK = re.compile(r"^```(toml|console|python)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def typed(page: str) -> dict[str, Any]:
    """The names of a page's script, after everything on the page was done in the present folder."""
    names: dict[str, Any] = {"__name__": "page"}
    for language, text in BLOCK.findall((TUTORIALS / f"{page}.md").read_text()):
        if language == "toml":
            Path(text.partition("\n")[0].removeprefix("# ")).write_text(text)
        elif language == "python":
            exec(compile(text, page, "exec"), names)
        else:
            for line in text.splitlines():
                assert line.startswith("embedding ")
                assert main(_without_pictures(shlex.split(line)[1:])) == 0
    return names


def _without_pictures(command: list[str]) -> list[str]:
    if "--picture" in command and not can_render():
        at = command.index("--picture")
        del command[at : at + 2]
    return command


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_every_tutorial_is_typed_here() -> None:
    text = Path(__file__).read_text()
    pages = {page.stem for page in TUTORIALS.glob("*.md")} - {"index"}
    assert {page for page in pages if f'typed("{page}")' in text} == pages


def test_first_scene_and_its_archive() -> None:
    names = typed("first_scene")
    archive = names["archive"]
    assert archive.scalars["stretch"][-1] == pytest.approx(1.458, abs=1e-3)
    assert archive.scalars["pressure_top"][-1] < 0.0 == archive.scalars["pressure_bottom"][-1].round(9)
    assert names["solution"]["stretch"][-1] == pytest.approx(1.14, abs=1e-3)
    (point,) = names["far"].critical_points
    assert point.kind == "bifurcation"
    assert point.scalars["voltage"] == pytest.approx(759.5e3, rel=1e-3)
    assert point.scalars["stretch"] == pytest.approx(2.14, abs=2e-3)
    read = typed("archive_with_h5py")
    assert np.array_equal(read["stretch"], archive.scalars["stretch"])
    assert np.array_equal(read["p_t"], archive.block("shell").field("p_t"))
    assert read["strength"].max() == np.linalg.norm(archive.block("outside").field("E"), axis=1).max()


@pytest.mark.slow
def test_actuator_study() -> None:
    names = typed("actuator_study")
    assert open_archive("film.vtkhdf").scalars["stretch"][-1] == pytest.approx(1.081, abs=1e-3)
    assert names["pull_in"].scalars["voltage_jump"] == pytest.approx(-14610.0, rel=1e-4)
    assert names["pull_in"].scalars["stretch"] == pytest.approx(2 ** (1 / 3), rel=1e-3)
    rows = open_study("films").rows
    (failed,) = [row for row in rows if row.status != "done"]
    assert (failed.status, failed.reason.partition(":")[0]) == ("diverged", "PULL_IN")
    assert Path("films.csv").is_file() and Path("films.png").is_file()


def test_own_law() -> None:
    names = typed("own_law")
    assert np.abs(names["pressure"] / names["exact"] - 1.0).max() < 2e-6
    assert np.all(np.diff(names["pressure"]) > 0.0)


def test_own_shape() -> None:
    """Halfway along the tube the hoop strain is that of a thin tube, to first order in it."""
    names = typed("own_shape")
    assert names["scene"].shell.shape.closed
    archive = open_archive("capsule.vtkhdf")
    block = archive.block("shell")
    middle = np.abs(block.points[:, 2]) < 2e-3
    before, now = (np.linalg.norm(p[middle, :2], axis=1) for p in (block.points, block.points + block.field("u")))
    assert (now / before - 1.0).mean() == pytest.approx(100 * 5e-3 / (4 * 1e5 * 1e-4), rel=0.05)
