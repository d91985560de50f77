"""The cases of a study: one scene each, known by a hash of what it states."""

from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from embedding.errors import Problem, SceneError
from embedding.scene import Scene, SurfaceFile
from embedding.scene.checks import cross_problems
from embedding.scene.overrides import apply_overrides
from embedding.scene.part import TOLERANT
from embedding.studies.design import designed, neighbours
from embedding.studies.parameters import column_value, number_at, override
from embedding.studies.study import Study

DIGITS = 16


@dataclass(frozen=True)
class Case:
    """One row of a study: its parameters in SI units (text where they are none), its changes, its scene and its hash.

    ``scene`` is None where the values, each allowed by itself, do not fit together; ``refusal`` says why. ``before`` is
    the number of the case from whose state this one starts, None for rest.
    """

    number: int
    values: dict[str, float | str]
    changes: tuple[str, ...]
    scene: Scene | None
    key: str
    refusal: str = ""
    before: int | None = None


def cases_of(study: Study) -> tuple[Case, ...]:
    """The cases in the order of the table.

    Raises:
        SceneError: a parameter is no field of the scene, or one of its values is not allowed there.
    """
    base = tomllib.loads(study.scene.to_toml())
    cases: list[Case] = []
    wrong: dict[Problem, None] = {}
    previous = neighbours(study)
    for number, stated in enumerate(designed(study)):
        changes = tuple(override(path, value) for path, value in stated.items())
        scene, problems, fits = _scene(base, [*changes, f"solver.threads={study.limits.threads}"])
        if not fits:
            wrong |= dict.fromkeys(_renamed(problems, stated))
        at = study.scene if scene is None else scene
        values = {path: column_value(number_at(at, path), value) for path, value in stated.items()}
        before = previous[number] if previous else None
        while before is not None and cases[before].scene is None:
            before = cases[before].before
        key = "" if scene is None else hash_of(scene, "" if before is None else cases[before].key)
        cases.append(Case(number, values, changes, scene, key, "; ".join(map(str, problems)), before))
    if wrong:
        raise SceneError(tuple(wrong))
    return tuple(cases)


def hash_of(scene: Scene, before: str = "") -> str:
    """Hash of everything that a scene states and its numbers depend on: neither its name nor its threads.

    Of a shape from a file it holds the content of the file, not its name; ``before`` is the hash of the case that it
    starts from.
    """
    table = scene.model_dump(mode="json", exclude={"name": True, "solver": {"threads"}})
    shape = scene.shell.shape
    if isinstance(shape, SurfaceFile):
        table["shell"]["shape"]["path"] = hashlib.sha256(Path(shape.path).read_bytes()).hexdigest()
    text = json.dumps(table, sort_keys=True) + before
    return hashlib.sha256(text.encode()).hexdigest()[:DIGITS]


def _scene(base: dict[str, Any], changes: Sequence[str]) -> tuple[Scene | None, tuple[Problem, ...], bool]:
    """The changed scene; or None, why not, and whether each field by itself is right."""
    try:
        table = apply_overrides(base, changes)
    except SceneError as error:
        return None, error.problems, False
    try:
        return Scene.from_table(table), (), True
    except SceneError as error:
        between = set(cross_problems(Scene.model_validate(table, context=TOLERANT)))
        alone = tuple(problem for problem in error.problems if problem not in between)
        return None, alone or error.problems, not alone


def _renamed(problems: Sequence[Problem], parameters: dict[str, Any]) -> list[Problem]:
    """The same problems under the paths of the study file."""
    return [
        problem._replace(path=f"parameters.{problem.path}") if _stated(problem.path, parameters) else problem
        for problem in problems
    ]


def _stated(path: str, parameters: dict[str, Any]) -> bool:
    """Does a problem at ``path`` of the scene come from a parameter of the study?"""
    return any(path == name or path.startswith(f"{name}.") or name.startswith(f"{path}.") for name in parameters)
