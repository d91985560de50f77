"""The error statement of a solve: what one more polynomial order would change, and the model's own error.

The converged state is carried to the next order, on the same elements with their geometry refined as well, and one or
two Newton steps are taken there: their effect on the wanted quantity estimates the discretisation error without a
second solve. The model's error is the membrane theory's, O((T/R)^2), and with closed faces O(T/R); both factors were
measured against exact thick spheres.
"""

from __future__ import annotations

from dataclasses import replace

from ngsolve import BND

from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import System
from embedding.geometry.domain import Domain
from embedding.solving.path import Target
from embedding.solving.problem import Problem, physics_of
from embedding.solving.solution import ErrorEstimate
from embedding.solving.state import State

THEORY = 0.05
CLOSED_FACES = 0.2
NEWTON_STEPS = 2


def estimate_error(problem: Problem, target: Target) -> ErrorEstimate:
    """Relative error of the answer at the present, converged state.

    The answer is the mean stretch, or the pressure difference where the path controls the volume.
    """
    quantity = "stretch" if target.volume is None else "pressure_difference"
    ratio = problem.scene.shell.thickness / problem.scene.shell.shape.size
    parts = {"shell theory": THEORY * ratio**2 if problem.domain.mean_curvature != 0.0 else 0.0}
    if problem.system.physics.field is not None and not problem.plan.opened:
        parts["closed faces"] = CLOSED_FACES * ratio
    order = problem.domain.sizes.order
    change = _enriched_change(problem, target, quantity)
    if change is None:
        return ErrorEstimate(sum(parts.values()), quantity, "thickness only; discretisation is NOT included", parts)
    parts["discretisation"] = change
    method = f"thickness, and the change from order {order} to order {order + 1}"
    return ErrorEstimate(sum(parts.values()), quantity, method, parts)


def _enriched_change(problem: Problem, target: Target, quantity: str) -> float | None:
    before = State(problem).scalars()[quantity]
    order = problem.domain.sizes.order
    try:
        problem.mesh.Curve(order + 1)
        richer = Enriched(problem)
        after = State(richer).scalars()[quantity] if richer.improve(target) else None
    finally:
        problem.mesh.Curve(order)
    return None if after is None else abs(after - before) / max(abs(before), 1e-300)


class Enriched(Problem):
    """The same problem with fields of one order more on the same elements, started from the present state."""

    def __init__(self, problem: Problem) -> None:
        self.scene, self.plan, self.scales = problem.scene, problem.plan, problem.scales
        self.reduction = problem.reduction
        sizes = replace(problem.domain.sizes, order=problem.domain.sizes.order + 1)
        self.domain = Domain(problem.mesh, problem.reduction, problem.scene.shell.shape, sizes)
        self.system = System(self.domain, physics_of(self.scene, self.plan, self.scales))
        for name in self.system.unknowns.names:
            self._carry(name, problem)

    def _carry(self, name: str, problem: Problem) -> None:
        richer, present = self.system.unknowns.field(name), problem.system.unknowns.field(name)
        if name in ("pressure", "axial"):
            richer.vec[0] = present.vec[0]
        elif name in ("u", "y_t", "y_b", "tau_t", "tau_b"):
            richer.Set(present, BND, definedon=self.domain.shell)
            richer.vec.FV().NumPy()[~self.system.unknowns.trace.free] = 0.0

    def improve(self, target: Target) -> bool:
        """Take Newton steps at ``target``; False if they cannot be taken."""
        system = self.system
        system.load(target.mechanical, target.field, target.volume, target.pressure)
        try:
            for _ in range(NEWTON_STEPS):
                if not system.follow():
                    return False
                if system.potential is not None:
                    system.potential.solve()
                step, _ = system.newton_update()
                system.unknowns.state.vec.data += step
        except LinearSolverError:
            return False
        return system.follow()
