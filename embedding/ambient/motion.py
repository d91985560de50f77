"""Motion of the ambient mesh on one side of the shell: it follows the face, and no element turns over.

The face carries its displacement y into the elements that touch it (the shell's own basis functions); the interior
motion w, piecewise quadratic, takes up the rest by lowering a hyperelastic energy that is stiff where elements are
small. Any admissible w gives the same physics up to the discretisation error, so w takes one linearised step whenever
the face has moved noticeably and rests otherwise: with w at rest Newton's method on shell and field is quadratic. What
matters is that det F stays positive, and that is measured after every move.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from ngsolve import (
    ET,
    VOL,
    BilinearForm,
    Det,
    Grad,
    GridFunction,
    Id,
    InnerProduct,
    IntegrationRule,
    Variation,
    VectorH1,
    dx,
    log,
    specialcf,
)

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import as_bits, plane_mask, scalar_mask

INTERIOR_ORDER = 2
VOLUME_PRICE = {2: 0.3, 3: 0.02}
GUARD = 0.02
MOST_SUBSTEPS = 16
MOST_RELAXATIONS = 3
COMFORTABLE = 0.3
NOTICEABLE = 2e-2
OUTDATED = 0.15
SERVES = 0.3
"""Guard on det F. An older matrix of the extension is good enough while det F is above ``COMFORTABLE``, the face has
moved by less than ``OUTDATED`` (shell sizes) since, and a step with it leaves at most the part ``SERVES`` of the
residual. A face that moved less than ``NOTICEABLE`` (mesh sizes) does not disturb the interior."""


class SideMotion:
    """The motion y + w of one ``side`` ("outside" or "inside"): face displacement ``y``, interior motion ``w``."""

    def __init__(self, domain: Domain, side: str, face: Any) -> None:
        mesh, materials = domain.mesh, domain.materials(side)
        interior = VectorH1(mesh, order=INTERIOR_ORDER, definedon=mesh.Materials(materials))
        self.y, self.w = GridFunction(face), GridFunction(interior)
        self._settled = np.zeros(face.ndof)
        self._assembled_at = np.zeros(face.ndof)
        self._inverse: Any = None
        self._noticeable = NOTICEABLE * domain.sizes.shell
        trial = interior.TrialFunction()
        rule = {element: IntegrationRule(element, 2 * INTERIOR_ORDER) for element in (ET.TET, ET.TRIG)}
        self._form = BilinearForm(interior, symmetric=True)
        strain = _extension_energy(Id(mesh.dim) + Grad(self.y) + Grad(trial))
        self._form += Variation(strain * dx(materials, intrules=rule)).Compile()
        self._free = as_bits(_interior_mask(domain, interior))
        self._jacobian = Det(Id(mesh.dim) + Grad(self.y) + Grad(self.w)).Compile()
        self._points = [
            mesh.MapToAllElements(_sampling(mesh.dim, order), mesh.Materials(pattern))
            for pattern, order in _parts(domain, side)
        ]

    @property
    def min_jacobian(self) -> float:
        """Smallest det F over the sample points of this side (1 for the undeformed mesh)."""
        return min(float(np.min(self._jacobian(points))) for points in self._points)

    def vectors(self) -> list[Any]:
        """The vectors that make up the state of the motion: face, interior, and where the face was last settled."""
        return [self.y.vec.FV().NumPy(), self.w.vec.FV().NumPy(), self._settled]

    def follow(self, face: Any) -> bool:
        """Move the face to the displacement vector ``face``; False (and nothing moved) if elements would turn over."""
        saved = [vector.copy() for vector in self.vectors()]
        target = np.array(face.FV().NumPy())
        if np.abs(target - self._settled).max(initial=0.0) <= self._noticeable and self._place(target):
            return True
        substeps = 1
        while substeps <= MOST_SUBSTEPS:
            self._restore(saved)
            if self._walk(saved[0], target, substeps):
                self._settled[:] = target
                return True
            substeps *= 4
        self._restore(saved)
        return False

    def _walk(self, start: Any, target: Any, substeps: int) -> bool:
        """Move the face in equal substeps; from the second on the interior starts from its own last move."""
        interior = self.w.vec.FV().NumPy()
        last_move = np.zeros_like(interior)
        for i in range(1, substeps + 1):
            before = interior.copy()
            interior += last_move
            stop = target if i == substeps else start + i / substeps * (target - start)
            if not self._settle(stop):
                return False
            last_move = interior - before
        return True

    def _restore(self, saved: list[Any]) -> None:
        for vector, values in zip(self.vectors(), saved, strict=True):
            vector[:] = values

    def _place(self, face: Any) -> bool:
        """Move the face alone."""
        self.y.vec.FV().NumPy()[:] = face
        return self.min_jacobian > GUARD

    def _settle(self, face: Any) -> bool:
        """Move the face, then let the interior take one Newton step, with an older matrix if it serves."""
        if not self._place(face):
            return False
        before = self.w.vec.FV().NumPy().copy()
        if self._inverse is not None and np.abs(face - self._assembled_at).max(initial=0.0) < OUTDATED:
            if self._relax() < SERVES and self.min_jacobian > COMFORTABLE:
                return True
            self.w.vec.FV().NumPy()[:] = before
        for _ in range(MOST_RELAXATIONS):
            self._form.AssembleLinearization(self.w.vec)
            self._inverse = self._form.mat.Inverse(self._free, inverse="sparsecholesky")
            self._assembled_at = face.copy()
            self._relax()
            if not np.all(np.isfinite(self.w.vec.FV().NumPy())) or self.min_jacobian > COMFORTABLE:
                break
        return bool(np.all(np.isfinite(self.w.vec.FV().NumPy()))) and self.min_jacobian > GUARD

    def _relax(self) -> float:
        """One step with the matrix at hand; returns by what factor it changed the residual, in that matrix's norm."""
        step, before = self._preconditioned_residual()
        self.w.vec.data -= step
        _, after = self._preconditioned_residual()
        return after / max(before, 1e-300)

    def _preconditioned_residual(self) -> tuple[Any, float]:
        residual, step = self.w.vec.CreateVector(), self.w.vec.CreateVector()
        self._form.Apply(self.w.vec, residual)
        step.data = self._inverse * residual
        return step, math.sqrt(abs(InnerProduct(step, residual)))


def _parts(domain: Domain, side: str) -> list[tuple[str, int]]:
    """Materials of a side with the order of the sampling rule: fine where the motion of the face reaches."""
    near = domain.near(side)
    if near == domain.materials(side):
        return [(near, 2 * domain.sizes.order)]
    return [(near, 2 * domain.sizes.order)] + ([(side, INTERIOR_ORDER)] if side in _used_materials(domain) else [])


def _used_materials(domain: Domain) -> set[str]:
    return {element.mat for element in domain.mesh.Elements(VOL)}


def _sampling(dimension: int, order: int) -> IntegrationRule:
    return IntegrationRule(ET.TET if dimension == 3 else ET.TRIG, order)


def _interior_mask(domain: Domain, interior: Any) -> Any:
    scalar = interior.components[0]
    held = scalar_mask(scalar, domain.shell) | scalar_mask(scalar, domain.mesh.Boundaries("outer"))
    on_side = np.fromiter((bool(f) for f in scalar.FreeDofs()), bool, scalar.ndof)
    free = np.tile(on_side & ~held, (domain.mesh.dim, 1))
    for axis in symmetry_components(domain):
        free[axis] &= ~plane_mask(scalar, axis)
    return free.ravel()


def symmetry_components(domain: Domain) -> tuple[int, ...]:
    """Displacement components that vanish where their own coordinate does: mirror planes, and r on the axis."""
    if domain.reduction.name == "axisymmetric":
        return (0,)
    return tuple("xyz".index(axis) for axis in domain.reduction.planes)


def _extension_energy(F: Any) -> Any:
    """Isochoric shape change plus a polyconvex price on the volume change, stiffer the smaller the element (h^-3).

    log(J)^2 in place of (J^2 - 1) / 2 - log(J) would lose convexity where elements expand beyond J = e. Volume is
    cheap: elements at an inflating face shall grow with it in all directions, not be flattened (prices by measurement).
    """
    dimension = F.dims[0]
    J = Det(F)
    shape = InnerProduct(F, F) * J ** (-2 / dimension) - dimension
    return specialcf.mesh_size ** (-3) * 0.5 * (shape + VOLUME_PRICE[dimension] * (J**2 - 1 - 2 * log(J)))
