"""Newton's method for one load step: the ambient follows, the field is re-solved, then one joint update.

The interior motion of the ambient is frozen in the joint update; without the potential's own solve before it Newton
diverges, because the old potential was carried along with the moved mesh. Updates that would turn elements over are
halved; whatever fails gets a typed reason.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import Memory, System
from embedding.solving.events import Iteration
from embedding.solving.path import Target
from embedding.solving.result import Result

LARGEST_UPDATE = 0.5
MOST_HALVINGS = 6
SHRINKING, STALLED = 0.7, 4
"""Newton is given up when the best of the last ``STALLED`` updates is above ``SHRINKING`` times the best before."""
ENOUGH, ROUGHLY = 1e-2, 1e-3
"""What iterative linear solvers leave of the error at first; later the square of what the last step left of the
residual before: no more than Newton's method leaves itself (S. Eisenstat, H. Walker, SIAM J. Sci. Comput. 17 (1996)
16, choice 2). And what they leave of the error of the potential, which the joint step then corrects."""
PROXIMAL, FADING, GONE = 0.3, 0.4, 1e-4
"""Proximal stiffness of the first iteration in shear moduli, its factor from one to the next, and where it ends."""


@dataclass
class Clock:
    """Seconds spent in each part of the Newton steps."""

    parts: dict[str, float] = field(default_factory=dict)

    def add(self, part: str, start: float) -> float:
        """Charge the time since ``start`` to ``part``; returns the time now."""
        now = time.perf_counter()
        self.parts[part] = self.parts.get(part, 0.0) + now - start
        return now


@dataclass(frozen=True)
class Outcome:
    """How a Newton solve ended; ``reason`` is None when it converged, ``detail`` may say more about it."""

    iterations: tuple[Iteration, ...]
    reason: Result | None
    detail: str = ""


class Newton:
    """Newton's method on a coupled ``system`` to a scaled ``tolerance`` of update and decrement."""

    def __init__(self, system: System, tolerance: float, max_iterations: int, pressures: Any) -> None:
        self.system, self.tolerance, self.max_iterations = system, tolerance, max_iterations
        self._pressures = pressures
        self.clock = Clock()
        self.scalars: dict[str, float] = {}  # other ways to solve a load step have something to tell, see Session

    def load(self, target: Target) -> None:
        """Set the load of the system."""
        self.system.load(target.mechanical, target.field, target.volume, target.pressure)

    def memory(self) -> Memory:
        """Nothing: a load step depends on the state of the system alone."""
        return {}

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned."""

    def solve(self, watch: Callable[[Iteration], None], *, at_rest: bool = False) -> Outcome:
        """Iterate from the present state; the state is only good afterwards if the outcome has no reason.

        A membrane ``at_rest`` has no stiffness against bending or, without curvature, against any motion out of its
        plane. If plain Newton fails from there, a second attempt starts with a proximal term and lets it fade; plain
        Newton is given up as soon as its updates stop shrinking.
        """
        if not at_rest:
            return self._iterate(watch, 0.0)
        saved = self.system.save()
        outcome = self._iterate(watch, 0.0, patient=False)
        if outcome.reason is None:
            return outcome
        self.system.restore(saved)
        return self._iterate(watch, PROXIMAL)

    def _iterate(self, watch: Callable[[Iteration], None], proximal: float, *, patient: bool = True) -> Outcome:
        try:
            return self._converge(watch, proximal, patient)
        finally:
            self.system.factors.proximal.Set(0.0)

    def _converge(self, watch: Callable[[Iteration], None], proximal: float, patient: bool) -> Outcome:
        iterations: list[Iteration] = []
        plain: list[float] = []
        enough = ENOUGH
        self.system.begin()
        if not self._follow():
            return Outcome((), Result.INVERTED_AMBIENT)
        for number in range(1, self.max_iterations + 1):
            self.system.factors.proximal.Set(proximal)
            proximal = proximal * FADING if proximal > GONE else 0.0
            try:
                update, residual = self._update(enough)
            except LinearSolverError:
                return Outcome(tuple(iterations), Result.LINEAR_SOLVER_FAILED)
            if update == math.inf:
                return Outcome(tuple(iterations), Result.INVERTED_AMBIENT)
            if not math.isfinite(update + residual):
                return Outcome(tuple(iterations), Result.STEP_BELOW_MINIMUM)
            iterations.append(Iteration(number, update, residual, *self._pressures()))
            watch(iterations[-1])
            if max(update, residual) < self.tolerance and proximal == 0.0:
                return Outcome(tuple(iterations), None)
            if len(iterations) > 1:
                enough = min(ENOUGH, (residual / iterations[-2].residual) ** 2)
            plain = plain + [update] if proximal == 0.0 else []
            if _hopeless(plain, patience=STALLED if patient else 1):
                break
        return Outcome(tuple(iterations), Result.STEP_BELOW_MINIMUM)

    def _update(self, enough: float) -> tuple[float, float]:
        start = time.perf_counter()
        if self.system.potential is not None:
            self.system.potential.solve(ROUGHLY)
            start = self.clock.add("potential", start)
        step, residual = self.system.newton_update(enough)
        size = self.system.displacement_norm(step)
        if size > LARGEST_UPDATE:
            step.data = (LARGEST_UPDATE / size) * step
        self.clock.add("joint", start)
        return (size if self._take(step) else math.inf), residual

    def _take(self, step: Any) -> bool:
        """Add the step, halved until the ambient can follow."""
        vector = self.system.unknowns.state.vec
        before = np.array(vector.FV().NumPy())
        full = step.FV().NumPy()
        for halving in range(MOST_HALVINGS):
            vector.FV().NumPy()[:] = before + 0.5**halving * full
            if self._follow():
                return True
        vector.FV().NumPy()[:] = before
        return False

    def _follow(self) -> bool:
        start = time.perf_counter()
        moved = self.system.follow()
        self.clock.add("ambient motion", start)
        return moved


def _hopeless(updates: list[float], patience: int) -> bool:
    """Have the last ``patience`` updates brought next to nothing over those before? Never asked of the first two."""
    if len(updates) < patience + 2:
        return False
    return min(updates[-patience:]) > SHRINKING * min(updates[:-patience])
