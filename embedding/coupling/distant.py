"""The field in elements that do not touch the shell: the same in the joint system and for the potential alone.

Its co-energy depends on the potential only, as a quadratic function, and on where the interior of the ambient is. The
matrix is assembled when the interior has moved, and serves both systems.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, FESpace, GridFunction, Variation

from embedding.coupling.lagrangian import Lagrangian
from embedding.coupling.room import RoomyForm


class Distant:
    """Co-energy of the field that does not touch the shell, on the ``space`` of the potential (phi, then its jump)."""

    def __init__(self, lagrangian: Lagrangian) -> None:
        unknowns = lagrangian.unknowns
        if unknowns.potential is None or lagrangian.field is None:
            raise RuntimeError("this scene has no potential")
        names = list(unknowns.potential.spaces)
        self.space = FESpace(list(unknowns.potential.spaces.values()))
        self.range = slice(unknowns.range(names[0]).start, unknowns.range(names[-1]).stop)
        self._interiors = [motion.w.vec for motion in lagrangian.field.motions.values()]
        self._assembled_with: npt.NDArray[np.float64] | None = None
        trial = dict(zip(names, self.space.TrialFunction(), strict=True))
        form = BilinearForm(self.space, symmetric=True)
        for term in lagrangian.field.distant_energies(trial):
            form += Variation(term).Compile()
        self._form = self.with_room(form)
        self._at, self._answer = (GridFunction(self.space).vec for _ in range(2))

    def with_room(self, form: BilinearForm) -> RoomyForm:
        """A ``form`` on the space, with the pattern of the whole ambient."""
        return RoomyForm(form, self.space.mesh, zip(*self.space.TnT(), strict=True))

    def matrix(self) -> Any:
        """The matrix of the present interior."""
        present = np.concatenate([np.zeros(0), *(w.FV().NumPy() for w in self._interiors)])
        if self._assembled_with is None or not np.array_equal(present, self._assembled_with):
            self._form.AssembleLinearization(self._at)
            self._assembled_with = present
        return self._form.mat

    def forget(self) -> None:
        """Assemble the matrix anew next time, whether the interior has moved or not."""
        self._assembled_with = None

    def gradient(self, potential: Any) -> Any:
        """The derivative of the co-energy at the ``potential``, a vector of the space that is overwritten next time."""
        self._form.Apply(potential, self._answer)
        return self._answer

    def energy(self, potential: Any) -> float:
        """The co-energy of a ``potential``, a vector of the space."""
        return float(self._form.Energy(potential))
