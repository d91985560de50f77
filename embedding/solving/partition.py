"""The coupled problem in two parts that are solved in turn: the shell without its field, and the field with its shell.

The parts exchange nodal forces. With R the rows of the displacement u in the residual of the joint system, at the
field and the faces that belong to u, and R_shell those of the shell alone in the same state,

    f(u) = R_shell(u) - R(u)

is all the work of the field on du: -dW/du of the field's energy where a face lies at the mid-surface, the work of the
face's traction -tau on d(u +- (T/2) lambda n) where it is opened, and what the field inside the shell does. The shell
alone is in equilibrium under f(u) held fixed exactly where the joint system is. Opened faces follow from their own
rows: those of tau place y, those of y give tau; both have the mass matrix of the shell. Source: theory page, "Coupling
rungs".
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, InnerProduct

from embedding.coupling.physics import Physics
from embedding.coupling.system import System
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import as_bits
from embedding.threads import factored

Array = npt.NDArray[np.float64]


class ShellAlone(System):
    """The shell of a coupled problem without its field, under given nodal ``forces`` (unknowns of u,)."""

    def __init__(self, domain: Domain, physics: Physics) -> None:
        self.forces: Array | None = None
        super().__init__(domain, replace(physics, field=None))

    def residual(self) -> Any:
        """Internal minus external forces, the given ones among them, a new vector."""
        residual = super().residual()
        if self.forces is not None:
            residual.FV().NumPy()[self.unknowns.range("u")] -= self.forces
        return residual


class FieldPart:
    """The field of the ``joint`` system around a shell whose state is that of ``shell``."""

    def __init__(self, joint: System, shell: ShellAlone) -> None:
        if joint.potential is None:
            raise RuntimeError("this scene has no field")
        self.joint, self.shell, self._potential = joint, shell, joint.potential
        unknowns, measure = joint.unknowns, joint.domain.reduction.measure
        trial, test = unknowns.trace.space.TnT()
        mass = BilinearForm(unknowns.trace.space, symmetric=True)
        mass += measure * InnerProduct(trial.Trace(), test.Trace()) * joint.domain.surface()
        mass.Assemble()
        self._mass = mass
        self._inverse = factored(mass.mat, as_bits(unknowns.face_free))

    def follow(self) -> bool:
        """Place the faces and the ambient around the shell; False if elements of the ambient would turn over."""
        joint = self.joint
        self.hand_over(self.shell, joint)
        if joint.unknowns.opened:
            gap = joint.residual()
            for face in joint.unknowns.opened:
                joint.unknowns.field(joint.unknowns.moved_by(face)).vec.data += self._recovered(gap, f"tau_{face}")
        return joint.follow()

    def solve(self) -> None:
        """Solve for the potential on the geometry at hand, and for the tractions of the opened faces.

        Raises:
            LinearSolverError: the potential is determined by nothing.
        """
        self._potential.solve()
        if self.joint.unknowns.opened:
            residual = self.joint.residual()
            for face in self.joint.unknowns.opened:
                rows = self.joint.unknowns.moved_by(face)
                self.joint.unknowns.field(f"tau_{face}").vec.data += self._recovered(residual, rows)

    def forces(self) -> Array:
        """f(u), nodal forces of the solved field on the displacements (unknowns of u,)."""
        joint, shell = self.joint, self.shell
        held, shell.forces = shell.forces, None
        alone, together = shell.residual(), joint.residual()
        shell.forces = held
        forces = _part(alone, shell) - _part(together, joint)
        forces[~joint.unknowns.trace.free] = 0.0
        return forces

    def size(self, forces: Array) -> float:
        """Root of f . M^-1 f: what tractions with these nodal forces are in the mean square over the shell."""
        vector = self._mass.mat.CreateColVector()
        vector.FV().NumPy()[:] = forces
        return float(np.sqrt(max(InnerProduct(vector, (self._inverse * vector).Evaluate()), 0.0)))

    def _recovered(self, residual: Any, rows: str) -> Any:
        part = self._mass.mat.CreateColVector()
        part.FV().NumPy()[:] = residual.FV().NumPy()[self.joint.unknowns.range(rows)]
        return (self._inverse * part).Evaluate()

    @staticmethod
    def hand_over(giver: System, taker: System) -> None:
        """Give the state of the shell from one system to the other."""
        for name in giver.unknowns.names:
            if name in taker.unknowns:
                taker.unknowns.field(name).vec.data = giver.unknowns.field(name).vec
        if giver.unknowns.bending is not None and taker.unknowns.bending is not None:
            taker.restore(taker.save() | {"turned": giver.unknowns.bending.memory})


def _part(vector: Any, system: System) -> Array:
    return np.array(vector.FV().NumPy()[system.unknowns.range("u")])
