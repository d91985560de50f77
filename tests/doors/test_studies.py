"""Wrong study files: each is refused in sentences that name the field, or its cases can be made."""

from __future__ import annotations

import random
import tomllib
from collections import Counter
from pathlib import Path

import pytest

from embedding.errors import EmbeddingError, SceneError
from embedding.scene.toml_io import write_table
from embedding.studies import cases_of, load_study
from tests.doors.mutations import mutated_table, mutated_text
from tests.doors.test_scenes import readable
from tests.doors.watch import in_time, watched

FOLDER = Path(__file__).parents[2] / "problems" / "studies"
TEXTS = [
    file.read_text().replace('scene = "../', f'scene = "{FOLDER.parent}/') for file in sorted(FOLDER.glob("*.toml"))
]
TABLES = [tomllib.loads(text) for text in TEXTS]
FEW = 60
"""Of so many cases the scenes are made, too."""


@pytest.mark.parametrize("first, count", [(0, 60), pytest.param(1000, 1000, marks=pytest.mark.slow)])
def test_study_files(first: int, count: int, tmp_path: Path) -> None:
    outcomes: Counter[str] = Counter()
    file = tmp_path / "eine Studie.toml"
    load_study(FOLDER / "pull_in_map.toml")
    with watched() as ran:
        for number in range(first, first + count):
            chance = random.Random(number)
            if chance.random() < 0.3:
                file.write_bytes(mutated_text(chance, chance.choice(TEXTS)))
            else:
                try:
                    text = write_table(mutated_table(chance, chance.choice(TABLES), TABLES))
                except (TypeError, ValueError):  # not to be written as TOML: a door in front of this one
                    continue
                file.write_text(text, encoding="utf-8", errors="replace")
            try:
                with in_time(120.0):
                    study = load_study(file)
                    outcomes["accepted"] += 1
                    wide = any(len(values) > FEW for values in study.parameters.values())
                    if not wide and getattr(study.design, "samples", 0) <= FEW:
                        assert len(cases_of(study)) > 0
            except SceneError as error:
                assert all(map(readable, error.problems)), f"case {number}: {error}"
                outcomes["refused"] += 1
            except EmbeddingError as error:
                assert str(error).isprintable(), f"case {number}: {error}"
                outcomes["refused"] += 1
            except Exception as error:
                raise AssertionError(f"case {number}: {type(error).__name__}: {error}") from error
    assert ran == []
    assert outcomes["refused"] > count / 3 and outcomes["accepted"] > count / 25, outcomes


def test_too_many_cases(tmp_path: Path) -> None:
    """A few lines can ask for more cases than there is memory for their list."""
    parameters = "\n".join(f'"shell.regions.{k}.thickness" = [{", ".join(map(str, range(1, 100)))}]' for k in range(9))
    scene = FOLDER.parent / "charged_balloon.toml"
    file = tmp_path / "study.toml"
    file.write_text(f'scene = "{scene}"\n[parameters]\n{parameters}\n[quantities]\na = "stretch"\n')
    with pytest.raises(SceneError, match="makes 9e\\+17 cases, and a study has at most 100000"):
        load_study(file)
