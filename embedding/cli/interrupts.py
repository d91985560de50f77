"""Ctrl-C and SIGTERM during a solve: the present Newton iteration is finished first, so that nothing is cut in two.

SIGTERM is what batch systems send some time before they kill.

Python raises KeyboardInterrupt between any two of its instructions, also inside callbacks of the garbage collector,
where it is lost. Here the first signal is only noted, and raised where the solver tells of an iteration.
"""

from __future__ import annotations

import signal
import sys
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, Self

from embedding.solving.events import Iteration, Listener

if TYPE_CHECKING:
    from embedding.solving.problem import Problem
    from embedding.solving.solution import Solution

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Interrupts(Listener):
    """A listener, and a context manager around the solve, that turns the first signal into an orderly end.

    The second one raises KeyboardInterrupt on the spot. Leaving the context raises it as well if the solver gave no
    occasion before. Works in the main thread, as signals do.
    """

    def __init__(self) -> None:
        self._asked = self._complete = False
        self._former: dict[int, Any] = {}

    def __enter__(self) -> Self:
        self._former = {number: signal.signal(number, self._note) for number in SIGNALS}
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, former in self._former.items():
            signal.signal(number, former)
        if kind is None and not self._complete:
            self._obey()

    def started(self, problem: Problem) -> None:
        """A solve begins."""
        self._complete = False

    def finished(self, solution: Solution) -> None:
        """A signal that comes while nothing but its error is still estimated does not undo a run."""
        self._complete = solution.result.ok

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        """End the solve here if that was asked for."""
        self._obey()

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._asked:
            raise KeyboardInterrupt
        self._asked = True
        if sys.stderr.isatty():
            print("interrupted: ends after this iteration (again: at once)", file=sys.stderr)

    def _obey(self) -> None:
        if self._asked:
            self._asked = False
            raise KeyboardInterrupt
