"""Energy of the field in the free space around the shell, pulled back to the undeformed ambient.

The ambient moves by d: points X go to X + d(X), F = I + Grad d, J = det F (times the out-of-plane stretch). With the
TOTAL potential Phi the field is -F^{-T} Grad Phi and the energy per reference volume is

    1/2 eps J |F^{-T} Grad Phi|^2 = 1/2 eps |cof(F) Grad Phi|^2 / J.

Electrostatics (eps, Phi in V) and magnetostatics (mu, Phi in A) are the same code; dimensionless eps = 1.
Source: theory page, "The field".
"""

from __future__ import annotations

from typing import Any

from ngsolve import CF, Cof, Det, Id, InnerProduct

from embedding.geometry.reduction import Reduction


def field_energy(reduction: Reduction, motion: Any, motion_gradient: Any, potential_gradient: Any, axial: Any) -> Any:
    """Field energy density times the reduction's measure, to be integrated over the mesh with ``dx``."""
    F = Id(reduction.dimension) + motion_gradient
    flux = Cof(F) * potential_gradient
    stretch = reduction.out_of_plane(motion, axial)
    return 0.5 * reduction.measure * stretch * InnerProduct(flux, flux) / Det(F)


def no_field(dimension: int) -> Any:
    """A zero vector for scenes without an applied field."""
    return CF((0.0,) * dimension)
