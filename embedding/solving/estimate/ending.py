"""Errors where a stage ends at a displacement: those of the load that this takes, and of everything else there.

Sources are measured at the load that was reached. With w the displacement that the stage ends at and t the parameter of
its load, what they make of a scalar Q and of w there, dQ and dw, is dQ - (dQ/dt) / (dw/dt) dw at the displacement: the
load goes back along the path until w is what it was. A voltage or pressure that the load gives has its error from the
second term alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from embedding.coupling.linear import LinearSolverError
from embedding.scene.path import Until
from embedding.solving.newton import Clock
from embedding.solving.path import Target
from embedding.solving.places import displacement_row
from embedding.solving.problem import Problem
from embedding.solving.shell_path import ShellPath

Scalars = dict[str, float]
MOVED = "u_until"
"""The displacement w among the scalars; the names of points that a scene tracks go on with an axis."""
NUDGE = 1e-5
"""Change of the parameter by which slopes are measured."""


@dataclass(frozen=True)
class Ending:
    """The ``parameter`` between the loads ``begin`` and ``end`` at which stage ``number`` has met its ``until``."""

    until: Until
    number: int
    begin: Target
    end: Target
    parameter: float

    def answer(self, scalars: Scalars) -> str:
        """The scalar that tells the load, one that changes along the path; the energy where none does."""
        loads = ["voltage", "voltage_jump"] if self.begin.field != self.end.field else []
        loads += ["pressure_difference"] if self.begin.mechanical != self.end.mechanical else []
        return next((name for name in loads if scalars.get(name)), "elastic_energy")

    def watch(self, problem: Problem) -> Callable[[], Scalars]:
        """A function that tells the displacement w in m at the present state of ``problem``, by its name: the point is
        looked for once."""
        row, u = displacement_row(problem, self.until, self.number), problem.system.unknowns.field("u")
        return lambda: {MOVED: problem.scales.length * float(row @ u.vec.FV().NumPy())}

    def slopes(self, problem: Problem, scalars: Callable[[], Scalars]) -> Scalars | None:
        """dQ/dt of all ``scalars`` along the path at the converged state of ``problem``, w among them; None where the
        tangent is singular, or the load moves on and w does not."""
        path = ShellPath(problem, self.begin, self.end, Clock())
        kept = problem.system.save(), self.parameter
        path.restore(kept)
        try:
            start, response = scalars(), path.linearise().response
            if not path.move(path.values() + NUDGE * response, self.parameter + NUDGE):
                return None
            if problem.system.potential is not None:
                problem.system.potential.solve()
            after = scalars()
        except LinearSolverError:
            return None
        finally:
            path.restore(kept)
            problem.system.follow()
        slopes = {name: (after[name] - value) / NUDGE for name, value in start.items()}
        return slopes if slopes[MOVED] != 0.0 else None


def at_displacement(errors: Mapping[str, float], slopes: Scalars, *, bounds: bool = False) -> Scalars:
    """Errors at the displacement, from those at the load; of ``bounds``, which have no sign, the sum."""
    back = errors.get(MOVED, 0.0) / slopes[MOVED]
    if bounds:
        return {name: abs(errors.get(name, 0.0)) + abs(slope * back) for name, slope in slopes.items()}
    return {name: errors.get(name, 0.0) - slope * back for name, slope in slopes.items()}
