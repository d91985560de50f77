"""The field beyond the outer boundary, out to infinity: a mapped region, or a condition on the boundary.

Beyond the sphere (plane strain: circle) of radius R about the origin, or about the point below it on the surface of a
half-space, from which X and r count then, the potential is that of the applied field plus a
decaying part, phi = -E0 . x + phi', and what lies there has the energy, up to a constant,

    1/2 int |grad phi'|^2 dV  +  oint (E0 . n) phi dA.                                                             (*)

The mapped region. The mesh has the shell R < r < R2 in the place of all space s > R. Its radius is mapped by
inversion, R / s = w(r) = (R2 - r) / (R2 - R), and the unknown there is psi = phi' / w, the decaying part times s / R,
which is phi' itself on the boundary. With e = X / r, psi_r = e . Grad psi, and the rest of the gradient g,

    1/2 int k [ (psi - (R2 - r) psi_r)^2 + r^2 |g|^2 ] dX,    k = R / ((R2 - R) r^2)             3D, axisymmetric
                                                              k = (R2 - r) / ((R2 - R)^2 r)      plane strain.

From phi' to psi: dV = s^{d-1} ds dO, and ds = -s^2 / R dw takes the energy to 1/2 int R [ (w psi)_w^2 + psi_O^2 ] dw dO
in 3D (psi_O the gradient on the unit sphere) and to 1/2 int w [ (w psi)_w^2 + psi_O^2 ] dw dO in the plane; then
w psi_w = -(R2 - r) psi_r and |g| = |psi_O| / r. In axisymmetry the measure 2 pi r holds the circumference.

What that buys: coefficients without poles, a sum of squares, and no condition at r = R2: phi' = w psi vanishes there by
itself. The decaying harmonics are psi = w^l Y_l in 3D and w^{l-1} Y_l in the plane, polynomials of the mesh radius; a
net charge (3D) or a dipole (in the plane) has a psi that does not depend on the radius at all. In the plane a net
charge has no zero at infinity and no such psi: there potentials are counted from infinity, and the charge is 0.
Known: the same map for the potential itself (X. Brunotte, G. Meunier, J. F. Imhoff, IEEE Trans. Magn. 28 (1992) 1663),
with coefficients that are infinite at R2 and a boundary there that must lie exactly on the sphere. psi is the unknown
of Kelvin's inversion, which needs a second ball.

Robin's condition. The decaying harmonic of degree l has the normal derivative -(l + 1) / R at R (plane strain: -l / R);
see :func:`robin_energy`. Source: theory page "Far away".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ngsolve import BND, CF, ET, H1, Grad, GridFunction, IfPos, InnerProduct, IntegrationRule, Norm, dx

from embedding.geometry.domain import Domain
from embedding.geometry.reduction import Reduction
from embedding.geometry.surroundings import REACH


@dataclass(frozen=True)
class FarField:
    """What lies beyond the outer boundary of ``domain``, with the uniform ``applied`` field (mesh components).

    ``lift`` is minus E0 . X on the outer boundary, carried into the mapped region, to which the unknown potential is
    continuous: there it is psi + lift. None: Robin's condition. ``level`` is the potential at infinity, that of a
    half-space; 0 without one.
    """

    domain: Domain
    applied: tuple[float, ...]
    lift: GridFunction | None
    level: float = 0.0

    def terms(self, potential: Any, factor: Any = 1.0, weight: Any = 1.0) -> list[Any]:
        """``weight`` times the energy of the total ``potential`` (trial or grid function), integrals and all; E0 is
        ``applied`` times ``factor``."""
        domain, applied = self.domain, factor * CF(self.applied)
        reduction, radius, place = domain.reduction, domain.sizes.radius, _place(domain)
        if self.lift is None:
            energy = robin_energy(reduction, potential, applied, radius, place, factor * self.level)
            return [weight * energy * domain.surface("outer")]
        psi, slope = potential - factor * self.lift, Grad(potential) - factor * Grad(self.lift)
        terms = [weight * beyond_energy(reduction, psi, slope, radius, place=place) * beyond(domain)]
        if any(self.applied):
            mixed = reduction.measure * InnerProduct(applied, _outwards(reduction, place)) * potential
            terms.append(weight * mixed * domain.surface("outer"))
        return terms

    def decaying(self, potential: Any, factor: Any = 1.0) -> Any:
        """phi' on the outer boundary, of the total ``potential``."""
        applied = factor * CF(self.applied)
        return potential - factor * self.level + InnerProduct(applied, _place(self.domain))


def far_field(domain: Domain, applied: tuple[float, ...], *, infinite: bool, level: float = 0.0) -> FarField:
    """The far field of ``domain``; ``infinite`` needs its mapped region ``beyond``."""
    if not infinite:
        return FarField(domain, applied, None, level)
    lift = GridFunction(H1(domain.mesh, order=domain.sizes.potential_order, definedon=domain.mesh.Materials("beyond")))
    if any(applied):
        outer = domain.mesh.Boundaries("outer")
        lift.Set(-InnerProduct(CF(applied), _place(domain)), BND, definedon=outer)
    if level:
        constant = GridFunction(lift.space)
        constant.Set(level)
        lift.vec.data += constant.vec
    return FarField(domain, applied, lift, level)


def _place(domain: Domain) -> Any:
    """Position from the centre of the outer boundary."""
    return domain.reduction.position - CF(domain.sizes.centre(domain.mesh.dim))


def beyond(domain: Domain) -> Any:
    """The integral over the mapped region, exact for squares of the potential (the ambient's is for its gradient's).

    Coefficients are smooth: two more orders change a sphere's charge by 2e-8 at potential order 3, 1e-9 at order 4.
    """
    element = ET.TET if domain.mesh.dim == 3 else ET.TRIG
    return dx("beyond", intrules={element: IntegrationRule(element, 2 * domain.sizes.potential_order)})


def beyond_energy(
    reduction: Reduction, psi: Any, slope: Any, radius: float, outer: float | None = None, place: Any = None
) -> Any:
    """Energy density of the mapped region times the reduction's measure, to be integrated with :func:`beyond`.

    ``psi`` is phi' s / R and ``slope`` its gradient on the mesh, shape (d,); the region ends at ``outer``, 1.5 times
    ``radius``; ``place`` is the position from its centre, the origin. The module says where the formula comes from.
    """
    outer = REACH * radius if outer is None else outer
    place = reduction.position if place is None else place
    r = Norm(place)
    along = InnerProduct(place / r, slope)
    across = InnerProduct(slope, slope) - along * along  # |g|^2
    squares = (psi - (outer - r) * along) ** 2 + r * r * across
    depth = outer - radius
    k = (outer - r) / (depth**2 * r) if reduction.name == "plane-strain" else radius / (depth * r * r)
    return 0.5 * reduction.measure * k * squares


def robin_energy(
    reduction: Reduction, potential: Any, applied: Any, radius: float, place: Any = None, level: Any = 0.0
) -> Any:
    """Energy (*) by a condition on the outer boundary, times the measure, to be integrated over ``outer``.

    With phi' = phi + E0 . X, less the ``level`` far away, X the ``place`` from the centre (the origin), the form used,

        1/2 [ phi'^2 / R + (R / 2) |grad_s phi'|^2 ]          (3D and axisymmetry)
        1/2 [ 2 phi'^2 / 3R + (R / 3) |grad_s phi'|^2 ]       (plane strain: degree l decays with l / R)

    is exact for the net charge and the dipole (l = 0, 1; in the plane, where a net charge has no free space, for
    l = 1, 2) and keeps the matrix sparse: the second-order Robin condition of Bayliss, Gunzburger and Turkel.
    """
    place = reduction.position if place is None else place
    excess = potential - level + InnerProduct(applied, place)
    slope = Grad(potential).Trace() if hasattr(Grad(potential), "Trace") else Grad(potential)
    normal = _outwards(reduction, place)
    slope_of_excess = slope + applied - InnerProduct(applied, normal) * normal
    value, slope_weight = (2 / 3, radius / 3) if reduction.name == "plane-strain" else (1.0, radius / 2)
    decaying = value * excess * excess / radius + slope_weight * InnerProduct(slope_of_excess, slope_of_excess)
    return reduction.measure * (0.5 * decaying + InnerProduct(applied, normal) * potential)


def _outwards(reduction: Reduction, place: Any) -> Any:
    """The mesh's own normal on the outer boundary, so that a uniform field passes without error on straight meshes."""
    normal = reduction.normal
    return IfPos(InnerProduct(normal, place), 1.0, -1.0) * normal
