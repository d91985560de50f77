"""The potential alone on the present, frozen geometry, solved before every joint step; charges, voltages and energy."""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import GridFunction, InnerProduct

from embedding.ambient.inverse import Linear, iterates
from embedding.ambient.patches import Cycle
from embedding.ambient.potential import Conductor
from embedding.coupling.iterative import PotentialSolver
from embedding.coupling.lagrangian import Lagrangian
from embedding.coupling.linear import DirectSolver
from embedding.coupling.potential_form import PotentialForm
from embedding.geometry.spaces import as_bits
from embedding.timing import part

ENOUGH, MOST_STEPS = 1e-13, 40
"""Newton's method for a saturating shell ends when the energy of a step is this part of the field's, or gives up; where
the material is linear one step is all."""
WAY = 8
"""Points on the way from no potential, for the energy of a saturating shell."""


class PotentialSolve:
    """Minimises the field's co-energy, less the charges times their potentials, over phi and jump: definite, and linear
    unless the material saturates.

    ``linear`` says how it is solved; ``iterative`` is that solver, None where the matrix is factored.
    """

    def __init__(self, lagrangian: Lagrangian, form: PotentialForm, linear: Linear = "auto") -> None:
        unknowns, field = lagrangian.unknowns, lagrangian.physics.field
        if unknowns.potential is None or field is None:
            raise RuntimeError("this scene has no potential to solve for")
        self._domain, self._spaces, self._unknowns = lagrangian.domain, unknowns.potential, unknowns
        self._field_factor = lagrangian.factors.field
        self._names = list(self._spaces.spaces)
        self._linear = field.matter.saturation is None
        self._form, space = form, form.space
        self._factored = -1
        self._free = np.concatenate([self._spaces.free[name] for name in self._names])
        # Without a potential around the shell there is nothing to iterate on.
        large = "phi" in self._names and iterates(linear, int(self._free.sum()), lagrangian.domain.mesh.dim)
        self.iterative = PotentialSolver(space, self._free) if large else None
        self._solver = self.iterative or DirectSolver(as_bits(self._free), symmetric=True)
        self._state = GridFunction(space)
        sizes = [component.vec.size for component in self._state.components]
        self._starts = dict(zip(self._names, np.concatenate([[0], np.cumsum(sizes)[:-1]]).tolist(), strict=True))

    @property
    def conductors(self) -> list[Conductor]:
        """What is held at a potential or carries a charge."""
        return self._spaces.conductors

    def prescribe(self, factor: float) -> None:
        """Write the given potentials into the state."""
        self._spaces.prescribe({name: self._unknowns.field(name).vec for name in self._names}, factor)

    def charges_given(self) -> list[tuple[str, int, float]]:
        """(component, unknown, charge at the present load) of every conductor whose charge is given."""
        factor = self._field_factor.Get()
        return [(c.name, c.number, factor * c.charge) for c in self.conductors if c.voltage is None and c.charge]

    def energy(self) -> float:
        """Field co-energy of the present state, dimensionless: every side, the far field, the inside of the shell."""
        return self._energy(self._gather().vec)

    def _energy(self, vector: Any) -> float:
        """NGSolve's energies know only of the mesh's own deformation: on a mesh made around a deformed shell the work
        of the residual along the way from no potential at all is taken, which is exact for a linear material."""
        if self._domain.base is None:
            return self._form.energy(vector)
        part, residual = vector.CreateVector(), vector.CreateVector()
        part[:] = 0.0
        energy = self._form.energy(part)
        for place, weight in zip(*np.polynomial.legendre.leggauss(1 if self._linear else WAY), strict=True):
            part.data = 0.5 * (1 + place) * vector
            self._form.gradient(part, residual)
            energy += 0.5 * weight * float(InnerProduct(residual, vector))
        return energy

    def voltage(self, conductor: Conductor) -> float:
        """The present potential of a conductor (of "jump": of the lifted face over the base)."""
        return float(self._unknowns.field(conductor.name).vec[conductor.number])

    def charge(self, conductor: Conductor) -> float:
        """The charge that answers to the potential of ``conductor``: how the co-energy changes with it. For the shell's
        base that is the charge of both faces."""
        state = self._gather()
        residual = state.vec.CreateVector()
        self._form.gradient(state.vec, residual)
        return float(residual[self._starts[conductor.name] + conductor.number])

    @part("potential")
    def solve(self, enough: float = 0.0) -> None:
        """Solve for the potential and write it into the state; what iterates may leave the part ``enough`` of what the
        present potential is off."""
        if not self._free.any():
            return
        state = self._gather()
        residual = state.vec.CreateVector()
        for _ in range(1 if self._linear else MOST_STEPS):
            self._form.gradient(state.vec, residual)
            for name, number, charge in self.charges_given():
                residual[self._starts[name] + number] -= charge
            self._assemble()
            step = self._solver.solve(residual, enough if self._linear else 0.0)
            state.vec.data -= step
            for name, component in zip(self._names, state.components, strict=True):
                self._unknowns.field(name).vec.data = component.vec
            if not self._linear and self._small(step, residual, state):
                break

    def forget(self) -> None:
        """Let the next solve assemble all of its matrix, as if the ambient had moved."""
        self._form.forget()

    def cycle(self, *, renewed: bool) -> Cycle:
        """The preconditioner of the last solve, or one ``renewed`` for the present state.

        Raises:
            LinearSolverError: the matrix is singular.
        """
        if self.iterative is None:
            raise RuntimeError("this potential is solved directly")
        if renewed or not self.iterative.ready:
            self._assemble()
        return self.iterative.cycle

    def _assemble(self) -> None:
        """Bring the matrix, and what solves with it, up to date."""
        self._form.assemble()
        if self._factored != self._form.version:
            self._solver.factor(self._form)
            self._factored = self._form.version

    def _small(self, step: Any, residual: Any, state: GridFunction) -> bool:
        work = float(np.dot(step.FV().NumPy()[self._free], residual.FV().NumPy()[self._free]))
        return abs(work) <= ENOUGH * abs(self._energy(state.vec))

    def _gather(self) -> GridFunction:
        for name, component in zip(self._names, self._state.components, strict=True):
            component.vec.data = self._unknowns.field(name).vec
        return self._state
