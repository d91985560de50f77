"""What happens in the process of one case: solve its scene, and leave a record of how that ended, whatever it was."""

from __future__ import annotations

import json
import multiprocessing
import os
import sys
import threading
import traceback
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from embedding.errors import ArchiveError, SceneError
from embedding.scene import Scene
from embedding.solving.events import Listener, StepRecord
from embedding.solving.path import planned_steps
from embedding.studies.files import CaseFolder, write_whole
from embedding.studies.record import RAISED, REFUSED, RESUMED, failure, record_of, without_nan

if TYPE_CHECKING:
    from embedding.solving import Solution
    from embedding.solving.problem import Problem
    from embedding.solving.state import State

PRELOADED = ("embedding.studies.worker", "embedding.api", "embedding.archive", "embedding.solving.driver")
"""Modules that every case needs: loaded once, in the process from which those of the cases are forked."""


def solve_case(path: str) -> None:
    """Solve the scene in the case's folder ``path``; the archive and the record go there, too."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        _end_with(parent.join)
    folder = CaseFolder(Path(path))
    _print_to(folder.log)
    progress = Progress(folder)
    progress.tell()
    write_whole(folder.record, json.dumps(without_nan(outcome(folder, progress)), allow_nan=False))


def outcome(folder: CaseFolder, progress: Progress) -> dict[str, Any]:
    """The record of solving the scene of the folder; errors are records, too."""
    try:
        scene = Scene.from_toml(folder.scene.read_text(encoding="utf-8"))
        return record_of(solution_of(scene, folder, progress))
    except SceneError as error:
        return failure(REFUSED, str(error))
    except Exception as error:
        traceback.print_exc()
        return failure(RAISED, f"{type(error).__name__}: {error} (see {folder.log})")


def solution_of(scene: Scene, folder: CaseFolder, progress: Progress) -> Solution:
    """The solution: of the run whose archive an earlier attempt left, if it can go on, else from the start."""
    from embedding.api import solve
    from embedding.solving.session import OtherMeshError

    if folder.archive.exists():
        try:
            found = solve(scene, resume=folder.archive, throw=False, listeners=[progress])
            return replace(found, start=RESUMED)
        except (ArchiveError, OtherMeshError):
            traceback.print_exc()
    start = folder.start.read_text(encoding="utf-8") if folder.start.exists() else None
    return solve(scene, archive=folder.archive, start=start, throw=False, listeners=[progress])


class Progress(Listener):
    """Tells the study, by a small file, where on its path the case is."""

    def __init__(self, folder: CaseFolder) -> None:
        self.folder = folder
        self.planned: int | None = None
        self.stage, self.step = "meshing", 0

    def tell(self) -> None:
        """Write the file."""
        told = {"process": os.getpid(), "stage": self.stage, "step": self.step, "planned": self.planned}
        write_whole(self.folder.progress, json.dumps(told), sync=False)

    def started(self, problem: Problem) -> None:
        """Count the steps, where the solver does not choose them."""
        field, joint = problem.scene.ambient is not None, problem.plan.coupling == "joint"
        counts = [planned_steps(stage, with_field=field, joint=joint) for stage in problem.scene.path]
        self.planned = None if None in counts else sum(count for count in counts if count is not None)
        self.stage = problem.scene.path[0].name
        self.tell()

    def accepted(self, state: State, record: StepRecord) -> None:
        """A step is done."""
        self.stage, self.step = record.stage, record.number
        self.tell()


def _end_with(wait: Callable[[], object]) -> None:
    """End this process when ``wait`` returns, as its parent has ended: a study that is killed takes its cases along, so
    that the next one finds nobody at work in its folders."""

    def follow() -> None:
        wait()
        os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


def _print_to(log: Path) -> None:
    """Everything the process prints, also from compiled code, goes to a file."""
    target = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
    for stream in (1, 2):
        os.dup2(target, stream)
    os.close(target)


if __name__ == "__main__":
    _end_with(sys.stdin.buffer.read)  # of a pipe that nobody writes to: it ends with the process that made it
    solve_case(sys.argv[1])
