"""Where cases are solved: on this machine each in a process of its own, forked from one that has loaded the solver."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, wait
from types import TracebackType
from typing import Any, Protocol, Self

from embedding.studies.cases import Case
from embedding.studies.errors import require
from embedding.studies.files import CaseFolder, StudyFolder, read_json
from embedding.studies.record import KILLED, OVER_TIME, RAISED, failure

LOOK = 0.2
"""Seconds between two looks at the running cases."""

NAME = "embedding case"

Record = dict[str, Any]


class Pool(Protocol):
    """Solves cases; whatever ends the block it is entered for ends the cases that are still at work."""

    capacity: int
    """Cases at once."""

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    @property
    def running(self) -> list[Case]:
        """The cases that were started and have not ended."""
        ...

    def start(self, case: Case) -> None:
        """Begin a case whose folder holds its scene."""
        ...

    def ended(self) -> Iterator[tuple[Case, Record]]:
        """Those that have ended since the last call, each with its record; waits a moment for one."""
        ...


class LocalPool:
    """Processes of this machine, ``capacity`` at once, each for at most ``seconds`` (None: any)."""

    def __init__(self, home: StudyFolder, seconds: float | None, capacity: int) -> None:
        self.home, self.seconds, self.capacity = home, seconds, capacity
        self._start = _starter(seconds)
        self._running: dict[Future[None], Case] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for future in self._running:
            future.cancel()
        if self._running:
            for child in multiprocessing.active_children():
                if child.name == NAME:
                    child.join()

    @property
    def running(self) -> list[Case]:
        """The cases at work."""
        return list(self._running.values())

    def start(self, case: Case) -> None:
        """Fork a process for it."""
        self._running[self._start(str(self.home.case(case.key).path))] = case

    def ended(self) -> Iterator[tuple[Case, Record]]:
        """The cases whose processes have ended."""
        for future in wait(self._running, timeout=LOOK, return_when=FIRST_COMPLETED).done:
            case = self._running.pop(future)
            yield case, self._record(self.home.case(case.key), future)

    def _record(self, folder: CaseFolder, future: Future[None]) -> Record:
        """How a case ended: as its process wrote it, or, if it could not, as seen from here."""
        from pebble import ProcessExpired

        folder.progress.unlink(missing_ok=True)
        record = read_json(folder.record)
        if record is not None:
            return record
        error = future.exception()
        if isinstance(error, TimeoutError):
            return late(self.seconds or 0.0)
        if isinstance(error, ProcessExpired):
            return failure(KILLED, death(error.exitcode))
        return failure(RAISED, f"{type(error).__name__}: {error}")


def late(seconds: float) -> Record:
    """The record of a case that was stopped at its time limit."""
    return failure(OVER_TIME, f"not done after {seconds:g} s")


def death(code: int | None) -> str:
    """Why a process ended, from its exit code."""
    if code is None or code >= 0:
        return f"the process ended with exit code {code}"
    number = -code
    name = signal.Signals(number).name if number in set(signal.Signals) else f"signal {number}"
    memory = ", as the system does where memory is short" if number == getattr(signal, "SIGKILL", None) else ""
    return f"the process was ended by {name}{memory}"


def _starter(seconds: float | None) -> Any:
    """A function that starts a case in a process of its own and returns its future.

    The processes are forked from one that has loaded the solver and has never solved anything.
    """
    require("pebble")
    from pebble.concurrent import process

    from embedding.studies.worker import PRELOADED, solve_case

    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in methods else "spawn")
    if context.get_start_method() == "forkserver":
        context.set_forkserver_preload(list(PRELOADED))
    # Pebble reads "context", while its signature and its documentation say "mp_context".
    options: dict[str, Any] = {"context": context, "mp_context": context}
    return process(name=NAME, timeout=seconds, **options)(solve_case)
