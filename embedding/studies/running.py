"""Running a study: each case in a process of its own, each end a line in the index, and only what is missing."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from embedding.scene.messages import nearest
from embedding.studies.cases import Case, cases_of
from embedding.studies.display import StudyDisplay
from embedding.studies.errors import StudyError, require
from embedding.studies.files import StudyFolder, read_json, write_case
from embedding.studies.index import Index
from embedding.studies.record import DONE, KILLED, OVER_TIME, RAISED, failure
from embedding.studies.result import StudyResult, result_of
from embedding.studies.study import Study

LOOK = 0.2
"""Seconds between two looks at the running cases."""

NAME = "embedding case"
Running = dict[Future[None], Case]


def run_study(
    study: Study, folder: str | os.PathLike[str], *, workers: int | None = None, progress: bool = False
) -> StudyResult:
    """Solve the cases of ``study`` that are not done in ``folder`` yet, ``workers`` at once.

    A case that raises, diverges, is killed or takes too long is a row with its reason; the next call tries those again.
    A script that calls this needs the guard ``if __name__ == "__main__":``, as its cases have processes of their own.

    Raises:
        SceneError: a parameter or one of its values does not exist in the scene; nothing has been solved then.
        StudyError: a package is missing, the folder belongs to something else or to a study at work, or a quantity
            names no scalar.
    """
    require("pebble")
    cases = cases_of(study)
    home = StudyFolder(Path(folder).resolve())
    home.prepare(study)
    with Index(home.index) as index:
        wanted = {case.key: case for case in reversed(cases) if case.scene is not None}
        for key in wanted:
            _adopt(index, home, key)
        known = [case for case in wanted.values() if index.records.get(case.key, {}).get("status") == DONE]
        for case in known[:1]:
            _check_scalars(study, index.records[case.key])
        missing = sorted((case for case in wanted.values() if case not in known), key=lambda case: case.number)
        with StudyDisplay(study.name, len(wanted), len(known), quiet=not progress) as display:
            for case, record in _solved(study, home, missing, workers or _workers(study), display):
                index.append({"case": case.key, "changes": list(case.changes), **record})
                display.finished(case, record)
                if record["status"] == DONE:
                    _check_scalars(study, record)
        return result_of(study, cases, index.records, home.path)


def _workers(study: Study) -> int:
    """As many as the study says, or as there are processors for."""
    processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return study.limits.workers or max(1, processors // study.limits.threads)


def _adopt(index: Index, home: StudyFolder, key: str) -> None:
    """A case that was done when its study was killed has its record, but no line in the index yet."""
    if index.records.get(key, {}).get("status") == DONE:
        return
    record = read_json(home.case(key).record)
    if record is not None and record.get("status") == DONE:
        index.append({"case": key, **record})


def _solved(
    study: Study, home: StudyFolder, missing: Sequence[Case], workers: int, display: StudyDisplay
) -> Iterator[tuple[Case, dict[str, Any]]]:
    """Solve cases; yields each with its record as it ends."""
    start = _starter(study)
    queue, running = deque(missing), Running()
    with _stopped_at_the_end(running):
        while queue or running:
            while queue and len(running) < workers:
                case = queue.popleft()
                if case.scene is not None:
                    folder = home.case(case.key)
                    write_case(folder, case.scene)
                    running[start(str(folder.path))] = case
            for future in wait(running, timeout=LOOK, return_when=FIRST_COMPLETED).done:
                case = running.pop(future)
                yield case, _record(study, home, case, future)
            display.refresh(home, running.values())


def _starter(study: Study) -> Any:
    """A function that starts a case in a process of its own and returns its future.

    The processes are forked from one that has loaded the solver and has never solved anything.
    """
    from pebble.concurrent import process

    from embedding.studies.worker import PRELOADED, solve_case

    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in methods else "spawn")
    if context.get_start_method() == "forkserver":
        context.set_forkserver_preload(list(PRELOADED))
    # Pebble reads "context", while its signature and its documentation say "mp_context".
    options: dict[str, Any] = {"context": context, "mp_context": context}
    return process(name=NAME, timeout=study.limits.seconds, **options)(solve_case)


@contextmanager
def _stopped_at_the_end(running: Running) -> Iterator[None]:
    """Whatever ends the study ends the cases that are still running."""
    try:
        yield
    finally:
        for future in running:
            future.cancel()
        if running:
            for child in multiprocessing.active_children():
                if child.name == NAME:
                    child.join()


def _record(study: Study, home: StudyFolder, case: Case, future: Future[None]) -> dict[str, Any]:
    """How a case ended: as its process wrote it, or, if it could not, as seen from here."""
    from pebble import ProcessExpired

    folder = home.case(case.key)
    folder.progress.unlink(missing_ok=True)
    record = read_json(folder.record)
    if record is not None:
        return record
    error = future.exception()
    if isinstance(error, TimeoutError):
        return failure(OVER_TIME, f"not done after {study.limits.seconds:g} s")
    if isinstance(error, ProcessExpired):
        return failure(KILLED, death(error.exitcode))
    return failure(RAISED, f"{type(error).__name__}: {error}")


def death(code: int | None) -> str:
    """Why a process ended, from its exit code."""
    if code is None or code >= 0:
        return f"the process ended with exit code {code}"
    number = -code
    name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
    memory = ", as the system does where memory is short" if number == getattr(signal, "SIGKILL", None) else ""
    return f"the process was ended by {name}{memory}"


def _check_scalars(study: Study, record: dict[str, Any]) -> None:
    """Raise StudyError if a quantity names a scalar that the first case does not have: no case will."""
    there = record["states"]["last"]
    for name, quantity in study.wanted.items():
        if quantity.scalar not in there:
            guess = nearest(quantity.scalar, there)
            hint = f'did you mean "{guess}"?' if guess else f"there are {', '.join(there)}"
            raise StudyError(f"quantities.{name}: no scalar {quantity.scalar}: {hint}")
