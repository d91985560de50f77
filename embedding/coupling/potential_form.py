"""The co-energy of the field as a function of the potential alone, at the present places of shell and ambient."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, FESpace, GridFunction, Variation

from embedding.coupling.distant import Distant
from embedding.coupling.lagrangian import Lagrangian
from embedding.threads import shared

MOVING = ("u", "y_t", "y_b", "o_t", "o_b", "axial")
"""Unknowns that the matrix of the potential depends on, besides the ambient's interior."""


class PotentialForm:
    """Energy, gradient and matrix on the ``space`` of the potential (phi, then its jump); what is ``distant`` from the
    shell, if anything, comes from there.

    ``mat`` is the matrix of the last :meth:`assemble`, and ``version`` counts those.
    """

    def __init__(self, lagrangian: Lagrangian, distant: Distant | None) -> None:
        unknowns, field = lagrangian.unknowns, lagrangian.physics.field
        if unknowns.potential is None or field is None:
            raise RuntimeError("this scene has no potential to solve for")
        self._unknowns, self._distant = unknowns, distant
        names = list(unknowns.potential.spaces)
        self.space = FESpace(list(unknowns.potential.spaces.values())) if distant is None else distant.space
        values: dict[str, Any] = {name: unknowns.field(name) for name in unknowns.names}
        values.update(zip(names, self.space.TrialFunction(), strict=True))
        form = BilinearForm(self.space, symmetric=True)
        for term in lagrangian.field_energies(values, "all" if distant is None else "touching"):
            form += Variation(term).Compile()
        self._form = form if distant is None else distant.with_room(form)
        moving = [name for name in MOVING if name in unknowns]
        # the matrix of a saturating material depends on the potential and the strength of the field, too
        self._saturates, self._factor = field.matter.saturation is not None, lagrangian.factors.field
        self._felt = [unknowns.range(name) for name in moving + (names if self._saturates else [])]
        interiors = {} if lagrangian.field is None else lagrangian.field.motions
        self._interiors = [motion.w.vec for motion in interiors.values()]
        self._known: npt.NDArray[np.float64] | None = None
        self._at = GridFunction(self.space)
        self._starts = unknowns.range(names[0]).start
        self.version = 0

    @property
    def mat(self) -> Any:
        """The matrix of the last :meth:`assemble`."""
        return self._form.mat

    def assemble(self) -> None:
        """Assemble the matrix at the present state, if it is not that of the last time."""
        state = self._unknowns.state.vec.FV().NumPy()
        strength = [self._factor.Get()] if self._saturates else []
        parts = [*(state[where] for where in self._felt), *(w.FV().NumPy() for w in self._interiors)]
        present = np.concatenate([strength, *parts])
        if self._known is not None and np.array_equal(present, self._known):
            return
        size = self.space.ndof
        self._at.vec.FV().NumPy()[:] = state[self._starts : self._starts + size]
        with shared():
            self._form.AssembleLinearization(self._at.vec)
        if self._distant is not None:
            self._form.mat.AsVector().data += self._distant.matrix().AsVector()
        self._known = present
        self.version += 1

    def forget(self) -> None:
        """Assemble all of the matrix next time, whatever has moved."""
        self._known = None
        if self._distant is not None:
            self._distant.forget()

    def gradient(self, vector: Any, out: Any) -> None:
        """Write the derivative at a ``vector`` of the space to ``out``."""
        self._form.Apply(vector, out)
        if self._distant is not None:
            out.data += self._distant.gradient(vector)

    def energy(self, vector: Any) -> float:
        """The co-energy at a ``vector`` of the space."""
        return float(self._form.Energy(vector)) + (0.0 if self._distant is None else self._distant.energy(vector))
