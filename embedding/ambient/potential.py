"""The scalar potential on both sides of the shell, with its jump as an explicit unknown where the scene has one.

``phi`` is continuous everywhere. On one side, the ``lifted`` one, the potential is phi + jump, where the jump lives on
the shell and reaches only into the elements that touch it. Where both faces are held at one potential there is no
jump to solve for. Prescribed values:

==========================  =================  =============================
electrodes                  phi on the shell   jump
==========================  =================  =============================
none                        free               free, lifts the outside
bottom only                 V_b                free, lifts the outside
top only                    V_t                free, lifts the inside
both, equal                 V                  absent
both, different             V_b                V_t - V_b, lifts the outside
==========================  =================  =============================
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import BND, CF, H1, GridFunction, InnerProduct

from embedding.geometry.domain import Domain
from embedding.geometry.spaces import Mask, TraceSpace, plane_mask, scalar_mask


@dataclass(frozen=True)
class Electrodes:
    """Dimensionless voltages of the faces at full load; None where a face carries no electrode."""

    top: float | None
    bottom: float | None

    @property
    def jump_exists(self) -> bool:
        """Does the potential jump across the shell?"""
        return self.top is None or self.bottom is None or self.top != self.bottom

    @property
    def lifted(self) -> str:
        """The side whose potential is phi + jump."""
        return "inside" if self.top is not None and self.bottom is None else "outside"

    @property
    def base(self) -> float | None:
        """Prescribed phi on the shell, if any."""
        return self.bottom if self.bottom is not None else self.top

    @property
    def jump(self) -> float | None:
        """Prescribed jump, if both faces are electrodes."""
        return None if self.top is None or self.bottom is None else self.top - self.bottom


class PotentialSpaces:
    """Spaces of the potential and its jump, which unknowns are free, and how prescribed values enter a vector."""

    def __init__(
        self,
        domain: Domain,
        electrodes: Electrodes,
        grounded: bool,
        applied: tuple[float, ...],
        odd_planes: tuple[str, ...],
    ) -> None:
        order = domain.sizes.potential_order
        self.electrodes = electrodes
        self.phi = H1(domain.mesh, order=order)
        self.jump = (
            TraceSpace(domain.mesh, order, vector=False, reach=domain.materials(electrodes.lifted))
            if electrodes.jump_exists
            else None
        )
        self.on_shell: Mask = scalar_mask(self.phi, domain.shell)
        self.on_outer: Mask = scalar_mask(self.phi, domain.mesh.Boundaries("outer"))
        odd = np.zeros(self.phi.ndof, bool)
        for axis in odd_planes:
            odd |= plane_mask(self.phi, "xyz".index(axis))
        held = odd | (self.on_shell & (electrodes.base is not None)) | (self.on_outer & grounded)
        self.free_phi: Mask = ~held
        if self.jump is not None:
            self.jump.fix(0, odd | np.full(odd.shape, electrodes.jump is not None))
        self._vertices = np.arange(self.phi.ndof) < domain.mesh.nv
        self._on_outer_values = self._uniform(domain, applied) if grounded and any(applied) else None

    def _uniform(self, domain: Domain, applied: tuple[float, ...]) -> Any:
        """Potential of the applied field on the outer boundary of a box that is held at it."""
        field = GridFunction(self.phi)
        field.Set(
            -InnerProduct(CF(applied), domain.reduction.position),
            BND,
            definedon=domain.mesh.Boundaries("outer"),
        )
        return np.array(field.vec.FV().NumPy())[self.on_outer]

    @property
    def spaces(self) -> list[Any]:
        """The spaces in the order phi, jump."""
        return [self.phi] + ([self.jump.space] if self.jump is not None else [])

    @property
    def free(self) -> Mask:
        """Free unknowns of phi and jump together."""
        return np.concatenate([self.free_phi] + ([self.jump.free] if self.jump is not None else []))

    def prescribe(self, phi: Any, jump: Any | None, factor: float) -> None:
        """Write the electrodes' potentials, scaled by ``factor``, into the vectors of phi and of the jump."""
        if self.electrodes.base is not None:
            values = phi.FV().NumPy()
            values[self.on_shell] = 0.0
            values[self.on_shell & self._vertices] = factor * self.electrodes.base
        if self._on_outer_values is not None:
            phi.FV().NumPy()[self.on_outer] = factor * self._on_outer_values
        if jump is not None and self.jump is not None and self.electrodes.jump is not None:
            jump.FV().NumPy()[:] = np.where(self.jump.vertex_unknowns(), factor * self.electrodes.jump, 0.0)

    def constant_on_shell(self) -> Mask:
        """Unknowns of phi whose sum of residuals is minus the total charge on the shell."""
        mask: Mask = self.on_shell & self._vertices
        return mask
