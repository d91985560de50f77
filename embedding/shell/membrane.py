"""The membrane energy of a shell that also bends: without locking, and with a tangent that survives large turns.

*Locking.* A thin shell bends where it can without stretching, and polynomials of the displacement cannot do that
exactly: what is left of the strain is multiplied by a stiffness 1/T^2 larger than that of bending. On triangles the
strain is therefore interpolated to the tangentially continuous symmetric tensors of one order less (Regge elements),
of which there are no more than unknowns; on curves it is seen at the k Gauss points of elements of order k alone, which
is the same as its projection to polynomials of order k - 1. Source: M. Neunteufel, J. Schoeberl, Comput. Methods Appl.
Mech. Eng. 373 (2021) 113524.

*Turns.* An update d of the displacement changes the strain by a linear part and by Grad d^T Grad d / 2. A shell that
turns is stretched by the second in Newton's imagination only, but its stress, of the size of the membrane stiffness,
spoils the next tangent. The stress in the tangent is extrapolated from the last state instead: minus
D : (Grad d^T Grad d) / 2 is added. The residual is what it was, and so is the solution. It is Newton's method with
stresses as unknowns of their own: D. Magisano, L. Leonetti, G. Garcea, Comput. Methods Appl. Mech. Eng. 313 (2017) 986.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import ET, GridFunction, HCurlCurl, InnerProduct, IntegrationRule, Interpolate, Trace, ds

from embedding.geometry.domain import Domain
from embedding.shell.kinematics import Kinematics, surface_gradient
from embedding.shell.laws import IncompressibleLaw, KoiterLaw, Law

Array = npt.NDArray[np.float64]


class InterpolatedStrain:
    """What laws ask of kinematics, from a strain tensor E = (C_s - P) / 2 (3 x 3, tangential) that stands for it."""

    dimension = 3
    hoop = 1.0

    def __init__(self, projector: Any, strain: Any) -> None:
        self.projector, self.strain = projector, strain

    @cached_property
    def metric_trace(self) -> Any:
        """I_C = 2 + 2 tr E."""
        return 2 + 2 * Trace(self.strain)

    @cached_property
    def surface_stretch_squared(self) -> Any:
        """J_s^2 = det C_s, on the tangent plane."""
        trace = Trace(self.strain)
        return 1 + 2 * trace + 2 * (trace * trace - InnerProduct(self.strain, self.strain))


class Membrane:
    """Membrane energy of a shell with bending on ``domain``; ``cured`` says whether locking is.

    ``update`` is a grid function that holds the last update of the displacement while the tangent is assembled; see
    :meth:`extrapolating`.
    """

    def __init__(self, domain: Domain, law: Law, thickness: Any, update: GridFunction, *, cured: bool) -> None:
        self.domain, self.law, self.thickness, self.update = domain, law, thickness, update
        order, curve = domain.sizes.order, domain.mesh.dim == 2
        element = ET.SEGM if curve else ET.TRIG
        self.integral = ds("shell", intrules={element: IntegrationRule(element, 2 * order - (curve and cured))})
        self._regge = None
        self._grown: Any = None
        if cured and not curve:
            self._regge = HCurlCurl(domain.mesh, order=order - 1, discontinuous=True, definedon=domain.shell)

    def energy(self, kinematics: Kinematics, state: Kinematics) -> Any:
        """T Psi per reference area, with the extrapolated stress; ``state`` are the kinematics of the present state."""
        if self._regge is not None:
            seen: Any = InterpolatedStrain(kinematics.projector, Interpolate(kinematics.strain, self._regge))
        else:
            seen = kinematics
        return self.thickness * (self.law.energy(seen) + self._extrapolated(seen, state))

    def _extrapolated(self, seen: Any, state: Kinematics) -> Any:
        """The energy linear in the strain whose stress is -D : (Grad d^T Grad d) / 2."""
        if isinstance(self.law, KoiterLaw):
            youngs, poisson = self.law.youngs, self.law.poisson
        else:
            youngs, poisson = 3 * self._modulus(state), 0.5
        slope = surface_gradient(self.update)
        grown = slope.trans * slope
        if self._regge is not None:
            grown = self._grown = self._grown or GridFunction(self._regge)
        strain, trace = seen.strain, Trace(seen.strain)
        work = (1 - poisson) * InnerProduct(grown, strain) + poisson * Trace(grown) * trace
        if self.domain.mesh.dim == 2:
            around, hoop = self.domain.reduction.hoop_change(self.update) ** 2, (seen.hoop**2 - 1) / 2
            work = work + around * hoop + poisson * (around * trace + Trace(grown) * hoop)
        return -0.5 * youngs / (1 - poisson**2) * work

    def _modulus(self, state: Kinematics) -> Any:
        if not isinstance(self.law, IncompressibleLaw):
            raise TypeError(f"no bending of {type(self.law).__name__}")
        return self.law.bending_modulus(state)

    @contextmanager
    def extrapolating(self, update: Array) -> Iterator[None]:
        """Assemble a tangent with the stress extrapolated over the last ``update`` of the displacement's unknowns."""
        self._remember(update)
        try:
            yield
        finally:
            self._remember(np.zeros_like(update))

    def _remember(self, update: Array) -> None:
        self.update.vec.FV().NumPy()[:] = update
        if self._grown is not None:
            slope = surface_gradient(self.update)
            self._grown.Set(slope.trans * slope, dual=True, definedon=self.domain.shell)
