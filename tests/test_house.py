"""The floors of the house: imports point down only, and no file grows past what one can read at a sitting."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import embedding

ROOT = Path(embedding.__file__).parent
FLOORS = (
    "errors", "timing", "process", "threads", "blas", "scene", "geometry", "shell", "ambient", "coupling", "plan",
    "solving", "accuracy", "progress", "archive", "post", "view", "fit", "api", "studies", "trade", "bench", "cli",
)  # fmt: skip
FILES = sorted(ROOT.rglob("*.py"))


def floor(path: Path) -> str:
    return path.relative_to(ROOT).parts[0].removesuffix(".py")


def imported(path: Path) -> set[str]:
    """Floors that a file imports when it runs; what is imported for type checking only is not an arrow."""
    tree = ast.parse(path.read_text())
    guarded = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and id(node) not in guarded:
            names.add(node.module)
        elif isinstance(node, ast.Import) and id(node) not in guarded:
            names |= {alias.name for alias in node.names}
    return {name.split(".")[1] for name in names if name.startswith("embedding.")}


@pytest.mark.parametrize("path", [p for p in FILES if p.parent != ROOT or floor(p) in FLOORS], ids=str)
def test_imports_point_down(path: Path) -> None:
    here = FLOORS.index(floor(path))
    above = {name for name in imported(path) if FLOORS.index(name) > here}
    assert not above


def test_every_folder_is_a_floor() -> None:
    folders = {p.name for p in ROOT.iterdir() if p.is_dir() and any(p.glob("*.py"))}
    assert folders <= set(FLOORS)


@pytest.mark.parametrize("path", FILES, ids=str)
def test_a_file_can_be_read_at_a_sitting(path: Path) -> None:
    assert len(path.read_text().splitlines()) <= 400
