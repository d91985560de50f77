"""How the interior of the ambient would follow its faces: the virtual motion behind the forces of an open shell.

The force of the field on the shell is the derivative of its co-energy when the ambient follows. Any smooth motion of
the interior gives the same force, up to the discretisation error; but at a rim, where the field is singular, that error
is a fixed part of the force if the interior stands still, a per cent at order 4, whatever the mesh. With an interior
that follows over many layers of elements the error of the force is that of the co-energy itself. The interior follows
the linearised extension of the undeformed mesh, the same at any deformation: w = - K_ww^{-1} K_wy y.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, FESpace, Grad, GridFunction, Id, Variation

from embedding.ambient.inverse import Inverter
from embedding.ambient.motion import AmbientMotion, extension_energy
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import as_bits, as_mask

Array = npt.NDArray[np.float64]


class Extension:
    """The linear extension of face displacements ``y`` into the interior of ``motion``'s ambient, and its transpose."""

    def __init__(self, domain: Domain, motion: AmbientMotion) -> None:
        interior, faces = motion.w.space, {side: y.space for side, y in motion.y.items()}
        space = FESpace([interior, *faces.values()])
        w, *displacements = space.TrialFunction()
        form = BilinearForm(space, symmetric=True)
        for side, y in zip(faces, displacements, strict=True):
            strain = extension_energy(Id(domain.mesh.dim) + Grad(w) + Grad(y))
            form += Variation(strain * domain.volume(domain.near(side), motion.rule)).Compile()
        for far in filter(None, map(domain.far, faces)):
            strain = extension_energy(Id(domain.mesh.dim) + Grad(w))
            form += Variation(strain * domain.volume(far, motion.rule)).Compile()
        form.AssembleLinearization(GridFunction(space).vec)
        self._matrix = form.mat
        free = np.zeros(space.ndof, bool)
        free[: interior.ndof] = as_mask(motion.free)
        self._inverse = Inverter(space, as_bits(free), motion.linear)(form.mat)
        self._starts = np.cumsum([0, interior.ndof, *(face.ndof for face in faces.values())]).tolist()
        self._sides = tuple(faces)
        self._vector = self._matrix.CreateColVector()

    def transposed(self, forces: Any) -> Mapping[str, Array]:
        """Forces on the faces, unknowns by side, that do the work of ``forces`` on the interior as it follows them."""
        self._vector[:] = 0.0
        self._vector.FV().NumPy()[: self._starts[1]] = forces.FV().NumPy()
        answer = self._matrix.CreateColVector()
        answer.data = self._inverse * self._vector
        self._vector.data = -1 * self._matrix * answer
        rows = self._vector.FV().NumPy()
        return {
            side: np.array(rows[start:stop])
            for side, start, stop in zip(self._sides, self._starts[1:], self._starts[2:], strict=False)
        }
