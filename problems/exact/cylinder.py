"""Inflation of an infinite tube at held axial stretch: membrane, exact thick wall, a published formula.

The stretch is the hoop stretch of the material mid-surface. `pressure` is p_b - p_t, inside minus outside.
"""

from __future__ import annotations

import math

from problems.exact.material import Law, MooneyRivlin, neo_hookean
from problems.exact.roots import increasing_root


def face_stretches(stretch: float, thickness_ratio: float, axial_stretch: float = 1.0) -> tuple[float, float]:
    """Hoop stretches (inner, outer) of the faces: axial_stretch r^2 - R^2 is the same for all particles.

    Raises ValueError for a stretch so small that the bore is closed.
    """
    inner, outer = 1.0 - 0.5 * thickness_ratio, 1.0 + 0.5 * thickness_ratio
    added = axial_stretch * stretch**2 - 1.0
    if inner**2 + added <= 0.0:
        raise ValueError(f"the bore is closed at stretch {stretch:.6g}")
    return (
        math.sqrt((1.0 + added / inner**2) / axial_stretch),
        math.sqrt((1.0 + added / outer**2) / axial_stretch),
    )


def membrane_pressure(
    stretch: float, thickness_ratio: float, law: Law | None = None, axial_stretch: float = 1.0
) -> float:
    """p = (T/R) (dW/dl) / (l L) at axial stretch L: mu (T/R) (1 - l^-4) for neo-Hooke in plane strain.

    Green and Adkins, Large Elastic Deformations (membrane theory).
    """
    law = law or neo_hookean()
    thickness_stretch = 1.0 / (stretch * axial_stretch)
    return thickness_ratio * law.stress_difference(stretch, thickness_stretch) / (stretch**2 * axial_stretch)


def thick_pressure(
    stretch: float, thickness_ratio: float, law: MooneyRivlin | None = None, axial_stretch: float = 1.0
) -> float:
    """Exact pressure of the thick tube: integral of W'(s) / (s^2 L - 1) from outer to inner face stretch.

    Haughton and Ogden, J. Mech. Phys. Solids 27 (1979) 489-512; L is the axial stretch. The integrand
    is m [1 / (L s) + 1 / (L^2 s^3)] with m = 2 (c1 + c2 L^2), hence
    p = m [ln(s_in / s_out) / L + (s_out^-2 - s_in^-2) / (2 L^2)]. Plane strain: L = 1, m = mu for both laws.
    """
    law = law or neo_hookean()
    inner, outer = face_stretches(stretch, thickness_ratio, axial_stretch)
    modulus = 2.0 * (law.c1 + law.c2 * axial_stretch**2)
    return modulus * (
        math.log(inner / outer) / axial_stretch + (outer**-2 - inner**-2) / (2.0 * axial_stretch**2)
    )


def bending_pressure(stretch: float, thickness_ratio: float) -> float:
    """The plane-strain membrane's pressure plus the exact term of third order in T/R, neo-Hooke with mu = 1.

    Expansion of `thick_pressure`: (x - 1)(x + 3)(x^2 - 2 x + 4) / (12 x^4) (T/R)^3 with x = l^2. A shell with
    bending of that order follows it; the remainder is O((T/R)^5).
    """
    x = stretch**2
    cubic = (x - 1.0) * (x + 3.0) * (x**2 - 2.0 * x + 4.0) / (12.0 * x**4)
    return membrane_pressure(stretch, thickness_ratio) + cubic * thickness_ratio**3


def membrane_stretch(
    pressure: float, thickness_ratio: float, law: Law | None = None, axial_stretch: float = 1.0
) -> float:
    """Inverse of `membrane_pressure`; raises ValueError at or above its supremum."""
    return increasing_root(
        lambda stretch: membrane_pressure(stretch, thickness_ratio, law, axial_stretch) - pressure,
        start=axial_stretch**-0.5,
    )


def thick_stretch(
    pressure: float, thickness_ratio: float, law: MooneyRivlin | None = None, axial_stretch: float = 1.0
) -> float:
    """Inverse of `thick_pressure` below its supremum (mu ln(R_out / R_in) at L = 1); ValueError above."""
    # By the stretch of the inner face, which may be any positive number: the bore never closes on the way.
    square = (1.0 - 0.5 * thickness_ratio) ** 2

    def middle(inner_stretch: float) -> float:
        return math.sqrt((1.0 + square * (axial_stretch * inner_stretch**2 - 1.0)) / axial_stretch)

    inner = increasing_root(
        lambda s: thick_pressure(middle(s), thickness_ratio, law, axial_stretch) - pressure,
        start=axial_stretch**-0.5,
    )
    return middle(inner)


def printed_pressure(
    stretch: float, thickness_ratio: float, pressure_top: float = 0.0, mu: float = 1.0
) -> float:
    """p_b - p_t as printed for the plane-strain neo-Hookean tube in the paper whose loads are corrected here.

    Ghosh, McBride, Liu, Heltai, Steinmann, Saxena, "An embedding-aware continuum thin shell formulation",
    sec. 5.2. It is roughly the exact pressure divided by the stretch, and has a limit point that the exact
    tube has not.
    """
    thin = 1.0 / stretch
    numerator = thickness_ratio * ((thin - 1.0) * pressure_top + mu * (1.0 - thin**4))
    return numerator / (0.5 * thickness_ratio * (thin - 1.0) + stretch)


def as_published_pressure(
    stretch: float, thickness_ratio: float, pressure_top: float = 0.0, law: Law | None = None
) -> float:
    """p_b - p_t of the plane-strain membrane under the load variant "as-published".

    The weak form of the paper named above: with the mean pressure weighted by the reference curvature H =
    -1/(2R), the virtual work of the faces per reference area is (p_b - p_t) l + (T/R) (1/l - 1) (p_t +
    p_b)/2, set equal to (T/R) W_hoop. It differs from the formula the paper prints (`printed_pressure`) by
    the factor l on the elastic term and the sign of the one with p_t.
    """
    excess = thickness_ratio * (1.0 / stretch - 1.0)
    elastic = membrane_pressure(stretch, thickness_ratio, law) * stretch
    return (elastic - excess * pressure_top) / (stretch + 0.5 * excess)


def membrane_slope(stretch: float, thickness_ratio: float, law: MooneyRivlin | None = None) -> float:
    """Derivative of `membrane_pressure` in plane strain: 4 m (T/R) l^-5, m the shear modulus."""
    return 4.0 * (law or neo_hookean()).shear_modulus * thickness_ratio * stretch**-5


def thick_slope(stretch: float, thickness_ratio: float, law: MooneyRivlin | None = None) -> float:
    """Derivative of `thick_pressure` in plane strain; always positive: no limit point."""
    inner, outer = face_stretches(stretch, thickness_ratio)

    def rate(s: float, radius: float) -> float:
        return (1.0 / s + s**-3) * stretch / (radius**2 * s)

    difference = rate(inner, 1.0 - 0.5 * thickness_ratio) - rate(outer, 1.0 + 0.5 * thickness_ratio)
    return (law or neo_hookean()).shear_modulus * difference
