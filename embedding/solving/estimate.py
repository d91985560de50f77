"""The error statement of a solve: its last step once more with one polynomial order less, and the model's own error.

The lower order starts from the converged state on the same mesh, so it costs a few cheap Newton steps; the difference
is the error of the LOWER order and bounds that of the answer while the fields are smooth. The model's error is the
membrane theory's, O((T/R)^2), and with closed faces O(T/R); both factors were measured against exact thick spheres.
"""

from __future__ import annotations

from dataclasses import replace

from ngsolve import BND

from embedding.geometry.domain import Domain
from embedding.solving.newton import Newton
from embedding.solving.path import Target
from embedding.solving.problem import Problem, physics_of
from embedding.solving.solution import ErrorEstimate
from embedding.solving.state import State

THEORY = 0.05
CLOSED_FACES = 0.2


def estimate_error(problem: Problem, target: Target) -> ErrorEstimate:
    """Relative error of the mean stretch at the present, converged state."""
    ratio = problem.scene.shell.thickness / problem.scene.shell.shape.size
    curved = problem.domain.mean_curvature != 0.0
    parts = {"shell theory": THEORY * ratio**2 if curved else 0.0}
    if problem.system.physics.field is not None and not problem.plan.opened:
        parts["closed faces"] = CLOSED_FACES * ratio
    discretisation, method = _lower_order(problem, target)
    if discretisation is not None:
        parts["discretisation"] = discretisation
    return ErrorEstimate(sum(parts.values()), "stretch", method, parts)


def _lower_order(problem: Problem, target: Target) -> tuple[float | None, str]:
    order = problem.domain.sizes.order
    if order == 1:
        return None, "thickness only; order 1 has no lower order to compare with, so discretisation is NOT included"
    stretch = State(problem).scalars()["stretch"]
    coarse = LowerOrder(problem)
    if not coarse.solve(target):
        return None, f"thickness only; order {order - 1} did not converge, so discretisation is NOT included"
    difference = abs(State(coarse).scalars()["stretch"] - stretch) / stretch
    return difference, f"thickness, and the change from order {order - 1} to order {order}"


class LowerOrder(Problem):
    """The same problem on the same mesh with fields of one order less, started from the present state."""

    def __init__(self, problem: Problem) -> None:
        self.scene, self.plan, self.scales = problem.scene, problem.plan, problem.scales
        self.reduction = problem.reduction
        sizes = replace(problem.domain.sizes, order=problem.domain.sizes.order - 1)
        self.domain = Domain(problem.mesh, problem.reduction, problem.scene.shell.shape, sizes)
        self.system = type(problem.system)(self.domain, physics_of(self.scene, self.plan, self.scales))
        self._project(problem)

    def _project(self, problem: Problem) -> None:
        fine, coarse = problem.system.unknowns, self.system.unknowns
        for name in coarse.names:
            if name in ("pressure", "axial"):
                coarse.field(name).vec[0] = fine.field(name).vec[0]
            elif name == "u":
                coarse.field(name).Set(fine.field(name), BND, definedon=self.domain.shell)
                coarse.field(name).vec.FV().NumPy()[~coarse.trace.free] = 0.0

    def solve(self, target: Target) -> bool:
        """Converge at ``target``; False if Newton fails."""
        system = self.system
        system.place_faces()
        system.load(target.mechanical, target.field, target.volume, target.pressure)
        solver = self.scene.solver
        newton = Newton(system, max(solver.tolerance, 1e-8), solver.max_iterations, State(self).mean_pressures)
        return newton.solve(lambda iteration: None).reason is None
