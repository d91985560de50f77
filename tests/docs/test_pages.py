"""What the pages promise: their scenes load, their scripts run, their commands and links exist."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from embedding import Scene
from embedding.cli.commands import app
from embedding.studies import Study, cases_of, load_study, open_study
from problems import dielectric_balloon

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
TYPED = ROOT / "docs" / "tutorials"  # by tests of their own
STUDIES = ROOT / "docs" / "studies.md"


def blocks(page: Path, language: str) -> list[str]:
    """Fenced blocks of ``language`` on a page."""
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)


SCENES = [page for page in PAGES if page not in (STUDIES, *TYPED.iterdir()) and blocks(page, "toml")]
SCRIPTS = [page for page in PAGES if page not in (STUDIES, *TYPED.iterdir()) and blocks(page, "python")]


def named(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", SCRIPTS, ids=named)
def test_scripts_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The blocks of a page are one script."""
    monkeypatch.chdir(tmp_path)
    script = "\n".join(blocks(page, "python"))
    names: dict[str, Any] = {"__name__": "page"}
    exec(compile(script, named(page), "exec"), names)
    assert names["solution"].result.ok
    assert names["solution"]["stretch"][-1] == pytest.approx(1.458, abs=2e-3)


@pytest.mark.parametrize("page", SCENES, ids=named)
def test_scenes_load(page: Path) -> None:
    for text in blocks(page, "toml"):
        assert Scene.from_toml(text, source=named(page)).name


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_links_lead_somewhere(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    links = [link.partition("#")[0] for link in re.findall(r"(?:\]\(|src=\")([^)\"\s]+)", text)]
    assert [link for link in links if link and ":" not in link and not (page.parent / link).exists()] == []


def test_readme_commands_exist() -> None:
    """The scenes, scripts and commands of the README's first block are there."""
    text = (ROOT / "README.md").read_text()
    scenes = re.findall(r"embedding run (\S+\.toml)", text)
    assert scenes
    for scene in scenes:
        assert Scene.from_toml((ROOT / scene).read_text(), source=scene)
    assert (ROOT / "setup.sh").is_file()
    documented = set(re.findall(r"`embedding (\w+)", (ROOT / "docs" / "run.md").read_text()))
    assert documented == {name for name in app if not name.startswith("-")}


def written_study(folder: Path) -> Study:
    """The study of its page, in a folder that holds the problems, too."""
    (folder / "problems").symlink_to(ROOT / "problems")
    (text,) = blocks(STUDIES, "toml")
    (folder / "pull_in.toml").write_text(text)
    return load_study(folder / "pull_in.toml")


def test_the_study_loads(tmp_path: Path) -> None:
    scenes = [case.scene for case in cases_of(written_study(tmp_path))]
    assert [scene.shell.thickest for scene in scenes if scene] == [5e-4, 5e-4, 1e-3, 1e-3]


@pytest.mark.slow
def test_the_study_finds_the_pull_in_of_the_thin_balloon(tmp_path: Path) -> None:
    """Against the closed form of the thin balloon, Zhu, Cai and Suo (2010)."""
    written_study(tmp_path)
    (script,) = blocks(STUDIES, "python")
    (tmp_path / "script.py").write_text(script)
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    subprocess.run([sys.executable, "script.py"], cwd=tmp_path, env=environment, check=True)
    result = open_study(tmp_path / "pull_in")
    for case, row in zip(cases_of(result.study), result.rows, strict=True):
        assert (row.status, row.reason) == ("done", "")
        assert case.scene is not None
        pressure = case.scene.loads.pressure_bottom
        assert isinstance(pressure, float)
        limit = dielectric_balloon.exact(case.scene, "membrane").pull_in(pressure)
        assert limit is not None
        assert row.quantities["pull_in"] == pytest.approx(limit.load, rel=1e-5)
        assert row.quantities["stretch"] == pytest.approx(limit.stretch, rel=1e-4)


def test_the_gallery_is_what_the_problems_say() -> None:
    """Its page is made from their texts, and every picture is there."""
    spec = importlib.util.spec_from_file_location("gallery", ROOT / "docs" / "gallery.py")
    assert spec is not None and spec.loader is not None
    gallery = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(gallery)
    assert (ROOT / "docs" / "gallery.md").read_text() == gallery.page()
    names = {f"{name}.png" for part in gallery.PARTS.values() for name in part}
    assert {path.name for path in gallery.IMAGES.iterdir()} == names
