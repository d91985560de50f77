"""First and second derivatives of the mid-surface's position, in three dimensions whatever the mesh shows.

Vectors and tensors have three Cartesian components: a reduced mesh lies in the half-plane y = 0 (axisymmetric, so that
x, y, z are the radial, hoop and axial directions) or in the plane z = 0 (plane strain). With arc length s along a
meridian, R its distance from the axis and rho that of the deformed one, the covariant second derivatives of r are

* in 3D           Grad Grad u + N (x) K
* axisymmetric    r''  along the meridian,  (rho/R)' e_phi  mixed,  - rho/R^2 e_r + (R'/R) r'  around the axis
* plane strain    r''  along the curve, nothing along the axis

where K = -Grad N is the reference curvature. Source: the Gauss formula r_,ab = Gamma^c_ab r_,c + (the above) in
coordinates (s, phi); M. do Carmo, Differential Geometry of Curves and Surfaces (1976), section 4-3.

Second derivatives of a displacement of order k are right to order k - 1 in the mesh size, and absent for k = 1. They
oscillate between a few points of each element (J. Barlow, Int. J. Num. Meth. Eng. 10 (1976) 243-251), most of all on
cubic elements: up to order 3, curvatures are projected to linear functions on every element. Measured at the nodes of
deformed spheres, tubes, tori and rings: at order 3 up to three times better, at order 2 a little, at order 4 worse.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

from ngsolve import (
    BND,
    CF,
    Cross,
    Grad,
    GridFunction,
    Id,
    IfPos,
    InnerProduct,
    Normalize,
    OuterProduct,
    SurfaceL2,
    x,
    y,
    z,
)

from embedding.geometry.domain import Domain
from embedding.shell.kinematics import Kinematics

AT_AXIS = 1e-3
"""Closer to the axis than this, in sizes of the shape, hoop quantities take their limit on it: by symmetry they differ
from it by the square of the distance, whereas an error of the mesh's normal is divided by the distance."""
LIFTS = {
    "3d": (1, 0, 0, 0, 1, 0, 0, 0, 1),
    "axisymmetric": (1, 0, 0, 0, 0, 1),
    "plane-strain": (1, 0, 0, 1, 0, 0),
}
MISSING = {"axisymmetric": (0, 1, 0), "plane-strain": (0, 0, 1)}
ALIGNED = 0.99
SMOOTHED = 3
Vector3 = tuple[float, float, float]


class Derivatives:
    """Derivatives of the reference and the deformed position; all are coefficient functions on the shell.

    Curvatures are those of the displacement when they are first asked for; all else is live.

    ``kinematics`` must be that of a grid function u. ``frame`` is an orthonormal tangent frame (E_1, E_2) with
    E_1 x E_2 = N: in 3D, E_1 is ``direction`` projected to the surface (where they are nearly normal to each other, the
    next Cartesian direction in turn takes its place); in a reduction E_1 runs along the curve and E_2 is the direction
    that the mesh does not show.
    """

    def __init__(self, domain: Domain, kinematics: Kinematics, direction: Vector3 = (1.0, 0.0, 0.0)) -> None:
        self.domain, self.reduction, self.kinematics = domain, domain.reduction, kinematics
        self.direction = direction
        self._lift = CF(LIFTS[self.reduction.name], dims=(3, self.reduction.dimension))
        self._missing = CF(MISSING[self.reduction.name]) if self.reduction.dimension == 2 else None

    def lifted(self, vector: Any) -> Any:
        """A vector with the mesh's components as one with three."""
        return self._lift * vector

    @cached_property
    def position(self) -> Any:
        """Reference position R."""
        return self.lifted(self.reduction.position)

    @cached_property
    def reference_normal(self) -> Any:
        """N."""
        return self.lifted(self.kinematics.reference_normal)

    @cached_property
    def normal(self) -> Any:
        """n."""
        return self.lifted(self.kinematics.normal)

    def slope(self, value: Any) -> Any:
        """Gradient of a number, or of a function of the mesh's coordinates as far as it lies in the surface, (3,)."""
        if isinstance(value, float):
            return CF((0.0, 0.0, 0.0))
        return self.lifted(CF(tuple(value.Diff(c) for c in (x, y, z)[: self.reduction.dimension])))

    @cached_property
    def frame(self) -> tuple[Any, Any]:
        """E_1 and E_2."""
        N = self.reference_normal
        if self._missing is not None:
            return Cross(self._missing, N), self._missing
        given, other = CF(self.direction), CF((self.direction[2], self.direction[0], self.direction[1]))
        d = Normalize(IfPos(ALIGNED * InnerProduct(given, given) ** 0.5 - _size(InnerProduct(given, N)), given, other))
        first = Normalize(d - InnerProduct(d, N) * N)
        return first, Cross(N, first)

    @cached_property
    def gradient(self) -> Any:
        """Surface deformation gradient F, 3 x 3, with F N = 0."""
        inplane = self._lift * self.kinematics.deformation_gradient * self._lift.trans
        if self._missing is None:
            return inplane
        return inplane + self.kinematics.hoop * OuterProduct(self._missing, self._missing)

    @cached_property
    def curvature(self) -> Any:
        """Reference curvature K = - Grad N, 3 x 3; -1/R times the projector on a sphere with its normal outwards."""
        return self._smoothed(self._curvature, self.reference_normal)

    @cached_property
    def _curvature(self) -> Any:
        mesh_normal = self.reduction.normal
        sign = InnerProduct(self.kinematics.reference_normal, mesh_normal)
        inplane = self._lift * (-sign * Grad(mesh_normal)) * self._lift.trans
        if self.reduction.name != "axisymmetric":
            return inplane
        along = InnerProduct(self.frame[0], inplane * self.frame[0])
        around = IfPos(x - AT_AXIS, -self.reference_normal[0] / x, along)
        return inplane + around * OuterProduct(self._missing, self._missing)

    @cached_property
    def deformed_curvature(self) -> Any:
        """kappa = b_ab a^a (x) a^b with b_ab = n . r_,ab, 3 x 3."""
        e, f = self.frame
        (p, q), n = dual((self.gradient * e, self.gradient * f)), self.normal
        along, mixed, around = (InnerProduct(n, second) for second in self._seconds)
        return self._smoothed(OuterProduct(p, along * p + mixed * q) + OuterProduct(q, mixed * p + around * q), n)

    def _smoothed(self, tensor: Any, normal: Any) -> Any:
        """A tangential tensor, projected to linear functions on every element up to order 3."""
        if self.domain.sizes.order > SMOOTHED:
            return tensor
        space = SurfaceL2(self.domain.mesh, order=1, definedon=self.domain.shell, dim=9)
        field = GridFunction(space)
        field.Set(tensor.Reshape((9,)).Compile(), BND, definedon=self.domain.shell)
        tangential = Id(3) - OuterProduct(normal, normal)
        return tangential * field.Reshape((3, 3)) * tangential

    def second(self, first: Any, other: Any) -> Any:
        """Covariant second derivative of the deformed position in two tangential directions, shape (3,)."""
        (e, f), (along, mixed, around) = self.frame, self._seconds
        a, b = (InnerProduct(first, e), InnerProduct(first, f)), (InnerProduct(other, e), InnerProduct(other, f))
        return a[0] * b[0] * along + (a[0] * b[1] + a[1] * b[0]) * mixed + a[1] * b[1] * around

    @cached_property
    def _seconds(self) -> tuple[Any, Any, Any]:
        e, f = self.frame
        if self._missing is None:
            return self._hessian(e, e), self._hessian(e, f), self._hessian(f, f)
        along, nothing = self._hessian(e, e), CF((0.0, 0.0, 0.0))
        if self.reduction.name == "plane-strain":
            return along, nothing, nothing
        hoop, slope = self.kinematics.hoop, self.gradient * e
        mixed = IfPos(x - AT_AXIS, (slope[0] - e[0] * hoop) / x, 0.0) * self._missing
        around = (e[0] * slope - hoop * CF((1.0, 0.0, 0.0))) / x
        return along, mixed, IfPos(x - AT_AXIS, around, along)

    def _hessian(self, first: Any, other: Any) -> Any:
        d = self.reduction.dimension
        pair = OuterProduct(self._lift.trans * first, self._lift.trans * other).Reshape((d * d,))
        bend = InnerProduct(first, self._curvature * other) * self.reference_normal
        return self.lifted(self.kinematics.u.Operator("hesseboundary") * pair) + bend


def dual(tangents: tuple[Any, Any]) -> tuple[Any, Any]:
    """The basis that is dual to two vectors, in their plane."""
    a, b = tangents
    aa, ab, bb = InnerProduct(a, a), InnerProduct(a, b), InnerProduct(b, b)
    determinant = aa * bb - ab * ab
    return (bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant


def _size(number: Any) -> Any:
    return IfPos(number, number, -number)
