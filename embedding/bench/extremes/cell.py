"""One cell of the map: a scene at an extreme, what is known of it, and what was found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from embedding.scene import Scene
    from embedding.solving import Solution

RIGHT, TOLD, FAILED, REFUSED, WRONG = "right", "told", "failed", "refused", "wrong"
"""Verdicts: within the tolerance; off, but the solution says so itself; ended with a true reason; not accepted, with a
true reason; everything else."""

Numbers = Mapping[str, float]


def last_scalars(solution: Solution) -> Numbers:
    """The scalars of the last accepted step, in SI units."""
    return solution.steps[-1].scalars if solution.steps else {}


def nothing() -> Numbers:
    """No number is known."""
    return {}


@dataclass(frozen=True)
class Cell:
    """A scene whose ``answers`` should be those of ``reference`` (by its ``source``) to the relative ``tolerance``.

    It stands in the map of its ``family`` in a ``row``, in the column ``value``. ``reasons`` are the results of a solve
    that would be a true reason to fail, ``fields`` the paths (or beginnings of paths) in a scene that may truly be
    refused, ``warnings`` the topics of health checks and assumptions that would be the true cause of an error: where
    one of these is red the error was told, whatever is estimated; no other one counts.

    ``expected`` is the verdict that tests hold it to. Where that is ``FAILED`` the answers of the steps that were
    accepted are compared as well, so that an end is at the right place. A cell is given up after ``seconds``; a
    ``slow`` one is left out of the default tests.
    """

    family: str
    row: str
    value: str
    scene: Callable[[], Scene]
    reference: Callable[[], Numbers] = nothing
    source: str = ""
    tolerance: float = 1e-3
    answers: Callable[[Solution], Numbers] = last_scalars
    reasons: frozenset[str] = frozenset()
    fields: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    expected: str = RIGHT
    seconds: float = 60.0
    slow: bool = False

    @property
    def name(self) -> str:
        """The cell in words, unique in the map."""
        return f"{self.family}: {self.row}, {self.value}"


@dataclass(frozen=True)
class Finding:
    """What became of a cell: its ``verdict``; ``reason`` names the result, the refused field or what told of the error;
    ``error`` is the largest relative one and ``stated`` what the solution itself says of that number (nan where there
    is none), ``message`` what a user reads."""

    family: str
    row: str
    value: str
    verdict: str
    reason: str = ""
    error: float = float("nan")
    stated: float = float("nan")
    message: str = ""
    source: str = ""
    seconds: float = 0.0
    found: Numbers = field(default_factory=dict)
