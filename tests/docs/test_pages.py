"""What the pages promise: their scenes load, their scripts run, their commands and links exist."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from embedding import Scene
from embedding.cli.commands import app

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])


def blocks(page: Path, language: str) -> list[str]:
    """Fenced blocks of ``language`` on a page."""
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)


def named(page: Path) -> str:
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "python")], ids=named)
def test_scripts_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The blocks of a page are one script."""
    monkeypatch.chdir(tmp_path)
    script = "\n".join(blocks(page, "python"))
    names: dict[str, Any] = {"__name__": "page"}
    exec(compile(script, named(page), "exec"), names)
    assert names["solution"].result.ok
    assert names["solution"]["stretch"][-1] == pytest.approx(1.458, abs=2e-3)


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page, "toml")], ids=named)
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
    assert documented == {"run", "explain", "info", "plot", "fit"}
    assert all(app[name] for name in documented)
