"""Files of a study: the study file, and the folder that holds its index and the archives of its cases."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from embedding.errors import Problem, SceneError
from embedding.scene import Scene, load_scene
from embedding.scene.toml_io import read_table, read_text, write_table
from embedding.studies.errors import StudyError
from embedding.studies.study import Study

STUDY, SCENE, INDEX = "study.toml", "scene.toml", "index.jsonl"


def load_study(path: str | os.PathLike[str]) -> Study:
    """Read a study file. Its ``scene`` is the name of a scene file, from the study file's folder on, or a table.

    Raises:
        SceneError: a file cannot be read, is not TOML, or is not a study; the message names it and the field.
    """
    source = os.fspath(path)
    table = read_table(read_text(source), source)
    if isinstance(table.get("scene"), str):
        table["scene"] = load_scene(Path(source).parent / table["scene"])
    try:
        return Study(**table)
    except SceneError as error:
        raise SceneError([_in_study(problem, table) for problem in error.problems], source) from None


def _in_study(problem: Problem, table: dict[str, Any]) -> Problem:
    """A problem between the fields of the base scene has its path from there on; here it gets that in the study."""
    first = problem.path.partition(".")[0]
    return problem if first in Study.model_fields or first in table else problem._replace(path=f"scene.{problem.path}")


@dataclass(frozen=True)
class CaseFolder:
    """What one case leaves: scene, archive with its views, what the solver printed, and the record of how it ended."""

    path: Path

    @property
    def scene(self) -> Path:
        """The scene file."""
        return self.path / "scene.toml"

    @property
    def start(self) -> Path:
        """The name of the archive from whose last state the case starts, where there is one."""
        return self.path / "start.txt"

    @property
    def archive(self) -> Path:
        """The archive."""
        return self.path / "run.vtkhdf"

    @property
    def log(self) -> Path:
        """What the process printed."""
        return self.path / "log.txt"

    @property
    def progress(self) -> Path:
        """Where the case is on its path while it is solved, and the number of its process."""
        return self.path / "progress.json"

    @property
    def record(self) -> Path:
        """How the case ended, written by its own process as the last thing."""
        return self.path / "record.json"


@dataclass(frozen=True)
class StudyFolder:
    """Folder of a study; ``index`` is the one file with all results."""

    path: Path

    @property
    def index(self) -> Path:
        """One line of JSON for every case that has ended."""
        return self.path / INDEX

    def case(self, key: str) -> CaseFolder:
        """The folder of the case with this hash."""
        return CaseFolder(self.path / "cases" / key)

    def prepare(self, study: Study) -> None:
        """Make the folder, and write study and scene into it.

        Raises:
            StudyError: the folder holds something else, or cannot be written.
        """
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            if not (self.path / STUDY).exists() and any(self.path.iterdir()):
                raise StudyError(f"{self.path}: this folder holds something else than a study; name a new one")
            write_whole(self.path / SCENE, study.scene.to_toml())
            table = study.model_dump(mode="json", exclude_none=True, exclude={"scene"})
            write_whole(self.path / STUDY, write_table({"name": table.pop("name"), "scene": SCENE, **table}))
        except OSError as error:
            raise StudyError(f"{self.path}: cannot be written: {error.strerror or error}") from error

    def study(self) -> Study:
        """The study that was run here last.

        Raises:
            StudyError: there is none.
        """
        if not (self.path / STUDY).is_file():
            raise StudyError(f"{self.path}: not the folder of a study: there is no {STUDY} in it")
        return load_study(self.path / STUDY)


def write_case(folder: CaseFolder, scene: Scene, start: Path | None = None, *, go_on: bool = False) -> None:
    """A folder for a case that is about to be solved: what an earlier attempt left is removed, but for the archive if
    the case shall ``go_on`` from there. ``start`` is the archive from whose last state the case starts."""
    folder.path.mkdir(parents=True, exist_ok=True)
    for path in folder.path.iterdir():
        if not go_on or not path.name.startswith(f"{folder.archive.stem}."):
            path.unlink()
    if start is not None:
        folder.start.write_text(os.fspath(start), encoding="utf-8")
    folder.scene.write_text(scene.to_toml(), encoding="utf-8")


def write_whole(path: Path, text: str, sync: bool = True) -> None:
    """Write a file that is there as a whole or not at all, also after a power cut unless ``sync`` is off."""
    partial = path.with_name(f".{path.name}.partial")
    with partial.open("w", encoding="utf-8") as file:
        file.write(text)
        if sync:
            file.flush()
            os.fsync(file.fileno())
    partial.replace(path)


def read_json(path: Path) -> dict[str, Any] | None:
    """The object in a JSON file; None where there is none, or not (yet) a whole one."""
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return value if isinstance(value, dict) else None
