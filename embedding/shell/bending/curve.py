"""Bending of a shell that the mesh shows as a curve: the meridian in axisymmetry, the cross-section in plane strain.

The mixed method shrinks to one continuous scalar along the curve. With theta the angle from the reference tangent to
the deformed one and c = +-1 the hand of tangent and normal, b_ss = c |F t| (theta_0' + theta'), so that

    K_ss = lambda b_ss - B_ss C_ss = c theta' / hoop + B_ss (1 / hoop - C_ss)
    K_hh = lambda b_hh - B_hh C_hh = - lambda n_r hoop / R + N_r hoop^2 / R   (axisymmetry; 0 in plane strain)

The unknown is q = m_ss R / hoop (plane strain: m_ss / hoop), continuous where the moment balance wants it; integrated
by parts, int q c theta' = - int c q' theta, neither second derivatives nor jumps appear, and kinks keep their angle.
Held in numbers is q / T^3, so that all of the energy's second derivatives are of the size T^3: NGSolve finds mixed ones
as differences, and those with displacements would be lost beside the compliance, of the size T^-3, of q itself.
Where a rotation is free q is given (the moment there, or 0); where it is held q is free, and the angle is held by the
equation itself. Source: theory page, "Bending".
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, Grad, GridFunction, IfPos, InnerProduct, SurfaceL2, atan2, cos, sin, specialcf, x

from embedding.geometry.domain import Domain
from embedding.geometry.ends import facets_named
from embedding.geometry.matching import Matching, put
from embedding.geometry.positions import reference_positions
from embedding.geometry.spaces import Mask, TraceSpace
from embedding.shell.bending.stiffness import EdgeMoments, Stiffness
from embedding.shell.kinematics import Kinematics, surface_gradient

ON_AXIS = 1e-9


class CurveBending:
    """Space and energy of bending on a curve.

    ``held`` names the ends whose rotation is held, ``moments`` are given at others, per reference length.
    """

    condensed = None

    def __init__(self, domain: Domain, stiffness: Stiffness, held: tuple[str, ...], moments: EdgeMoments = ()) -> None:
        self.domain, self.stiffness = domain, stiffness
        self._trace = TraceSpace(domain.mesh, domain.sizes.order, vector=False, reach="shell")
        self._axisymmetric = domain.reduction.name == "axisymmetric"
        free_ends = facets_named(domain.facets, set(domain.rims) - set(held))
        fixed = np.zeros(self._trace.scalar.ndof, bool)
        fixed[free_ends] = True
        if self._axisymmetric:
            fixed[: domain.mesh.nv][np.abs(reference_positions(domain.mesh)[:, 0]) < ON_AXIS] = True
        self._trace.fix(0, fixed)
        self._unit = domain.shell_integral(stiffness.thickness**3) / domain.area
        self._given = GridFunction(self._trace.scalar)
        for edge, given in moments:
            for vertex in facets_named(domain.facets, (edge,)):
                radius = reference_positions(domain.mesh)[int(vertex), 0] if self._axisymmetric else 1.0
                self._given.vec[int(vertex)] = given * radius / self._unit
        self._turned = GridFunction(SurfaceL2(domain.mesh, order=domain.sizes.order, definedon=domain.shell))
        self._tangent = specialcf.tangential(2)
        self._slope = domain.sign * Grad(specialcf.normal(2))
        self._hand = InnerProduct(domain.normal, CF((-self._tangent[1], self._tangent[0])))

    def parts(self) -> dict[str, tuple[Any, Mask]]:
        """The space of q, with its free unknowns."""
        return {"moment": (self._trace.space, self._trace.free)}

    def energies(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> list[Any]:
        """Integrals whose stationary point in the moment is the bending energy less the work of the moments given at
        ends, times ``factor``."""
        q = values["moment"]
        measure = self.domain.reduction.measure
        per_radius = measure / x if self._axisymmetric else measure
        along = self._unit * InnerProduct(surface_gradient(q) + factor * surface_gradient(self._given), self._tangent)
        pairing = -1 * per_radius * self._hand * along * self._angle(kinematics)
        moment = self._moment((q.Trace() if hasattr(q, "Trace") else q) + factor * self._given, kinematics)
        t, hoop = self._tangent, kinematics.hoop
        stretched = kinematics.deformation_gradient * t
        B = -1 * InnerProduct(t, self._slope * t)
        rest = moment * B * (1 / hoop - InnerProduct(stretched, stretched))
        rest = rest - self.stiffness.partial_dual(kinematics, moment, self._hoop_curvature(kinematics))
        return [(pairing + measure * rest) * self.domain.surface()]

    def residuals(self, values: dict[str, Any], test: Any, kinematics: Kinematics) -> list[Any]:
        """None: an end does not turn but about its own axis, and moments there have a potential."""
        return []

    def _moment(self, q: Any, kinematics: Kinematics) -> Any:
        """m_ss from the unknown, q over its unit."""
        moment = self._unit * q * kinematics.hoop
        return moment / x if self._axisymmetric else moment

    def _hoop_curvature(self, kinematics: Kinematics) -> Any:
        if not self._axisymmetric:
            return CF(0.0)
        hoop, N = kinematics.hoop, kinematics.reference_normal
        return (N[0] * hoop - kinematics.director[0]) * hoop / x

    def _angle(self, kinematics: Kinematics) -> Any:
        """theta, counted on past pi from the angle of the last refresh."""
        t, moved = self._tangent, kinematics.deformation_gradient * self._tangent
        sine, cosine = t[0] * moved[1] - t[1] * moved[0], InnerProduct(t, moved)
        s, c = sin(self._turned), cos(self._turned)
        return self._turned + atan2(c * sine - s * cosine, c * cosine + s * sine)

    def stored(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> Any:
        """Bending energy per reference area of converged moments, as a coefficient function."""
        moment = self._moment(values["moment"] + factor * self._given, kinematics)
        return self.stiffness.stored(kinematics, moment, self._hoop_curvature(kinematics))

    def shear_force_squared(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> Any:
        """Square of the shear force per reference length that the moments are in balance with: (m_ss R)' - m_hh R',
        over R, of a shell that is hardly stretched."""
        q = self._unit * (values["moment"] + factor * self._given)
        slope = surface_gradient(values["moment"]) + factor * surface_gradient(self._given)
        along = self._unit * InnerProduct(slope, self._tangent)
        if self._axisymmetric:
            moment = q * kinematics.hoop / x
            around = self.stiffness.hoop_moment(kinematics, moment, self._hoop_curvature(kinematics))
            along = (along - around * self._tangent[0]) / x
        return along * along

    def principal_moments(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> tuple[Any, Any]:
        """Larger and smaller of meridional and hoop bending moment per deformed length, lambda l_i^2 m_ii / J_s."""
        q = self._unit * (values["moment"] + factor * self._given)
        moment, hoop_curvature = q * kinematics.hoop, CF(0.0)
        if self._axisymmetric:
            slope = surface_gradient(values["moment"]) + factor * surface_gradient(self._given)
            on_axis = self._unit * InnerProduct(slope, self._tangent) / self._tangent[0]  # q / R where R = 0
            moment = IfPos(x - ON_AXIS, q / x, on_axis) * kinematics.hoop
            N = kinematics.reference_normal
            spread = IfPos(x - ON_AXIS, (N[0] * kinematics.hoop - kinematics.director[0]) / x, CF(0.0))
            hoop_curvature = spread * kinematics.hoop
        F, area = kinematics.deformation_gradient, kinematics.surface_stretch_squared
        around = self.stiffness.hoop_moment(kinematics, moment, hoop_curvature) * kinematics.hoop**2 / area
        along = moment * InnerProduct(F, F) / area
        around = IfPos(x - ON_AXIS, around, along) if self._axisymmetric else around
        return IfPos(along - around, along, around), IfPos(along - around, around, along)

    def refresh(self, kinematics: Kinematics) -> None:
        """Count the angle on from the present state, given by its ``kinematics`` on grid functions."""
        angle = GridFunction(self._turned.space)
        angle.Set(self._angle(kinematics), BND, definedon=self.domain.shell)
        self._turned.vec.data = angle.vec

    def continue_from(self, other: CurveBending) -> None:
        """Count the angle on from where ``other``, of another order on the same mesh, has it."""
        self._turned.Set(other._turned, BND, definedon=self.domain.shell)

    def carried_from(self, other: CurveBending, matching: Matching) -> None:
        """Count the angle on from where ``other``, on another mesh with the same shell, has it."""
        order = self._turned.space.globalorder
        unknowns = put(self._turned.space, matching.new, matching.sampled(other._turned, order))
        self._turned.vec.FV().NumPy()[:] = unknowns[0]

    @property
    def memory(self) -> npt.NDArray[np.float64]:
        """What rotations are measured from, for a state that may be gone back to."""
        return np.array(self._turned.vec.FV().NumPy())

    @memory.setter
    def memory(self, values: npt.NDArray[np.float64]) -> None:
        self._turned.vec.FV().NumPy()[:] = values
