"""Motion of the ambient mesh on one side of the shell: it follows the face, and no element turns over.

The face carries its displacement y into the elements that touch it (the shell's own basis functions); the interior
motion w, piecewise linear, takes up the rest by minimising a hyperelastic energy that is stiff where elements are
small. Any admissible w gives the same physics up to the discretisation error, so one linearised step per Newton step
is enough; what matters is that det F stays positive, and that is measured.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import (
    ET,
    BilinearForm,
    Det,
    Grad,
    GridFunction,
    Id,
    InnerProduct,
    IntegrationRule,
    Variation,
    VectorH1,
    log,
    specialcf,
)

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import TraceSpace, as_bits, plane_mask, scalar_mask

GUARD = 0.02
MOST_SUBSTEPS = 16


class SideMotion:
    """The interior motion ``w`` of one ``side`` ("outside" or "inside") as its face moves by ``y``."""

    def __init__(self, domain: Domain, side: str, face: TraceSpace) -> None:
        self.side = side
        mesh, materials = domain.mesh, domain.materials(side)
        interior = VectorH1(mesh, order=1, definedon=mesh.Materials(materials))
        self._space = face.space * interior
        self._state = GridFunction(self._space)
        self._saved = self._state.vec.CreateVector()
        self.w = self._state.components[1]
        y, w = self._space.TrialFunction()
        F = Id(mesh.dim) + Grad(y) + Grad(w)
        self._form = BilinearForm(self._space, symmetric=True)
        self._form += Variation(_extension_energy(F) * domain.volume(materials)).Compile()
        self._free = as_bits(np.concatenate([np.zeros(face.space.ndof, bool), self._interior_mask(domain, interior)]))
        self._faces = slice(0, face.space.ndof)
        element = ET.TET if mesh.dim == 3 else ET.TRIG
        rule = IntegrationRule(element, 2 * domain.sizes.order)
        self._points = mesh.MapToAllElements(rule, mesh.Materials(materials))
        gf_y, gf_w = self._state.components
        self._jacobian = Det(Id(mesh.dim) + Grad(gf_y) + Grad(gf_w)).Compile()

    @staticmethod
    def _interior_mask(domain: Domain, interior: Any) -> Any:
        scalar = interior.components[0]
        held = scalar_mask(scalar, domain.shell) | scalar_mask(scalar, domain.mesh.Boundaries("outer"))
        on_side = np.asarray([bool(f) for f in interior.FreeDofs()])[: scalar.ndof]
        free = np.tile(on_side & ~held, (domain.mesh.dim, 1))
        for axis in symmetry_components(domain):
            free[axis] &= ~plane_mask(scalar, axis)
        return free.ravel()

    @property
    def min_jacobian(self) -> float:
        """Smallest det F over the sample points of this side (1 for the undeformed mesh)."""
        return float(np.min(self._jacobian(self._points)))

    def save(self) -> None:
        """Remember the present motion, to come back to it by :meth:`restore`."""
        self._saved.data = self._state.vec

    def restore(self) -> None:
        """Go back to the motion of the last :meth:`save`."""
        self._state.vec.data = self._saved

    @property
    def vector(self) -> Any:
        """All unknowns of the motion (face and interior) as one NGSolve vector."""
        return self._state.vec

    def follow(self, face: Any) -> bool:
        """Move the face to the displacement vector ``face``; False (and nothing moved) if elements would turn over."""
        start = np.array(self._state.vec.FV().NumPy())
        change = np.array(face.FV().NumPy()) - start[self._faces]
        substeps = 1
        while substeps <= MOST_SUBSTEPS:
            if all(self._step(change / substeps) for _ in range(substeps)):
                return True
            self._state.vec.FV().NumPy()[:] = start
            substeps *= 4
        return False

    def _step(self, face_change: Any) -> bool:
        vector = self._state.vec
        residual, update = vector.CreateVector(), vector.CreateVector()
        self._form.Apply(vector, residual)
        self._form.AssembleLinearization(vector)
        update[:] = 0.0
        update.FV().NumPy()[self._faces] = face_change
        residual.data += self._form.mat * update
        update.data -= self._form.mat.Inverse(self._free, inverse="sparsecholesky") * residual
        vector.data += update
        values = vector.FV().NumPy()
        return bool(np.all(np.isfinite(values))) and self.min_jacobian > GUARD


def symmetry_components(domain: Domain) -> tuple[int, ...]:
    """Displacement components that vanish where their own coordinate does: mirror planes, and r on the axis."""
    if domain.reduction.name == "axisymmetric":
        return (0,)
    return tuple("xyz".index(axis) for axis in domain.reduction.planes)


def _extension_energy(F: Any) -> Any:
    """Isochoric shape change plus log^2 of the volume change, stiffened by the inverse cube of the element size."""
    dimension = F.dims[0]
    J = Det(F)
    shape = InnerProduct(F, F) * J ** (-2 / dimension) - dimension
    return specialcf.mesh_size ** (-3) * 0.5 * (shape + log(J) ** 2)
