"""What a solve returns: the accepted steps with their scalars, how it ended, its error and its cost."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from embedding.plan.decisions import Plan
from embedding.scene import Scales, Scene
from embedding.solving.events import StepRecord
from embedding.solving.result import Result

DISCRETE = ("shell", "geometry", "ambient", "ambient and coupling")
"""Sources of errors that finer meshes and higher orders reduce."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Relative error of ``quantity`` at the last step: the sum of ``parts``, each with its own source.

    ``method`` says how the parts were obtained; what was not estimated is not in ``parts``.
    """

    value: float
    quantity: str
    method: str
    parts: dict[str, float]

    @property
    def discretisation(self) -> float:
        """The part of mesh and orders, of shell, geometry and ambient."""
        return sum(self.parts.get(source, 0.0) for source in DISCRETE)


@dataclass(frozen=True)
class Assumption:
    """One thing the plan left out, and whether that was allowed: at the solution, it is worth ``number``.

    ``topic`` and ``choice`` are those of the plan's decision, ``allowed`` is the largest number at which the
    assumption counts as ``held``. ``rung`` has the overrides of the scene that bring the term back; none where the
    scene itself pins the choice, or where no model of this package has it.
    """

    topic: str
    choice: str
    number: float
    allowed: float
    held: bool
    sentence: str
    rung: tuple[str, ...] = ()


@dataclass(frozen=True)
class Check:
    """One number that tells whether a solution is sound: its ``value`` in a ``unit`` ("" for a plain number), what it
    should be as a text, whether it is ``good``, and what it is."""

    topic: str
    value: float
    unit: str
    should_be: str
    good: bool
    sentence: str


@dataclass(frozen=True)
class Cost:
    """What the solve cost: seconds, peak memory of the process in bytes, unknowns by name, seconds by part."""

    wall_seconds: float
    cpu_seconds: float
    peak_memory_bytes: int
    unknowns: dict[str, int]
    parts: dict[str, float]


@dataclass(frozen=True)
class CriticalPoint:
    """A state in which the shell's tangent stiffness is singular, met between step ``before_step`` - 1 and that step.

    At a "limit" point the load turns; at a "bifurcation" the path goes on and another branch crosses it. ``scalars``
    are those of the state, ``mode`` holds the unknowns of the critical displacement (root mean square 1 over the
    shell, in shell sizes), ``unstable`` the numbers of unstable modes before and behind, None where they are not known.
    """

    kind: Literal["limit", "bifurcation"]
    stage: str
    before_step: int
    factor_mechanical: float
    factor_field: float
    scalars: dict[str, float]
    mode: npt.NDArray[np.float64]
    unstable: tuple[int | None, int | None]


@dataclass(frozen=True)
class Attempt:
    """One solve on the way to an accuracy: what it changed of the scene, its estimated error (None without an answer),
    why it was not enough ("" where it was), and what it took."""

    changes: tuple[str, ...]
    estimate: float | None
    reason: str
    wall_seconds: float
    cpu_seconds: float


@dataclass(frozen=True)
class Solution:
    """The outcome of a solve, complete or not; ``solution["stretch"]`` is a scalar's history in SI units.

    ``errors`` has the estimated error of every scalar of the last step, ``error`` that of the answer: the largest of
    those that ``scene.accuracy`` names, or one that fits the scene.

    ``iterations`` counts every Newton step, those of failed attempts and of looking for critical points included.
    ``health`` says whether mesh and equations were fit to give an answer.
    ``attempts`` are the solves that led to a stated accuracy, this one the last.
    ``start`` is "rest", "neighbour" where the state of another run was started from, or "rest: ..." with the reason why
    it could not be. ``assumptions`` are what the plan left out, checked on the last step.
    """

    scene: Scene
    plan: Plan
    scales: Scales
    result: Result
    message: str
    steps: tuple[StepRecord, ...]
    error: ErrorEstimate | None
    cost: Cost
    archive: Path | None = None
    errors: dict[str, ErrorEstimate] = field(default_factory=dict)
    critical_points: tuple[CriticalPoint, ...] = ()
    iterations: int = 0
    start: str = "rest"
    health: tuple[Check, ...] = ()
    attempts: tuple[Attempt, ...] = ()
    assumptions: tuple[Assumption, ...] = ()

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        """History of the scalar ``name`` over the accepted steps.

        Raises:
            KeyError: no such scalar; the message lists those there are.
        """
        if self.steps and name not in self.steps[0].scalars:
            raise KeyError(f"{name}: there are {', '.join(self.steps[0].scalars)}")
        return np.array([step.scalars[name] for step in self.steps])

    @property
    def pressures(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Means of p_t and p_b over the shell, in Pa, over the accepted steps."""
        return self["pressure_top"], self["pressure_bottom"]
