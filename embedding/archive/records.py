"""What an archive gives back about a run, as plain frozen records."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ArchivedDecision:
    """One choice of the plan, and why it was made; the ``number`` behind it, what that is the ``measure`` of, and up to
    which ``threshold`` it counted as small."""

    topic: str
    choice: str
    reason: str
    number: float | None = None
    measure: str = ""
    threshold: float | None = None


@dataclass(frozen=True)
class ArchivedPlan:
    """The plan the run followed."""

    decisions: tuple[ArchivedDecision, ...]
    lines: str

    def text(self) -> str:
        """The plan as it was printed."""
        return self.lines


@dataclass(frozen=True)
class ArchivedResult:
    """How the run ended: the name of the result, what it advises, and the message of this run."""

    name: str
    advice: str
    message: str


@dataclass(frozen=True)
class ArchivedError:
    """Estimated relative error of ``quantity`` at the last step: the sum of ``parts``, found by
    ``method``."""

    value: float
    quantity: str
    method: str
    parts: dict[str, float]


@dataclass(frozen=True)
class ArchivedCost:
    """What the run cost: seconds, bytes at the peak, unknowns by space, and seconds by part of the solver."""

    wall_seconds: float
    cpu_seconds: float
    peak_memory_bytes: int
    unknowns: dict[str, int]
    parts: dict[str, float]


@dataclass(frozen=True)
class Newton:
    """The Newton iterations of a step, one entry each: scaled norms, and the mean face pressures in Pa."""

    number: npt.NDArray[np.int64]
    update: Floats
    residual: Floats
    pressure_top: Floats
    pressure_bottom: Floats


UNFINISHED = ArchivedResult(
    "unfinished",
    "the run was killed or is still at work; the steps committed so far can be used",
    "the archive holds no end of the run",
)
