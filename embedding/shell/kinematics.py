"""Kinematics of the deformed mid-surface and of the shell's faces, in the field's names, for every reduction.

With the reference normal N, the surface projector P = I - N (x) N and the displacement u of the mid-surface:

* surface deformation gradient   F = P + Grad_S u                        (maps tangents; F N = 0)
* area vector                    m = J_s n,  from cof(F) N times the out-of-plane stretch
* surface stretch                J_s = |m|   (paper: the square root of a-hat)
* thickness stretch              lambda = 1 / J_s   (incompressibility)
* first invariant of C_s         I_C = F : F (+ square of the out-of-plane stretch)
* faces                          x_t,b = r +- (T/2) lambda n,  lambda n = m / (m . m)

Sources: paper section 3 and its tables; theory page, "Kinematics".
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

from ngsolve import Cof, Det, Grad, Id, InnerProduct, OuterProduct, sqrt

from embedding.geometry.reduction import Reduction


def surface_gradient(field: Any) -> Any:
    """Reference surface gradient of a trial function, test function or grid function on the shell."""
    gradient = Grad(field)
    return gradient.Trace() if hasattr(gradient, "Trace") else gradient


class Kinematics:
    """Named kinematic quantities of a mid-surface displaced by ``u``; all are coefficient functions on the shell.

    ``normal`` is the project's own reference normal (towards the top face), ``axial`` the stretch lambda_z of plane
    strain. In two dimensions tensors are the in-plane 2 x 2 part and ``hoop`` is the missing stretch.
    """

    def __init__(self, reduction: Reduction, normal: Any, u: Any, axial: Any = 1.0, hoop: Any = None) -> None:
        self.dimension = reduction.dimension
        self.u, self._reduction = u, reduction
        self.reference_normal = normal
        self.projector = Id(self.dimension) - OuterProduct(normal, normal)
        self.gradient = surface_gradient(u)
        self.deformation_gradient = self.projector + self.gradient
        self.hoop = reduction.out_of_plane(u, axial) if hoop is None else hoop

    @cached_property
    def area_vector(self) -> Any:
        """m = J_s n: deformed normal times deformed area per reference area."""
        return self.hoop * (Cof(self.deformation_gradient) * self.reference_normal)

    @cached_property
    def surface_stretch_squared(self) -> Any:
        """J_s squared, the determinant of the surface metric ratio (paper: a-hat)."""
        return InnerProduct(self.area_vector, self.area_vector)

    @cached_property
    def surface_stretch(self) -> Any:
        """J_s = da / dA."""
        return sqrt(self.surface_stretch_squared)

    @cached_property
    def thickness_stretch(self) -> Any:
        """lambda = t / T = 1 / J_s."""
        return 1 / self.surface_stretch

    @cached_property
    def normal(self) -> Any:
        """Deformed unit normal n, pointing to the top side."""
        return self.area_vector / self.surface_stretch

    @cached_property
    def director(self) -> Any:
        """lambda n: the faces lie at r +- (T/2) times it. First derivatives of u only."""
        return self.area_vector / self.surface_stretch_squared

    @cached_property
    def metric_trace(self) -> Any:
        """I_C = trace of the surface Cauchy-Green tensor C_s = F^T F."""
        trace = InnerProduct(self.deformation_gradient, self.deformation_gradient)
        return trace if self.dimension == 3 else trace + self.hoop * self.hoop

    @cached_property
    def strain(self) -> Any:
        """E = (C_s - P) / 2, the surface Green strain that the mesh shows; small strains keep their digits."""
        product = self.gradient.trans * self.projector
        return 0.5 * (product + product.trans + self.gradient.trans * self.gradient)

    @cached_property
    def hoop_strain(self) -> Any:
        """(hoop^2 - 1) / 2, the strain that the mesh does not show; 0 in 3D. Small ones keep their digits."""
        if self._reduction.name == "axisymmetric":
            change = self._reduction.hoop_change(self.u)
            return change + 0.5 * change * change
        return 0.5 * (self.hoop - 1) * (self.hoop + 1)

    @cached_property
    def excess(self) -> Any:
        """I_1 - 3 of the incompressible body."""
        return self.metric_trace + 1 / self.surface_stretch_squared - 3

    @cached_property
    def second_excess(self) -> Any:
        """I_2 - 3 of the incompressible body."""
        return self.surface_stretch_squared + self.metric_trace / self.surface_stretch_squared - 3

    @cached_property
    def spatial_gradient(self) -> Any:
        """F-hat = F + lambda n (x) N, the deformation gradient of the incompressible body at the mid-surface."""
        return self.deformation_gradient + OuterProduct(self.director, self.reference_normal)

    @cached_property
    def inverse_transpose(self) -> Any:
        """F-hat^{-T}: maps reference surface gradients to deformed ones."""
        return Cof(self.spatial_gradient) / Det(self.spatial_gradient)
