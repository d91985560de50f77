"""The work of the field on the ambient's interior, as forces on the faces that the interior follows."""

from __future__ import annotations

from typing import Any

from ngsolve import BilinearForm, Grad, Variation

from embedding.ambient.extension import Extension
from embedding.ambient.motion import AmbientMotion
from embedding.coupling.field import FieldEnergies, Moved
from embedding.coupling.unknowns import SIDES, Unknowns
from embedding.geometry.domain import Domain


class Following:
    """Adds to a residual what the field does on an interior that follows the faces of an open shell.

    Only the residual knows of it: Newton's matrix keeps the interior still. What it leaves out is a small part of the
    field's stiffness, and the last digits come at a rate of about a hundredth a step.
    """

    def __init__(self, domain: Domain, field: FieldEnergies, unknowns: Unknowns, motion: AmbientMotion) -> None:
        self._unknowns, self._motion, self._extension = unknowns, motion, Extension(domain, motion)
        trial = motion.w.space.TrialFunction()
        values = {name: unknowns.field(name) for name in unknowns.names}
        self._form = BilinearForm(motion.w.space)
        for term in field.moved_energies(values, lambda _: Moved(trial, Grad(trial))):
            self._form += Variation(-1 * term).Compile()
        self._forces = motion.w.vec.CreateVector()

    def add_to(self, residual: Any, scale: float = 1.0) -> None:
        """Add the rows of the faces' motions to a ``residual`` of the joint system; ``scale`` -1 gives forces."""
        self._form.Apply(self._motion.w.vec, self._forces)
        rows = residual.FV().NumPy()
        by_side = self._extension.transposed(self._forces)
        for face in self._unknowns.faces:
            names = ["u", *([self._unknowns.moved_by(face)] if face in self._unknowns.opened else [])]
            for name in names:
                rows[self._unknowns.range(name)] += scale * by_side[SIDES[face]]
