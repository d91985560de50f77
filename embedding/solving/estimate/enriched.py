"""What one more polynomial order changes in the converged state, and which part of the discretisation it comes from.

The state is carried to the next order, on the same elements with their geometry refined as well, and Newton's method
goes on from there: a solution of the richer problem without a second path. Its first step splits by rows. The residual
of the shell's equations with the ambient's potential as it was gives the part of the shell; that of the geometry is
what the same residual changes by when the elements are curved to the next order; what is left of the whole change comes
from the ambient.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import BND

from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import System
from embedding.coupling.unknowns import assembled_in_batches
from embedding.geometry.domain import Domain
from embedding.geometry.ends import unknowns_on
from embedding.shell.bending import CurveBending, SurfaceBending
from embedding.solving.estimate.ending import Ending
from embedding.solving.path import Target
from embedding.solving.problem import Problem, physics_of
from embedding.solving.state import State

Scalars = dict[str, float]
NEWTON_STEPS, NEAR, SETTLED, LEAST, GROWING = 15, 0.01, 0.02, 1e-12, 30.0
"""Most steps on the next order. After one shorter than ``NEAR`` (shell sizes) a membrane's tangent serves for the
others as well; they end with one shorter than ``SETTLED`` times all of the way so far, or than ``LEAST``. One longer
than ``GROWING`` times that before gives them up."""
LEAST_PART = 0.2
"""Smallest part of the first residual, of a shell that bends, that is taken away at once."""

ROUNDS = 4
"""Steps of the power method."""
NUDGED = 1.0 + 1e-5
"""Factor of the loads by which responses are measured."""


@dataclass(frozen=True)
class Changes:
    """What each scalar changes by with one more order, by source; ``whole`` is the sum."""

    shell: Scalars
    geometry: Scalars
    ambient: Scalars
    whole: Scalars


class Enriched(Problem):
    """The same problem with the fields of ``domain``, of one order more on the same elements, started from the present
    state. ``loads`` is the norm of all nodal loads, dimensionless, once responses are known."""

    def __init__(self, problem: Problem, domain: Domain, ending: Ending | None = None) -> None:
        self.scene, self.plan, self.scales = problem.scene, problem.plan, problem.scales
        self.reduction = problem.reduction
        self.domain = domain
        physics = physics_of(self.scene, self.plan, self.scales, self.domain)
        self.system = System(self.domain, physics, self.scene.solver.linear)
        for name in self.system.unknowns.names:
            self._carry(name, problem)
        counted, present = self.system.unknowns.bending, problem.system.unknowns.bending
        match counted, present:
            case CurveBending(), CurveBending():
                counted.continue_from(present)
            case SurfaceBending(), SurfaceBending():
                counted.continue_from(present)
        self.system.ambient_as_in(problem.system)
        self.system.restore(self.system.save())  # the state did not get here by Newton steps
        self.state, self._ending = State(self), ending
        self._moved_to: Callable[[], Scalars] = dict if ending is None else ending.watch(self)
        self.state.to_edges = True  # what the state at hand has missed there is part of its error
        self.loads = 0.0

    def scalars(self) -> Scalars:
        """Those of the present state, with the displacement at which the last stage has ended, if it did at one."""
        return self.state.scalars() | self._moved_to()

    def slopes(self) -> Scalars | None:
        """What the scalars change by along the path at its end, see :meth:`Ending.slopes`."""
        return None if self._ending is None else self._ending.slopes(self, self.scalars)

    def _carry(self, name: str, problem: Problem) -> None:
        richer, present = self.system.unknowns.field(name), problem.system.unknowns.field(name)
        if richer.space.ndof == 1:
            richer.vec[0] = present.vec[0]
        elif name in ("u", "y_t", "y_b", "o_t", "o_b", "tau_t", "tau_b"):
            richer.Set(present, BND, definedon=self.domain.shell)
            unknowns = self.system.unknowns
            richer.vec.FV().NumPy()[~(unknowns.trace.free if name == "u" else unknowns.face_free)] = 0.0
        elif name == "phi":
            richer.Set(present)
        elif name in ("moment", "jump"):
            richer.Set(present, BND, definedon=self.domain.shell)
        elif name == "rotation":
            facets = np.flatnonzero(self.domain.facets.neighbours > 0)
            for facet in facets:  # the polynomials on an edge are hierarchical
                old, new = (unknowns_on(field.space, np.array([facet])) for field in (present, richer))
                richer.vec.FV().NumPy()[new[: len(old)]] = present.vec.FV().NumPy()[old]

    def improve(
        self, target: Target, before: Scalars, straight: Callable[[Callable[[], None]], None]
    ) -> Changes | None:
        """Solve at ``target``, and compare with the scalars ``before``; None if Newton's method does not get there.

        ``straight`` calls a function while the elements are curved to the order of the present solution only.
        """
        system = self.system
        system.load(target.mechanical, target.field, target.volume, target.pressure)
        try:
            if not system.follow():
                return None
            parts = {} if self.held else self._split(straight)
            after = self._converged()
        except LinearSolverError:
            return None
        if after is None:
            return None
        whole = {name: after[name] - before[name] for name in before}
        shell, geometry = (parts.get(source, dict.fromkeys(before, 0.0)) for source in ("shell", "geometry"))
        ambient = {name: whole[name] - shell[name] - geometry[name] for name in before}
        if system.potential is None:  # nothing else is left than what the linear split misses
            shell, ambient = {name: whole[name] - geometry[name] for name in before}, dict.fromkeys(before, 0.0)
        return Changes(shell, geometry, ambient, whole)

    def _split(self, straight: Callable[[Callable[[], None]], None]) -> dict[str, Scalars]:
        """What the shell's own residual changes, and that of its geometry; the state is left as it is."""
        system, carried = self.system, self.system.save()
        batched = assembled_in_batches(self.domain, system.physics)  # those keep the geometry they were made with
        curved = not self.domain.is_flat and not batched
        at_once: list[Any] = []

        def before() -> None:
            at_once.append(self._rows())
            self._solve_potential()
            at_once.extend((self._rows(), self.scalars()))

        if curved:
            self._forget_potential()
            straight(before)
            self._forget_potential()
        own = at_once[0] if curved else self._rows()
        self._solve_potential()
        start, solved = self.scalars(), system.save()
        system.linearise()
        parts = {"shell": self._moved(own, start, solved)}
        if curved:
            _, straightly, seen = at_once
            moved = self._moved(self._rows() - straightly, start, solved)
            parts["geometry"] = {name: change + start[name] - seen[name] for name, change in moved.items()}
        self._put(carried)
        return parts

    def _moved(self, rows: Any, start: Scalars, state: Any) -> Scalars:
        """How the scalars change from ``start``, those of ``state``, by the tangent's step against a residual."""
        load = self.system.unknowns.state.vec.CreateVector()
        load.FV().NumPy()[:] = rows
        step = self.system.solve(load)
        self.system.unknowns.state.vec.data -= step
        moved = self.scalars() if self.system.follow() else start
        self._put(state)
        return {name: moved[name] - start[name] for name in start}

    def _forget_potential(self) -> None:
        """Elements have other shapes from now on, also those that did not move."""
        if self.system.potential is not None:
            self.system.potential.forget()

    def _solve_potential(self) -> None:
        if self.system.potential is not None:
            self.system.potential.solve()

    def _rows(self) -> Any:
        """The residual of the shell's equations."""
        residual = np.array(self.system.residual().FV().NumPy())
        for name in ("phi", "jump"):
            if name in self.system.unknowns:
                residual[self.system.unknowns.range(name)] = 0.0
        return residual

    def _put(self, saved: Any) -> None:
        self.system.restore(saved)
        self.system.follow()

    def _converged(self) -> Scalars | None:
        """The scalars after Newton's method, where it gets there. Around a shell that is held, with its faces on the
        mid-surface, the potential is all that changes.

        A thin shell that bends is stiff against what new curves of its elements stretch: where the method does not get
        there at once, the residual it starts with is taken away in parts.
        """
        if self.held and not self.plan.opened:
            self._solve_potential()
            return self.scalars()
        self._solve_potential()
        first, gone, part = self.system.residual(), 0.0, 1.0
        while gone < 1.0:
            reached = self.system.save()
            if self._newton(first, 1.0 - min(1.0, gone + part)):
                gone, part = gone + part, 2.0 * part
            elif not self.plan.bending or part < LEAST_PART:
                return None
            else:
                self._put(reached)
                part *= 0.25
        self._solve_potential()
        return self.scalars()

    def _newton(self, first: Any, left: float) -> bool:
        """Solve for a residual of ``left`` times the ``first``; False if Newton's method does not settle."""
        system, size, way = self.system, math.inf, 0.0
        for _ in range(NEWTON_STEPS):
            self._solve_potential()
            residual = system.residual()
            residual.data -= left * first
            if self.plan.bending or not size < NEAR:
                system.linearise()
            step = system.solve(residual)
            last, size = size, system.displacement_norm(step)
            system.unknowns.state.vec.data -= step
            way += size
            if not math.isfinite(size) or size > GROWING * last or not system.follow():
                return False
            if size <= SETTLED * way and way > size or size < LEAST:
                return True
        return False

    def responses(self, target: Target) -> dict[str, Scalars] | None:
        """d (scalar) / d ln (load) at the state of :meth:`improve`: of "all" loads together and of the "field" alone,
        whose own voltages and applied fields count as they are. None where the tangent is singular, as at a limit
        point."""
        kept = self.system.save()
        try:
            return self._responses(target)
        except LinearSolverError:
            self._load(target.mechanical, target.field)
            self._put(kept)
            return None

    def _responses(self, target: Target) -> dict[str, Scalars]:
        system, kept = self.system, self.system.save()
        start, found = self.scalars(), dict[str, Scalars]()
        present = self._forces(target, 1.0, 1.0)
        for name, factors in {"all": (NUDGED, NUDGED), "field": (1.0, NUDGED)}.items():
            if name == "field" and system.physics.field is None:
                continue
            load = self._forces(target, *factors)
            load.data -= present
            if name == "all":
                self.loads = float(np.linalg.norm(load.FV().NumPy()[self.system.free])) / (NUDGED - 1.0)
            step = system.solve(load)
            system.unknowns.state.vec.data -= step
            if not system.follow():
                self._put(kept)
                continue
            self._solve_potential()
            moved = self.scalars()
            found[name] = {one: (moved[one] - start[one]) / (NUDGED - 1.0) for one in start}
            for face, pressure in zip(("top", "bottom"), self.state.field_pressures(), strict=True):
                # multipliers of opened faces are the pulls at the nudged load
                found[name][f"pressure_{face}"] -= pressure if face[0] in self.plan.opened else 0.0
            self._put(kept)
        return found

    def condition(self) -> float:
        """Largest over smallest eigenvalue of the tangent at hand, by a few steps of the power method from either end;
        infinite for a singular one."""
        try:
            return self._condition()
        except LinearSolverError:
            return math.inf

    def _condition(self) -> float:
        system, sizes = self.system, []
        start = np.cos(np.arange(1.0, system.unknowns.space.ndof + 1))  # of no pattern, and no generator to import
        for apply in (system.solve, self._times):
            vector = system.unknowns.state.vec.CreateVector()
            vector.FV().NumPy()[:] = start
            for _ in range(ROUNDS):
                vector.data = (1.0 / float(np.linalg.norm(vector.FV().NumPy()))) * vector
                vector = apply(vector)
            sizes.append(float(np.linalg.norm(vector.FV().NumPy())))
        return math.prod(sizes)

    def _times(self, vector: Any) -> Any:
        """The assembled tangent times a vector, on its free unknowns."""
        product = vector.CreateVector()
        product.data = self.system.form.mat * vector
        product.FV().NumPy()[~self.system.free] = 0.0
        return product

    def _forces(self, target: Target, mechanical: float, field: float) -> Any:
        """Residual at the loads times these factors; field forces go with the square of the field."""
        kept = self.system.save()
        self._load(mechanical * target.mechanical, math.sqrt(field) * target.field)
        residual = self.system.residual()
        self._put(kept)
        self._load(target.mechanical, target.field)
        return residual

    def _load(self, mechanical: float, field: float) -> None:
        """Set the factors; what is held at a displacement stays there."""
        self.system.factors.mechanical.Set(mechanical)
        self.system.factors.field.Set(field)
        if self.system.potential is not None:
            self.system.potential.prescribe(field)
        self._solve_potential()
