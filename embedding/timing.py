"""Where the time of a run goes, by named parts. Timers stand in the code for good and do nothing until a watch runs.

A part that runs inside another is charged to itself alone, under the names of both; so all parts add up to no more
than the whole.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


class Watch:
    """Seconds and calls of every part by its names, outermost first, and the time of no part under ``()``."""

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self.seconds: dict[tuple[str, ...], float] = {}
        self.calls: dict[tuple[str, ...], int] = {}
        self._clock, self._last = clock, clock()
        self._open: tuple[str, ...] = ()

    def enter(self, name: str) -> None:
        """A part begins, inside those that are open."""
        self.charge()
        self._open = (*self._open, name)
        self.calls[self._open] = self.calls.get(self._open, 0) + 1

    def leave(self) -> None:
        """The part that was entered last ends."""
        self.charge()
        self._open = self._open[:-1]

    def charge(self) -> None:
        """Bring the count of the parts that are open up to now."""
        now = self._clock()
        self.seconds[self._open] = self.seconds.get(self._open, 0.0) + now - self._last
        self._last = now


_watch: Watch | None = None


@contextmanager
def watching(watch: Watch) -> Iterator[Watch]:
    """Let ``watch`` see every part until the end of the block."""
    global _watch
    before, _watch = _watch, watch
    try:
        yield watch
    finally:
        _watch = before


class part:
    """``with part("matrix"): ...``, or ``@part("matrix")`` over a function: its time is that of a part."""

    __slots__ = ("_name", "_watch")

    def __init__(self, name: str) -> None:
        self._name = name
        self._watch: Watch | None = None

    def __enter__(self) -> None:
        self._watch = _watch
        if self._watch is not None:
            self._watch.enter(self._name)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._watch is not None:
            self._watch.leave()

    def __call__(self, function: Callable[P, R]) -> Callable[P, R]:
        @functools.wraps(function)
        def timed(*args: P.args, **kwargs: P.kwargs) -> R:
            watch = _watch
            if watch is None:
                return function(*args, **kwargs)
            watch.enter(self._name)
            try:
                return function(*args, **kwargs)
            finally:
                watch.leave()

        return timed
