"""Thousands of wrong scenes at the door: each is refused in sentences that name the field, or it can be planned.

All of them: ``pytest tests/doors -m "slow or not slow"``. The number of a case reproduces it.
"""

from __future__ import annotations

import random
import tomllib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from embedding import plan as planning
from embedding.errors import Problem, SceneError
from embedding.scene import Scene, load_scene
from embedding.scene.part import Part
from embedding.scene.strain_energy import INVARIANTS
from embedding.scene.units import parse_quantity
from tests.doors.expressions import text
from tests.doors.mutations import mutated_table, mutated_text
from tests.doors.watch import in_time, watched
from tests.scene.samples import shell

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "problems").glob("*.toml"))
TEXTS = [file.read_text() for file in FILES]
TABLES = [tomllib.loads(one) for one in TEXTS]
OF_THE_FILE = (
    "not valid TOML: ", "not UTF-8 text: ", "not a scene: ", "tables and lists may lie at most ",
    "there is no such file", "this is a directory", "cannot be read: ",
)  # fmt: skip
"""How a problem begins that is one of the file as a whole."""


def slow(count: int) -> list[object]:
    """Two batches of the slow suite."""
    return [pytest.param(first, count, marks=pytest.mark.slow) for first in (1000, 1000 + count)]


@pytest.fixture(autouse=True)
def at_home(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files that scenes name are found from the root of the project."""
    monkeypatch.chdir(ROOT)


@pytest.fixture(autouse=True)
def nothing_runs() -> Iterator[None]:
    """No case may run anything; what the package itself loads late is loaded before."""
    planning.explain(Scene.from_toml(TEXTS[0])).text()
    parse_quantity("1 inch", "m")
    with watched() as found:
        yield
    assert found == []


def readable(problem: Problem) -> bool:
    """One line that a terminal can show, about a field or the whole file, which says what is allowed."""
    line = str(problem).replace("\t", " ")
    return (
        line.isprintable()
        and len(line) < 1200
        and bool(problem.message)
        and (bool(problem.path) or problem.message.startswith(OF_THE_FILE))
    )


def ended(scene: Scene) -> str:
    """What becomes of an accepted scene: it is planned, or refused with the reason; its text is that scene again."""
    try:
        outcome = "planned" if planning.explain(scene).text() else "without a plan"
    except SceneError as error:
        assert all(map(readable, error.problems)), error
        outcome = "no plan"
    assert Scene.from_toml(scene.to_toml()) == scene
    return outcome


@pytest.mark.parametrize("first, count", [(0, 250), *slow(4000)])
def test_values(first: int, count: int) -> None:
    """Other values, types, units, keys and kinds, in tables of every problem."""
    outcomes: Counter[str] = Counter()
    for number in range(first, first + count):
        chance = random.Random(number)
        table = mutated_table(chance, chance.choice(TABLES), TABLES)
        try:
            with in_time():
                outcomes[ended(Scene.from_table(table))] += 1
        except SceneError as error:
            assert error.exit_code == 2 and error.problems
            assert all(map(readable, error.problems)), f"case {number}: {error}"
            outcomes["refused"] += 1
        except Exception as error:
            raise AssertionError(f"case {number}: {type(error).__name__}: {error}") from error
    assert outcomes["refused"] > count / 2 and outcomes["planned"] > count / 25, outcomes


@pytest.mark.parametrize("first, count", [(0, 100), *slow(3000)])
def test_texts(first: int, count: int, tmp_path: Path) -> None:
    """Files with bytes lost, doubled, moved and put in."""
    outcomes: Counter[str] = Counter()
    file = tmp_path / "a scene, größer.toml"
    for number in range(first, first + count):
        chance = random.Random(number)
        file.write_bytes(mutated_text(chance, chance.choice(TEXTS)))
        try:
            with in_time():
                outcomes[ended(load_scene(file))] += 1
        except SceneError as error:
            assert str(file) in str(error)
            assert all(map(readable, error.problems)), f"case {number}: {error}"
            outcomes["refused"] += 1
        except Exception as error:
            raise AssertionError(f"case {number}: {type(error).__name__}: {error}") from error
    assert outcomes["refused"] > count / 2, outcomes


PLACES = ("shell.thickness", "shell.material.expression", "loads.pressure_bottom.expression", "ambient.applied_field")


def varied(where: int, expression: str) -> Part:
    """A scene with an expression in one of the places that take one."""
    if where == 0:
        return Scene(shell=shell(thickness={"expression": expression, "unit": "mm"}))
    if where == 1:
        return Scene(shell=shell(material={"law": "strain-energy", "expression": expression, "unit": "kPa"}))
    if where == 2:
        return Scene(shell=shell(), loads={"pressure_bottom": {"expression": expression, "unit": "Pa"}})
    field = {"expression": [expression, "0", "0"], "unit": "V/m"}
    return Scene(shell=shell(relative_permittivity=3.0), ambient={"field": "electric", "applied_field": field})


@pytest.mark.parametrize("first, count", [(0, 250), *slow(3000)])
def test_expressions(first: int, count: int) -> None:
    """Of the grammar, spoilt, and of other languages: thickness, energy, pressure, applied field."""
    outcomes: Counter[str] = Counter()
    for number in range(first, first + count):
        chance = random.Random(number)
        where = number % len(PLACES)
        written = text(chance, INVARIANTS if where == 1 else ("x", "y", "z"))
        try:
            with in_time():
                outcomes[ended(varied(where, written))] += 1  # type: ignore[arg-type]
        except SceneError as error:
            assert all(map(readable, error.problems)), f"case {number}: {error}"
            assert all(problem.path.startswith(PLACES[where]) for problem in error.problems), f"case {number}: {error}"
            outcomes["refused"] += 1
        except Exception as error:
            raise AssertionError(f"case {number}, {written!r}: {type(error).__name__}: {error}") from error
    assert outcomes["refused"] > count / 4 and outcomes["planned"] > count / 25, outcomes
