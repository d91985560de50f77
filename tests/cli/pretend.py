"""A solve that only pretends: objects with the face of the solver's, and the story it tells its listeners."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from embedding.solving.events import Iteration, StepRecord
from embedding.solving.solution import CriticalPoint


@dataclass(frozen=True)
class Estimate:
    """The face of an error estimate."""

    value: float
    quantity: str
    method: str
    parts: dict[str, float]


@dataclass(frozen=True)
class Cost:
    """The face of a cost."""

    wall_seconds: float
    cpu_seconds: float
    peak_memory_bytes: int
    unknowns: dict[str, int]
    parts: dict[str, float]


def iteration(number: int) -> Iteration:
    """A Newton step that converges well."""
    return Iteration(number, 10.0 ** (-2 * number), 10.0 ** (-2 * number - 1), -1.5, 400.0 + number)


def record(number: int, of: int) -> StepRecord:
    """An accepted step of an inflation."""
    scalars = {"stretch": 1.0 + 0.1 * number, "pressure_difference": 250.0 * number, "charge": float("nan")}
    return StepRecord(number, "inflate", number / of, 1.0, (iteration(1), iteration(2)), scalars, 0.1)


CRITICAL = CriticalPoint("limit", "inflate", 2, 0.74, 1.0, {"stretch": 1.38}, np.zeros(3), (0, 1))


def solution(scene: Any, archive: Path | None, steps: Sequence[StepRecord], result: str = "CONVERGED") -> Any:
    """Something with the face of a Solution."""
    return SimpleNamespace(
        scene=scene,
        result=SimpleNamespace(name=result, advice="take smaller steps"),
        message="the whole path is solved",
        steps=tuple(steps),
        critical_points=(CRITICAL,),
        assumptions=(),
        errors={},
        health=(),
        attempts=(),
        error=Estimate(value=2e-4, quantity="stretch", method="one order lower", parts={"discretisation": 2e-4}),
        cost=Cost(
            wall_seconds=75.0,
            cpu_seconds=70.0,
            peak_memory_bytes=310_000_000,
            unknowns={"displacement": 120, "potential": 1000},
            parts={"assembly": 50.0},
        ),
        archive=archive,
    )


def problem(scene: Any) -> Any:
    """Something with the face of a Problem, as far as listeners of the command line look."""
    plan = SimpleNamespace(coupling="joint")
    return SimpleNamespace(scene=scene, plan=plan, reduction=SimpleNamespace(name="axisymmetric"))


def play(scene: Any, listeners: Sequence[Any], fail_at: int | None = None) -> list[StepRecord]:
    """Tell the listeners the story of a solve; with ``fail_at`` it ends before that step is accepted."""
    total = sum(stage.steps for stage in scene.path)
    done: list[StepRecord] = []
    for listener in listeners:
        listener.started(problem(scene))
    for number in range(1, total + 1):
        for listener in listeners:
            for k in (1, 2):
                listener.iterated(number, {"mechanical": number / total, "field": 1.0}, iteration(k))
            if number == fail_at:
                listener.cut(number, 0.5, "Newton did not converge")
        if number == fail_at:
            return done
        done.append(record(number, total))
        for listener in listeners:
            listener.accepted(None, done[-1])
    return done
