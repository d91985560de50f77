"""The membrane energy of a shell that also bends: without locking, and with a tangent that survives large turns.

*Locking.* A thin shell bends where it can without stretching, and polynomials of the displacement cannot do that
exactly: what is left of the strain is multiplied by a stiffness 1/T^2 larger than that of bending. On triangles the
strain is therefore interpolated to the tangentially continuous symmetric tensors of one order less (Regge elements),
of which there are no more than unknowns; on curves it is seen at the k Gauss points of elements of order k alone, which
is the same as its projection to polynomials of order k - 1. Source: M. Neunteufel, J. Schoeberl, Comput. Methods Appl.
Mech. Eng. 373 (2021) 113524.

*Turns.* An update d of the displacement changes the strain by a linear part and by Grad d^T Grad d / 2. A shell that
turns is stretched by the second in Newton's imagination only, but its stress, of the size of the membrane stiffness,
spoils the next tangent. So the tangent has the strain and the stress that the linearised equations have led to: after
an iteration from the strain E_k with the stiffness D_k,

    e = E - Grad d^T Grad d / 2,    S = S(E_k) + D_k : (e - E_k),

which is in balance to the last digit, as S(e) is not where the law is nonlinear. Where a state is guessed along a
curve there are no such equations, and both are those of the state before. The residual is what it was, and so is the
solution. It is Newton's method with stresses as unknowns of their own: D. Magisano, L. Leonetti, G. Garcea, Comput.
Methods Appl. Mech. Eng. 313 (2017) 986. On surfaces that are not assembled in batches S is S(e).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import (
    CF,
    ET,
    GridFunction,
    HCurlCurl,
    IfPos,
    InnerProduct,
    IntegrationRule,
    Interpolate,
    Parameter,
    Trace,
    ds,
    sqrt,
)

from embedding.geometry.domain import Domain
from embedding.geometry.points import PointFields
from embedding.shell.kinematics import Kinematics, surface_gradient
from embedding.shell.laws import Law

Array = npt.NDArray[np.float64]
LEAST = 0.1
"""Where less of the squared stretches would be left after an extrapolation, there is none."""


class Strained:
    """What laws ask of kinematics, from a strain E = (C_s - P) / 2 (tangential) and what the mesh does not show of it.

    With t = tr E and e = det E, the hoop strain among them, J_s^2 = 1 + 2 t + 4 e; the invariants are written so that
    small strains keep their digits, which a stiffness of 1/T^2 over that of bending asks for:

        I_1 - 3 = 4 (t^2 + 2 t e - e) / J_s^2,    I_2 - 3 = 4 ((t + 2 e)^2 - e) / J_s^2.
    """

    def __init__(self, kinematics: Kinematics, strain: Any, hoop_strain: Any) -> None:
        self.dimension, self.projector = kinematics.dimension, kinematics.projector
        self.strain, self.hoop_strain = strain, hoop_strain

    @cached_property
    def _trace(self) -> Any:
        trace = Trace(self.strain)
        return trace if self.dimension == 3 else trace + self.hoop_strain

    @cached_property
    def _determinant(self) -> Any:
        if self.dimension == 2:
            return Trace(self.strain) * self.hoop_strain
        return 0.5 * (self._trace * self._trace - InnerProduct(self.strain, self.strain))

    @cached_property
    def hoop(self) -> Any:
        """The stretch that the mesh does not show."""
        return sqrt(1 + 2 * self.hoop_strain) if self.dimension == 2 else 1.0

    @cached_property
    def metric_trace(self) -> Any:
        """I_C = 2 + 2 t."""
        return 2 + 2 * self._trace

    @cached_property
    def surface_stretch_squared(self) -> Any:
        """J_s^2 = det C_s, on the tangent plane."""
        return 1 + 2 * self._trace + 4 * self._determinant

    @cached_property
    def excess(self) -> Any:
        """I_1 - 3 of the incompressible body."""
        t, e = self._trace, self._determinant
        return 4 * (t * t + 2 * t * e - e) / self.surface_stretch_squared

    @cached_property
    def second_excess(self) -> Any:
        """I_2 - 3 of the incompressible body."""
        t, e = self._trace, self._determinant
        return 4 * ((t + 2 * e) * (t + 2 * e) - e) / self.surface_stretch_squared


class Led:
    """On a curve, strain and stress that the linearised equations have led to, at the points where the strain is seen.

    ``grown`` and ``around`` are twice what the strain along the curve and out of the mesh is to be less by.
    """

    def __init__(
        self, domain: Domain, law: Law, state: Kinematics, grown: Any, around: Any, order: int
    ) -> None:
        self._law = law
        self._points = PointFields(domain, IntegrationRule(ET.SEGM, order))
        self._less, self._more = ([self._points.field() for _ in range(2)] for _ in range(2))
        self._present = CF((Trace(state.strain), state.hoop_strain, 0.5 * grown, 0.5 * around))
        self._at = [self._points.field() for _ in range(2)]
        along, out = (CF(field).MakeVariable() for field in self._at)
        seen: Any = Strained(state, _along(state, along), out)
        density = law.energy(seen)
        slopes = [density.Diff(strain) for strain in (along, out)]
        bends = [slope.Diff(strain) for slope in slopes for strain in (along, out)]
        self._stress, self._stiffness = CF(tuple(slopes)), CF(tuple(bends))
        self._before: tuple[Array, Array] | None = None

    def energy(self, kinematics: Kinematics) -> Any:
        """Psi at the strain less what is taken away, and the work of the stress that is added."""
        strain, hoop = Trace(kinematics.strain) - self._less[0], kinematics.hoop_strain - self._less[1]
        seen: Any = Strained(kinematics, _along(kinematics, strain), hoop)
        density = self._law.energy(seen)
        return density + self._more[0] * strain + self._more[1] * hoop

    def extrapolate(self, continued: bool) -> None:
        """Take what the last update has brought beside the linearised strain away, and let the stress be the linearised
        one where it is ``continued``."""
        present = self._points.values(self._present)
        E, less = present[:2], present[2:]
        square = np.stack([1 + 2 * E, 1 + 2 * (E - less)])
        less = np.where((square[1] > LEAST * square[0]).all(axis=0), less, 0.0)
        e, more = E - less, np.zeros_like(E)
        if continued and self._before is not None:
            was, led = self._before
            more = self._stress_at(was) + np.einsum("ij...,j...->i...", self._stiffness_at(led), e - was)
            more -= self._stress_at(e)
        self._before = E, e
        for fields, values in ((self._less, less), (self._more, more)):
            for field, one in zip(fields, values, strict=True):
                self._points.put(field, one)

    def rest(self) -> None:
        """Let the energy be that of the strain alone."""
        for field in (*self._less, *self._more):
            field.vec[:] = 0.0

    def _stress_at(self, strain: Array) -> Array:
        self._place(strain)
        return self._points.values(self._stress)

    def _stiffness_at(self, strain: Array) -> Array:
        self._place(strain)
        values = self._points.values(self._stiffness)
        return values.reshape(2, 2, *values.shape[1:])

    def _place(self, strain: Array) -> None:
        for field, one in zip(self._at, strain, strict=True):
            self._points.put(field, one)


def _along(kinematics: Kinematics, strain: Any) -> Any:
    """The tensor with this strain along the curve."""
    return strain * kinematics.projector


class Membrane:
    """Membrane energy of a shell with bending on ``domain``; ``cured`` says whether locking is.

    ``update`` is a grid function that holds the last change of the displacement while the tangent is assembled; see
    :meth:`extrapolating`.
    """

    def __init__(self, domain: Domain, law: Law, thickness: Any, update: GridFunction, *, cured: bool) -> None:
        self.domain, self.law, self.thickness, self.update = domain, law, thickness, update
        order, curve = domain.sizes.order, domain.mesh.dim == 2
        element = ET.SEGM if curve else ET.TRIG
        self.order = 2 * order - (curve and cured)
        self.integral = ds("shell", intrules={element: IntegrationRule(element, self.order)})
        self._guessed, self._continued = Parameter(0.0), False
        self._regge = None
        self._grown: Any = None
        self._expression: Any = None
        self._led: Led | None = None
        if cured and not curve:
            self._regge = HCurlCurl(domain.mesh, order=order - 1, discontinuous=True, definedon=domain.shell)

    def energy(self, kinematics: Kinematics, state: Kinematics) -> Any:
        """T Psi per reference area, in the tangent at the extrapolated strain; ``state`` are the kinematics of the
        present state."""
        strain, grown, around = kinematics.strain, self._grown_by(state), self._around(state)
        if self.domain.mesh.dim == 2:
            self._led = self._led or Led(self.domain, self.law, state, Trace(grown), around, self.order)
            return self.thickness * self._led.energy(kinematics)
        if self._regge is not None:
            strain = Interpolate(strain, self._regge)
            self._expression, self._grown = grown, self._grown or GridFunction(self._regge)
            grown = self._grown
        there = Strained(state, state.strain - 0.5 * grown, CF(0.0))
        share = IfPos(there.surface_stretch_squared - LEAST * state.surface_stretch_squared,
                      IfPos(there.metric_trace - LEAST * state.metric_trace, 0.5, 0.0), 0.0)  # fmt: skip
        seen: Any = Strained(kinematics, strain - share * grown, CF(0.0))
        return self.thickness * self.law.energy(seen)

    def _grown_by(self, state: Kinematics) -> Any:
        """Twice the strain that the last change d has brought beside the linearised one: Grad d^T Grad d. Of a guess
        all of it, F^T Grad d + Grad d^T F - Grad d^T Grad d."""
        slope, F = surface_gradient(self.update), state.deformation_gradient
        square, mixed = slope.trans * slope, F.trans * slope
        return square + self._guessed * (mixed + mixed.trans - 2 * square)

    def _around(self, state: Kinematics) -> Any:
        """The same around the axis."""
        change = self.domain.reduction.hoop_change(self.update)
        return change * change + self._guessed * 2 * change * (state.hoop - change)

    @contextmanager
    def extrapolating(self, update: Array, *, guessed: bool = False, continued: bool = False) -> Iterator[None]:
        """Assemble a tangent at the strain extrapolated over the last ``update`` of the displacement's unknowns, which
        the last tangent has led to if it is ``continued``; or at that before it if the present state is ``guessed``."""
        self._remember(update, guessed)
        self._continued = continued
        if self._led is not None:
            self._led.extrapolate(continued)
        try:
            yield
        finally:
            self._remember(np.zeros_like(update), False)
            if self._led is not None:
                self._led.rest()

    def _remember(self, update: Array, guessed: bool) -> None:
        self.update.vec.FV().NumPy()[:] = update
        self._guessed.Set(float(guessed))
        if self._grown is not None:
            self._grown.Set(self._expression, dual=True, definedon=self.domain.shell)

    @property
    def led(self) -> tuple[bool, bool]:
        """Is the update of :meth:`extrapolating` one to a guess, and has the last tangent led there?"""
        return bool(self._guessed.Get()), self._continued
