"""Running the map: every cell in a process of its own, which may take its time and memory and no more."""

from __future__ import annotations

import multiprocessing
import resource
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, as_completed
from typing import Any

from embedding.bench.extremes.cell import Cell, Finding
from embedding.bench.extremes.families import cells_of
from embedding.bench.extremes.judging import judge, lost
from embedding.studies.errors import require
from embedding.studies.pool import death
from embedding.studies.worker import PRELOADED

MEMORY = 6_000_000_000
"""Bytes of address space that a cell may take."""


def find(cells: Sequence[Cell], *, workers: int = 1, threads: int | None = None) -> Iterator[Finding]:
    """Judge ``cells``, ``workers`` at once, and yield what is found as it is found.

    ``threads`` overrides what their scenes say. A cell that dies, or does not end in its time, is wrong.

    Raises:
        StudyError: a package of the extra ``studies`` is missing.
    """
    require("pebble")
    from pebble import ProcessPool

    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("forkserver" if "forkserver" in methods else "spawn")
    if context.get_start_method() == "forkserver":
        context.set_forkserver_preload(list(PRELOADED))
    with ProcessPool(max_workers=workers, max_tasks=1, context=context) as pool:
        waiting: dict[Future[Finding], Cell] = {}
        for cell in cells:
            place = cell.family, cell.row, cell.value
            waiting[pool.schedule(_in_process, args=(place, threads), timeout=cell.seconds)] = cell
        for future in as_completed(waiting):
            yield _ended(waiting[future], future)


def _in_process(place: tuple[str, str, str], threads: int | None) -> Finding:
    """Judge the cell at a place of the map, within the memory allowed."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, hard))
    (cell,) = (one for one in cells_of(place[0]) if (one.family, one.row, one.value) == place)
    return judge(cell, threads)


def _ended(cell: Cell, future: Future[Any]) -> Finding:
    from pebble import ProcessExpired

    error = future.exception()
    if error is None:
        found: Finding = future.result()
        return found
    if isinstance(error, TimeoutError):
        return lost(cell, f"not done after {cell.seconds:g} s")
    if isinstance(error, ProcessExpired):
        return lost(cell, death(error.exitcode))
    return lost(cell, f"{type(error).__name__}: {error}")
