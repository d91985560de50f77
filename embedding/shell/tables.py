"""The geometry of a Kirchhoff-Love shell, by the names of the published tables, in both configurations.

One class holds the geometry of a surface in coordinates theta^1, theta^2: its tangents a_1, a_2, unit normal n and the
second derivatives of its position. The reference and the deformed mid-surface are two of its objects. A point off the
mid-surface lies at r + zeta n, with zeta = eta in the reference and zeta = lambda eta in the deformed configuration.
Signs: b_ab = n . a_a,b, so that a sphere with its normal outwards has h = -1/r.

Source: paper, tables 1 and 2 and appendix A, with the signs of errata E2 and E18. The slope of lambda along the
surface, which the paper drops, is kept in the normals and areas of true faces:
lambda_,a = - lambda (gamma^b_ba - Gamma^b_ba) (E5).
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

from ngsolve import CF, Cross, Det, InnerProduct, Inv, Norm, OuterProduct, Trace

from embedding.shell.charts import Chart, Pair, Triple
from embedding.shell.derivatives import Derivatives
from embedding.shell.laws import KoiterLaw, Law


class MidSurface:
    """A surface with tangents a_1, a_2, unit normal n and second derivatives of its position r_,11, r_,12, r_,22.

    2 x 2 matrices hold components in the coordinates, 3 x 3 matrices and vectors of three are Cartesian. ``curvature``
    is kappa = - dn/dr, 3 x 3; given apart, it stays right where the coordinates are singular.
    """

    def __init__(self, tangents: Pair, normal: Any, seconds: Triple, curvature: Any) -> None:
        self.tangents, self.normal, self.curvature = tangents, normal, curvature
        self._seconds = seconds

    @cached_property
    def metric(self) -> Any:
        """a_ab = a_a . a_b, 2 x 2."""
        return gram(self.tangents)

    @cached_property
    def contravariant_metric(self) -> Any:
        """a^ab, 2 x 2."""
        return Inv(self.metric)

    @cached_property
    def determinant(self) -> Any:
        """a = det a_ab."""
        return Det(self.metric)

    @cached_property
    def duals(self) -> Pair:
        """Contravariant basis a^1, a^2."""
        return raised(self.contravariant_metric, self.tangents)

    @cached_property
    def projector(self) -> Any:
        """i = a_a (x) a^a, 3 x 3."""
        return dyads(self.tangents, self.duals)

    @cached_property
    def christoffel(self) -> tuple[Triple, Triple]:
        """gamma^a_11, gamma^a_12, gamma^a_22 for a = 1, 2, with gamma^a_bc = a^a . a_b,c."""
        one, two = (tuple(InnerProduct(d, second) for second in self._seconds) for d in self.duals)
        return (one[0], one[1], one[2]), (two[0], two[1], two[2])

    @cached_property
    def contracted(self) -> Pair:
        """gamma^b_b1 and gamma^b_b2, the slopes of the logarithm of the root of a."""
        one, two = self.christoffel
        return one[0] + two[1], one[1] + two[2]

    @cached_property
    def determinant_slopes(self) -> Pair:
        """a_,1 and a_,2: a_,c = 2 a gamma^b_bc."""
        return 2 * self.determinant * self.contracted[0], 2 * self.determinant * self.contracted[1]

    @cached_property
    def second_form(self) -> Any:
        """b_ab = n . a_a,b = a_a . kappa a_b, 2 x 2."""
        return CF(tuple(InnerProduct(p, self.curvature * q) for p in self.tangents for q in self.tangents), dims=(2, 2))

    @cached_property
    def mixed_curvature(self) -> Any:
        """b_a^b = b_ac a^cb, 2 x 2, the lower index counting rows."""
        return CF(tuple(InnerProduct(p, self.curvature * q) for p in self.tangents for q in self.duals), dims=(2, 2))

    @cached_property
    def mean_curvature(self) -> Any:
        """h, half the trace of kappa."""
        return Trace(self.curvature) / 2

    @cached_property
    def gauss_curvature(self) -> Any:
        """det b_ab / a, the product of the two principal curvatures."""
        return (Trace(self.curvature) ** 2 - InnerProduct(self.curvature, self.curvature)) / 2

    def edge_normal(self, along: int) -> Any:
        """Unit in-plane normal tau x n of an edge along the coordinate line number ``along`` (0 or 1)."""
        return Cross(unit(self.tangents[along]), self.normal)


class Layer:
    """The surface at distance ``height`` along the normal of ``mid``; ``slopes`` are the height's derivatives."""

    def __init__(self, mid: MidSurface, height: Any, slopes: Pair = (0.0, 0.0)) -> None:
        self.mid, self.height, self._slopes = mid, height, slopes

    @cached_property
    def shifter(self) -> Any:
        """mu = i - zeta kappa, 3 x 3."""
        return self.mid.projector - self.height * self.mid.curvature

    @cached_property
    def determinant(self) -> Any:
        """det mu = 1 - 2 zeta h + zeta^2 kappa: area here per area of the mid-surface, seen along its normal."""
        return 1 - 2 * self.height * self.mid.mean_curvature + self.height**2 * self.mid.gauss_curvature

    @cached_property
    def inverse(self) -> Any:
        """mu^-1 on the tangent plane, 3 x 3, by the theorem of Cayley and Hamilton."""
        spherical = (1 - 2 * self.height * self.mid.mean_curvature) * self.mid.projector
        return (spherical + self.height * self.mid.curvature) / self.determinant

    @cached_property
    def tangents(self) -> Pair:
        """g_a = mu a_a (without the slope of the height, as in the paper)."""
        return self.shifter * self.mid.tangents[0], self.shifter * self.mid.tangents[1]

    @cached_property
    def duals(self) -> Pair:
        """g^a = mu^-T a^a."""
        return self.inverse.trans * self.mid.duals[0], self.inverse.trans * self.mid.duals[1]

    @cached_property
    def metric(self) -> Any:
        """g_ab, 2 x 2."""
        return gram(self.tangents)

    @cached_property
    def contravariant_metric(self) -> Any:
        """g^ab, 2 x 2."""
        return gram(self.duals)

    @cached_property
    def area_vector(self) -> Any:
        """Normal of the true layer times its area per area of the mid-surface: det mu (n - zeta_,a g^a)."""
        first, second = self.duals
        return self.determinant * (self.mid.normal - self._slopes[0] * first - self._slopes[1] * second)

    def lateral(self, along: Any) -> tuple[Any, Any, Any]:
        """Of a lateral face over an edge with tangent ``along``: |mu along|, its unit tangent and its unit normal."""
        moved = self.shifter * along
        tangent = unit(moved)
        return Norm(moved), tangent, Cross(tangent, self.mid.normal)


class Tables:
    """All quantities of both configurations of a shell; ``place`` is eta/T, from -1/2 to 1/2.

    ``thickness`` T is a number or a function of the mesh's coordinates.
    """

    def __init__(self, derivatives: Derivatives, chart: Chart, thickness: Any, law: Law) -> None:
        self.derivatives, self.thickness, self.law = derivatives, thickness, law
        self.thickness_stretch = law.thickness_stretch(derivatives.kinematics)
        A, F, N = chart.tangents, derivatives.gradient, derivatives.reference_normal
        a = F * A[0], F * A[1]

        def seconds(basis: Pair, covariant: list[Any]) -> Triple:
            one, two = chart.christoffel
            parts = [one[i] * basis[0] + two[i] * basis[1] + covariant[i] for i in range(3)]
            return parts[0], parts[1], parts[2]

        pairs = ((A[0], A[0]), (A[0], A[1]), (A[1], A[1]))
        K, kappa = derivatives.curvature, derivatives.deformed_curvature
        bends = [InnerProduct(p, K * q) * N for p, q in pairs]
        self.reference = MidSurface(A, N, seconds(A, bends), K)
        moved = seconds(a, [derivatives.second(p, q) for p, q in pairs])
        self.deformed = MidSurface(a, derivatives.normal, moved, kappa)

    @cached_property
    def determinant_ratio(self) -> Any:
        """a-hat = a / A, the square of the surface stretch."""
        return self.deformed.determinant / self.reference.determinant

    @cached_property
    def surface_stretch(self) -> Any:
        """Deformed area per reference area of the mid-surface."""
        return self.determinant_ratio**0.5

    @cached_property
    def thickness_slopes(self) -> Pair:
        """lambda_,1 and lambda_,2: d ln lambda = - d ln (da/dA), or for small strains - nu / (1 - nu) d tr E."""
        if isinstance(self.law, KoiterLaw):
            coupling, first, second = self.law.poisson / (1 - self.law.poisson), *self.reference.tangents
            return -coupling * self._strain_rate(first), -coupling * self._strain_rate(second)
        rates = [now - then for now, then in zip(self.deformed.contracted, self.reference.contracted, strict=True)]
        return -self.thickness_stretch * rates[0], -self.thickness_stretch * rates[1]

    def _strain_rate(self, along: Any) -> Any:
        """Derivative of tr E = (C_aa - 2) / 2 in a tangential direction."""
        F, second, (e, f) = self.derivatives.gradient, self.derivatives.second, self.derivatives.frame
        return InnerProduct(F * e, second(e, along)) + InnerProduct(F * f, second(f, along))

    @cached_property
    def thickness_gradient(self) -> Any:
        """Reference surface gradient of lambda, shape (3,)."""
        (one, two), (first, second) = self.thickness_slopes, self.reference.duals
        return one * first + two * second

    @cached_property
    def _growth(self) -> Pair:
        """T_,1 and T_,2."""
        slope, (first, second) = self.derivatives.slope(self.thickness), self.reference.tangents
        return InnerProduct(slope, first), InnerProduct(slope, second)

    def reference_layer(self, place: float) -> Layer:
        """The layer at eta = ``place`` T of the reference configuration."""
        one, two = self._growth
        return Layer(self.reference, place * self.thickness, (place * one, place * two))

    def deformed_layer(self, place: float) -> Layer:
        """The same layer in the deformed configuration, at zeta = lambda eta."""
        (one, two), (first, second), T = self.thickness_slopes, self._growth, self.thickness
        thin = self.thickness_stretch
        slopes = place * (T * one + thin * first), place * (T * two + thin * second)
        return Layer(self.deformed, place * T * thin, slopes)

    def deformation_gradient(self, place: float) -> Any:
        """F = g_a (x) G^a + lambda n (x) N, 3 x 3; det F = 1 at the mid-surface."""
        inplane = dyads(self.deformed_layer(place).tangents, self.reference_layer(place).duals)
        return inplane + self.thickness_stretch * OuterProduct(self.deformed.normal, self.reference.normal)

    def inverse_deformation_gradient(self, place: float) -> Any:
        """F^-1 = G_a (x) g^a + N (x) n / lambda, 3 x 3."""
        inplane = dyads(self.reference_layer(place).tangents, self.deformed_layer(place).duals)
        return inplane + OuterProduct(self.reference.normal, self.deformed.normal) / self.thickness_stretch

    def cauchy_green(self, place: float) -> Any:
        """C = g_ab G^a (x) G^b + lambda^2 N (x) N, 3 x 3."""
        gradient = self.deformation_gradient(place)
        return gradient.trans * gradient

    def deformed_edge_normal(self, along: int) -> Any:
        """nu-bar = nu_a a^a of an edge along a coordinate line; not of unit length."""
        nu, (first, second) = self.reference.edge_normal(along), self.reference.tangents
        return InnerProduct(nu, first) * self.deformed.duals[0] + InnerProduct(nu, second) * self.deformed.duals[1]


def unit(vector: Any) -> Any:
    """A vector divided by its length."""
    return vector / Norm(vector)


def gram(basis: Pair) -> Any:
    """The products of two vectors with each other, 2 x 2."""
    return CF(tuple(InnerProduct(p, q) for p in basis for q in basis), dims=(2, 2))


def raised(matrix: Any, basis: Pair) -> Pair:
    """The vectors matrix_ab basis_b."""
    return matrix[0, 0] * basis[0] + matrix[0, 1] * basis[1], matrix[1, 0] * basis[0] + matrix[1, 1] * basis[1]


def dyads(left: Pair, right: Pair) -> Any:
    """left_a (x) right_a, 3 x 3."""
    return OuterProduct(left[0], right[0]) + OuterProduct(left[1], right[1])
