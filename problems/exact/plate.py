"""Homogeneous deformations of a flat plate: exact in three dimensions and for the shell alike."""

from __future__ import annotations

from problems.exact.material import Law, neo_hookean
from problems.exact.roots import increasing_root


def traction(stretch: float, law: Law | None = None) -> float:
    """Edge force per reference edge length and thickness, t / T, that stretches a plate uniaxially.

    Incompressible uniaxial tension, transverse stretches stretch^(-1/2), nominal stress (sigma_1 - sigma_3) /
    stretch: mu (l - l^-2) for neo-Hooke (Treloar, The Physics of Rubber Elasticity, ch. 5).
    """
    law = law or neo_hookean()
    return law.stress_difference(stretch, stretch**-0.5) / stretch


def traction_stretch(traction_per_thickness: float, law: Law | None = None) -> float:
    """Stretch under the edge force `traction_per_thickness` = t / T; inverse of `traction`."""
    return increasing_root(lambda stretch: traction(stretch, law) - traction_per_thickness)


def equibiaxial_traction(stretch: float, law: Law | None = None) -> float:
    """The same for a plate stretched equally in both directions, (sigma_1 - sigma_3) / stretch with l_3 = l^-2."""
    law = law or neo_hookean()
    return law.stress_difference(stretch, stretch**-2) / stretch


def pure_shear_traction(stretch: float, law: Law | None = None) -> float:
    """The same for a plate whose width is held: stretches (l, 1, 1/l)."""
    law = law or neo_hookean()
    return law.stress_difference(stretch, 1.0 / stretch) / stretch


def squeeze(stretch: float, law: Law | None = None) -> float:
    """Equal pressure on both faces that squeezes a plate to the in-plane stretches (l, l); the rim is free.

    sigma_1 = sigma_2 = 0 on the rim, sigma_3 = -p on the faces, thickness stretch l^-2, hence
    p = sigma_1 - sigma_3 = mu (l^2 - l^-4) for neo-Hooke.
    """
    law = law or neo_hookean()
    return law.stress_difference(stretch, stretch**-2)


def squeeze_stretch(pressure: float, law: Law | None = None) -> float:
    """In-plane stretch under equal pressures on both faces; inverse of `squeeze`."""
    return increasing_root(lambda stretch: squeeze(stretch, law) - pressure)
