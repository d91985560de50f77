"""What the solver tells while it works: iterations, accepted steps, cuts; and who may listen.

The solver stays free of files and screens: progress bars, archives and early stops are listeners.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from embedding.solving.problem import Problem
    from embedding.solving.solution import Solution
    from embedding.solving.state import State


@dataclass(frozen=True)
class Iteration:
    """One Newton step: update and residual norms (scaled, dimensionless) and the mean face pressures in Pa."""

    number: int
    update: float
    residual: float
    pressure_top: float
    pressure_bottom: float


@dataclass(frozen=True)
class StepRecord:
    """One accepted load step: where on the path it is, how Newton got there, and its scalars in SI units."""

    number: int
    stage: str
    factor_mechanical: float
    factor_field: float
    iterations: tuple[Iteration, ...]
    scalars: dict[str, float]
    wall_seconds: float

    @property
    def stable(self) -> bool | None:
        """Has the shell no unstable mode? None where that is not known, see the theory page "Critical points"."""
        unstable = self.scalars.get("unstable_modes", math.nan)
        return None if math.isnan(unstable) else unstable == 0


@dataclass(frozen=True)
class Derived:
    """How a field follows, point by point, from the one called ``name`` on its block: ``of`` values (n,) or (n, 3)
    in SI units."""

    name: str
    of: Callable[[Any], Any]


@dataclass(frozen=True)
class Field:
    """A named field on one block of the mesh, live at the time of the call.

    ``values`` is an NGSolve coefficient function in SI units; vectors have the components of the mesh's own dimension,
    or three Cartesian ones; 3 x 3 tensors have nine, by rows. One that is ``derived`` can be had for less from the
    values of another.
    """

    block: str
    name: str
    unit: str
    values: Any
    derived: Derived | None = None


class Listener:
    """Base class of everything that watches a solve; every method may be overridden, none needs to be."""

    def started(self, problem: Problem) -> None:
        """The problem is meshed and planned; no step has been taken yet."""

    def iterated(self, step_number: int, target: dict[str, float], iteration: Iteration) -> None:
        """A Newton step towards the load ``target`` is done."""

    def accepted(self, state: State, record: StepRecord) -> None:
        """A load step has converged."""

    def cut(self, step_number: int, fraction: float, reason: str) -> None:
        """A load step failed and is retried at ``fraction`` of its planned length."""

    def remeshed(self, problem: Problem) -> None:
        """The space around the shell has a new mesh: ``problem`` takes the place of the one before."""

    def finished(self, solution: Solution) -> None:
        """The path has ended, well or not; ``solution.result`` says which."""
