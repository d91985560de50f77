"""Running a study: each case in a process of its own, each end a line in the index, and only what is missing."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from embedding.scene.messages import nearest
from embedding.studies.cases import Case, cases_of
from embedding.studies.cluster import DaskPool
from embedding.studies.display import StudyDisplay
from embedding.studies.errors import StudyError
from embedding.studies.files import StudyFolder, read_json, write_case
from embedding.studies.index import Index
from embedding.studies.pool import LocalPool, Pool
from embedding.studies.record import DONE, KILLED, OVER_TIME
from embedding.studies.result import StudyResult, result_of
from embedding.studies.study import Study


def run_study(
    study: Study,
    folder: str | os.PathLike[str],
    *,
    workers: int | None = None,
    scheduler: Any = None,
    progress: bool = False,
) -> StudyResult:
    """Solve the cases of ``study`` that are not done in ``folder`` yet, ``workers`` at once.

    With ``scheduler``, the address of a dask scheduler or a cluster of dask, its workers solve them; they must see
    ``folder``. A case that raises, diverges, is killed or takes too long is a row with its reason; the next call tries
    those again. A script that calls this needs the guard ``if __name__ == "__main__":``, as its cases have processes of
    their own.

    Raises:
        SceneError: a parameter or one of its values does not exist in the scene; nothing has been solved then.
        StudyError: a package is missing, the folder belongs to something else or to a study at work, no scheduler
            answers, or a quantity names no scalar.
    """
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
            pool = _pool(study, home, workers, scheduler)
            for case, record in _solved(home, missing, pool, display, Earlier(home, cases, index)):
                index.append({"case": case.key, "changes": list(case.changes), **record})
                display.finished(case, record)
                if record["status"] == DONE:
                    _check_scalars(study, record)
        return result_of(study, cases, index.records, home.path)


def _pool(study: Study, home: StudyFolder, workers: int | None, scheduler: Any) -> Pool:
    """As many processes as the study says, or as there are processors for; or what a scheduler has."""
    asked, seconds = workers or study.limits.workers, study.limits.seconds
    if scheduler is not None:
        return DaskPool(home, seconds, asked, scheduler)
    processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return LocalPool(home, seconds, asked or max(1, processors // study.limits.threads))


def _adopt(index: Index, home: StudyFolder, key: str) -> None:
    """A case that was done when its study was killed has its record, but no line in the index yet."""
    if index.records.get(key, {}).get("status") == DONE:
        return
    record = read_json(home.case(key).record)
    if record is not None and record.get("status") == DONE:
        index.append({"case": key, **record})


def _solved(
    home: StudyFolder, missing: Sequence[Case], pool: Pool, display: StudyDisplay, earlier: Earlier
) -> Iterator[tuple[Case, dict[str, Any]]]:
    """Solve cases, each after the one that it starts from; yields each with its record as it ends."""
    queue = list(missing)
    with pool:
        while queue or pool.running:
            waiting = {case.number for case in (*queue, *pool.running)}
            ready = [case for case in queue if case.before not in waiting]
            for case in ready[: max(0, pool.capacity - len(pool.running))]:
                queue.remove(case)
                if case.scene is not None:
                    write_case(home.case(case.key), case.scene, earlier.start(case), go_on=earlier.hindered(case))
                    pool.start(case)
            for case, record in pool.ended():
                if case.before is not None and record.get("start") == "rest":
                    record["start"] = "rest: no case before it is done"
                yield case, record
            display.refresh(home, pool.running)


@dataclass(frozen=True)
class Earlier:
    """What a case starts from: the archive of an earlier attempt at itself; in a continuation that of the nearest case
    before it that is done."""

    home: StudyFolder
    cases: Sequence[Case]
    index: Index

    def hindered(self, case: Case) -> bool:
        """Was an earlier attempt at the case ended from outside, so that it may go on where it was?"""
        known = self.index.records.get(case.key)
        return known is None or known["status"] in (KILLED, OVER_TIME)

    def start(self, case: Case) -> Path | None:
        """None for a start from rest."""
        before = case.before
        while before is not None:
            known = self.cases[before]
            archive = self.home.case(known.key).archive
            if self.index.records.get(known.key, {}).get("status") == DONE and archive.exists():
                return archive
            before = known.before
        return None


def _check_scalars(study: Study, record: dict[str, Any]) -> None:
    """Raise StudyError if a quantity names a scalar that the first case does not have: no case will."""
    there = record["states"]["last"]
    for name, quantity in study.wanted.items():
        if quantity.scalar not in there:
            guess = nearest(quantity.scalar, there)
            hint = f'did you mean "{guess}"?' if guess else f"there are {', '.join(there)}"
            raise StudyError(f"quantities.{name}: no scalar {quantity.scalar}: {hint}")
