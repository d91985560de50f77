"""Energy of the field in the free space around the shell, pulled back to the undeformed ambient.

The ambient moves by d: points X go to X + d(X), F = I + Grad d, J = det F (times the out-of-plane stretch). With the
TOTAL potential Phi the field is -F^{-T} Grad Phi and the energy per reference volume is

    1/2 eps J |F^{-T} Grad Phi|^2 = 1/2 eps |cof(F) Grad Phi|^2 / J.

Electrostatics (eps, Phi in V) and magnetostatics (mu, Phi in A) are the same code; dimensionless eps = 1.
Source: theory page, "The field".
"""

from __future__ import annotations

from typing import Any

from ngsolve import CF, Cof, Det, Grad, Id, InnerProduct

from embedding.geometry.reduction import Reduction


def field_energy(reduction: Reduction, motion: Any, motion_gradient: Any, potential_gradient: Any, axial: Any) -> Any:
    """Field energy density times the reduction's measure, to be integrated over the mesh with ``dx``."""
    F = Id(reduction.dimension) + motion_gradient
    flux = Cof(F) * potential_gradient
    stretch = reduction.out_of_plane(motion, axial)
    return 0.5 * reduction.measure * stretch * InnerProduct(flux, flux) / Det(F)


def far_field_energy(reduction: Reduction, potential: Any, applied: Any, radius: float) -> Any:
    """Energy of the space beyond the outer boundary, to be integrated over it with ``ds("outer")``.

    The potential beyond is that of the applied field plus a decaying part phi' = Phi + E0 . X. On a sphere of radius
    R the decaying harmonic of degree l has the normal derivative -(l + 1) / R; the form used here,

        1/2 [ phi'^2 / R + (R / 2) |grad_s phi'|^2 ]          (3D and axisymmetry)
        1/2 [ 2 phi'^2 / 3R + (R / 3) |grad_s phi'|^2 ]       (plane strain: degree l decays with l / R)

    is exact for the net charge and the dipole (l = 0, 1; in the plane, where a net charge has no free space, for
    l = 1, 2) and keeps the matrix sparse: the second-order Robin condition of Bayliss, Gunzburger and Turkel.
    """
    excess = potential + InnerProduct(applied, reduction.position)
    slope = Grad(potential).Trace() if hasattr(Grad(potential), "Trace") else Grad(potential)
    normal = reduction.position / radius
    slope_of_excess = slope + applied - InnerProduct(applied, normal) * normal
    value, slope_weight = (2 / 3, radius / 3) if reduction.name == "plane-strain" else (1.0, radius / 2)
    decaying = value * excess * excess / radius + slope_weight * InnerProduct(slope_of_excess, slope_of_excess)
    return reduction.measure * (0.5 * decaying + InnerProduct(applied, normal) * potential)


def no_field(dimension: int) -> Any:
    """A zero vector for scenes without an applied field."""
    return CF((0.0,) * dimension)
