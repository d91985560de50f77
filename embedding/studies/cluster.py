"""Where cases are solved beyond one machine: tasks of a dask scheduler, whose workers share the study's folder."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from embedding.studies.cases import Case
from embedding.studies.errors import StudyError, require
from embedding.studies.files import CaseFolder, StudyFolder, read_json
from embedding.studies.pool import Record, death, late
from embedding.studies.record import KILLED, RAISED, failure

CONNECT = 30.0
"""Seconds to wait for the scheduler."""

LOOK = 0.2
ENDLESS = 1_000_000
"""Cases at once: all are handed to the scheduler, which knows what its workers can do."""


class DaskPool:
    """Workers of a dask ``scheduler``: its address, or a cluster such as a ``LocalCluster`` or a ``SLURMCluster``.

    A worker that is lost is no end of its case: the scheduler gives it to another one, three times by default
    (``distributed.scheduler.allowed-failures``).

    Raises:
        StudyError: dask is missing, or no scheduler answers.
    """

    def __init__(self, home: StudyFolder, seconds: float | None, capacity: int | None, scheduler: Any) -> None:
        require("distributed", extra="dask")
        from distributed import Client

        self.home, self.seconds, self.capacity = home, seconds, capacity or ENDLESS
        try:
            self._client = Client(scheduler, timeout=CONNECT, set_as_default=False)
        except (OSError, ValueError) as error:
            raise StudyError(f"{scheduler}: no dask scheduler answers: {error}") from error
        self._running: dict[Any, Case] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._client.cancel(list(self._running))
        self._client.close()

    @property
    def running(self) -> list[Case]:
        """The cases that the scheduler has."""
        return list(self._running.values())

    def start(self, case: Case) -> None:
        """Hand it to the scheduler."""
        path = str(self.home.case(case.key).path)
        self._running[self._client.submit(solve_on_worker, path, self.seconds, pure=False)] = case

    def ended(self) -> Iterator[tuple[Case, Record]]:
        """The cases whose tasks have ended."""
        done = [future for future in self._running if future.done()]
        if not done:
            time.sleep(LOOK)
        for future in done:
            case = self._running.pop(future)
            self.home.case(case.key).progress.unlink(missing_ok=True)
            yield case, _record(future)


def _record(future: Any) -> Record:
    """What a task brought back, or why it did not."""
    from distributed import CancelledError, KilledWorker

    try:
        return dict(future.result())
    except KilledWorker:
        return failure(KILLED, "every dask worker that it was given to was lost")
    except CancelledError:
        return failure(KILLED, "the dask scheduler dropped it, or was lost itself")
    except Exception as error:
        return failure(RAISED, f"{type(error).__name__}: {error}")


def solve_on_worker(path: str, seconds: float | None) -> Record:
    """Runs on a dask worker: the case in the folder ``path``, in a process of its own; returns its record."""
    folder = CaseFolder(Path(path))
    if not folder.scene.is_file():
        from distributed import get_worker

        reason = f"the dask worker {get_worker().address} does not see {path}; the folder must be one that all share"
        return failure(RAISED, reason)
    done = read_json(folder.record)
    if done is not None:  # by a worker that was lost before it could tell
        return done
    command = [sys.executable, "-m", "embedding.studies.worker", path]
    # The pipe ends with this process, and the case with the pipe.
    with subprocess.Popen(command, stdin=subprocess.PIPE, env=_environment()) as process:
        stopped = _watch(process, seconds)
        process.kill()
    return read_json(folder.record) or stopped or failure(KILLED, death(process.returncode))


def _watch(process: subprocess.Popen[bytes], seconds: float | None) -> Record | None:
    """Wait for the end of a process, for at most ``seconds``, and only as long as anyone wants its result; the record
    if that was before the end."""
    from distributed import get_worker

    worker = get_worker()
    key, begun = worker.get_current_task(), time.monotonic()
    while process.poll() is None:
        if seconds is not None and time.monotonic() - begun > seconds:
            return late(seconds)
        task = worker.state.tasks.get(key)
        if task is None or task.state == "cancelled":
            return failure(KILLED, "the study ended before it")
        time.sleep(LOOK)
    return None


def _environment() -> dict[str, str]:
    """That of this process; its modules are found where they are found here."""
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
