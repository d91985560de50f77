"""Field and shell in turn, or one after the other: what stands in for the joint Newton method of one load step.

:class:`Staggered` repeats: place the faces, let the ambient follow, solve the field, hold its forces and solve the
shell alone. It is a fixed point of the displacement, u = H(u), which an accelerator reaches sooner; where it converges
it has the joint solution. Near it one turn multiplies an error by the derivative of H, the inverse of the shell's
stiffness under held forces times the stiffness of the field: the plain iteration slows down like a geometric series as
that factor grows to 1, where the joint tangent is singular (pull-in), and diverges beyond 1 in size.

:class:`Once` solves the field on the undeformed shape and keeps its forces, dead and per reference area, while the
shell deforms. Source: theory page, "Coupling rungs".
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import Memory, System
from embedding.solving.acceleration import Accelerator, Array, contraction
from embedding.solving.events import Iteration
from embedding.solving.newton import Clock, Newton, Outcome
from embedding.solving.partition import FieldPart, ShellAlone
from embedding.solving.path import Target
from embedding.solving.result import Result

MOST_TURNS = 100
PROGRESS, PATIENCE = 0.9, 12
"""Given up when the best of the last ``PATIENCE`` updates is above ``PROGRESS`` times the best before."""
WATCHED = 12
"""Pairs of input and answer that the contraction factor is measured on."""


class Parts:
    """A coupled ``joint`` system with its shell and its field apart; ``scalars`` tell of the last load step."""

    def __init__(self, joint: System, tolerance: float, max_iterations: int, pressures: Any) -> None:
        self.joint, self.tolerance = joint, tolerance
        self.shell = ShellAlone(joint.domain, joint.physics)
        self.field = FieldPart(joint, self.shell)
        self.clock = Clock()
        self.scalars: dict[str, float] = {}
        self._newton = Newton(self.shell, tolerance, max_iterations, pressures)
        self._pressures = pressures
        self._target = Target(0.0, 0.0, None)

    def load(self, target: Target) -> None:
        """Set the load of both parts."""
        self._target = target
        self.joint.load(target.mechanical, target.field, target.volume, target.pressure)
        self.shell.load(target.mechanical, 0.0, target.volume, target.pressure)

    def memory(self) -> Memory:
        """What the next load step depends on beside the joint system."""
        return {"shell": self.shell.memory()}

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned, at the same load."""
        self.shell.recall(memory["shell"])

    def _shell(self, watch: Callable[[Iteration], None], *, at_rest: bool) -> Outcome:
        start = time.perf_counter()
        outcome = self._newton.solve(watch, at_rest=at_rest)
        self.clock.add("shell", start)
        return outcome

    def _surround(self) -> bool:
        """The field around the present shell; False if elements of the ambient would turn over."""
        start = time.perf_counter()
        if not self.field.follow():
            return False
        start = self.clock.add("ambient motion", start)
        self.field.solve()
        self.clock.add("potential", start)
        return True

    def _displacement(self) -> Array:
        return np.array(self.shell.unknowns.field("u").vec.FV().NumPy())

    def _norm(self, change: Array) -> float:
        vector = self.shell.unknowns.state.vec.CreateVector()
        vector[:] = 0.0
        vector.FV().NumPy()[self.shell.unknowns.range("u")] = change
        return self.shell.displacement_norm(vector)

    def _work(self, forces: Array, change: Array) -> float:
        """Root of the work of ``forces`` on ``change`` per shear modulus and shell volume, like Newton's decrement."""
        return math.sqrt(abs(float(forces @ change)) / self.joint.shell_volume)


class Staggered(Parts):
    """Field and shell solved in turn until neither changes the other, to the ``tolerance`` of the joint method."""

    def __init__(
        self, joint: System, tolerance: float, max_iterations: int, pressures: Any, accelerator: Accelerator
    ) -> None:
        super().__init__(joint, tolerance, max_iterations, pressures)
        self.accelerator = accelerator

    def solve(self, watch: Callable[[Iteration], None], *, at_rest: bool = False) -> Outcome:
        """Take turns from the present state; the state is only good afterwards if the outcome has no reason."""
        self.accelerator.begin()
        FieldPart.hand_over(self.joint, self.shell)
        try:
            return self._turns(watch, at_rest)
        except LinearSolverError:
            return Outcome((), Result.LINEAR_SOLVER_FAILED)

    def _turns(self, watch: Callable[[Iteration], None], at_rest: bool) -> Outcome:
        iterations: list[Iteration] = []
        inputs: list[Array] = []
        answers: list[Array] = []
        held = np.zeros(self.joint.unknowns.trace.space.ndof)
        for number in range(1, MOST_TURNS + 1):
            if not self._surround():
                return Outcome(tuple(iterations), Result.INVERTED_AMBIENT)
            forces = self.field.forces()
            inputs.append(self._displacement())
            self.shell.forces = forces
            alone = self._shell(_unwatched, at_rest=at_rest)
            if alone.reason is not None:
                return Outcome(tuple(iterations), alone.reason)
            answers.append(self._displacement())
            change = answers[-1] - inputs[-1]
            update, residual = self._norm(change), self._work(forces - held, change)
            held = forces
            iterations.append(Iteration(number, update, residual, *self._pressures()))
            watch(iterations[-1])
            if max(update, residual) < self.tolerance:
                factor = contraction(inputs[-WATCHED:], answers[-WATCHED:])
                self.scalars = {"coupling_iterations": float(number), "contraction": factor}
                fits = self._surround()
                return Outcome(tuple(iterations), None if fits else Result.INVERTED_AMBIENT)
            if _hopeless([iteration.update for iteration in iterations]):
                break
            self._move_to(self.accelerator.propose(inputs[-1], answers[-1]))
        # Turns that run away end in large swings: what they do beside the fixed point shows right after the best one.
        after = min(3 + int(np.argmin([iteration.update for iteration in iterations])), len(iterations))
        factor = contraction(inputs[after - 2 : after], answers[after - 2 : after])
        told = f"{len(iterations)} turns, each of which multiplies the worst error by {factor:.3g} unless accelerated"
        return Outcome(tuple(iterations), Result.STAGGERED_DIVERGED, told)

    def _move_to(self, displacement: Array) -> None:
        """Put the shell at a displacement; whatever its supports hold stays as the load has it."""
        free = self.shell.unknowns.trace.free
        self.shell.unknowns.field("u").vec.FV().NumPy()[free] = displacement[free]


class Once(Parts):
    """The field of the undeformed shape acts on the shell as a given load, whatever the shell does.

    The state that is recorded has the field around the deformed shape; ``scalars`` say by what part of themselves its
    forces differ from those that were given, in the mean square over the shell (coupling_gap).
    """

    def __init__(self, joint: System, tolerance: float, max_iterations: int, pressures: Any) -> None:
        super().__init__(joint, tolerance, max_iterations, pressures)
        self._undeformed = joint.save(), self.shell.save()
        self._given: tuple[float, Array] | None = None

    def solve(self, watch: Callable[[Iteration], None], *, at_rest: bool = False) -> Outcome:
        """Solve the shell under the forces of the undeformed shape's field, at the present load."""
        try:
            given = self._forces()
            FieldPart.hand_over(self.joint, self.shell)
            self.shell.forces = given
            outcome = self._shell(watch, at_rest=at_rest)
            if outcome.reason is not None:
                return outcome
            if not self._surround():
                return Outcome(outcome.iterations, Result.INVERTED_AMBIENT)
        except LinearSolverError:
            return Outcome((), Result.LINEAR_SOLVER_FAILED)
        size = self.field.size(given)
        gap = self.field.size(self.field.forces() - given) / size if size > 0.0 else 0.0
        self.scalars = {"coupling_iterations": 1.0, "coupling_gap": gap}
        return outcome

    def memory(self) -> Memory:
        """The given forces as well, and the field's factor they belong to."""
        return super().memory() | {"given": None if self._given is None else list(self._given)}

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned, at the same load."""
        super().recall(memory)
        given = memory["given"]
        self._given = None if given is None else (given[0], given[1])

    def _forces(self) -> Array:
        """Forces of the field at its present strength on the undeformed shape."""
        target = self._target
        if self._given is None or self._given[0] != target.field:
            present = self.joint.save(), self.shell.save()
            for system, state in zip((self.joint, self.shell), self._undeformed, strict=True):
                system.restore(state)
            self.load(Target(0.0, target.field, target.volume, target.pressure))
            if not self._surround():
                raise RuntimeError("the undeformed mesh is inverted")
            self._given = target.field, self.field.forces()
            for system, state in zip((self.joint, self.shell), present, strict=True):
                system.restore(state)
            self.load(target)
        return self._given[1]


def _unwatched(iteration: Iteration) -> None:
    """Newton's iterations of the shell within a turn are not told."""


def _hopeless(updates: list[float]) -> bool:
    """Have the last turns brought next to nothing?"""
    if len(updates) <= PATIENCE:
        return False
    return min(updates[-PATIENCE:]) > PROGRESS * min(updates[:-PATIENCE])
