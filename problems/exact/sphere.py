"""Inflation of a spherical balloon: membrane and exact thick-walled sphere.

The stretch is that of the material mid-surface, r / R for the particles that start at the mid radius R, in
both theories. `pressure` is p_b - p_t, inside minus outside; nothing else matters for a closed incompressible
shell.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

from scipy.integrate import quad

from problems.exact.material import Law, MooneyRivlin, neo_hookean
from problems.exact.roots import bracketed_root, complex_slope, increasing_root, sign_changes

Theory = Literal["membrane", "thick"]


class LimitPoint(NamedTuple):
    """A turning point of a load: the stretch there and the load's value."""

    stretch: float
    load: float


def face_stretches(stretch: float, thickness_ratio: float) -> tuple[float, float]:
    """Hoop stretches (inner, outer) of the faces: r^3 - R^3 is the same for all particles.

    Raises ValueError for a stretch so small that the cavity is closed.
    """
    inner, outer = 1.0 - 0.5 * thickness_ratio, 1.0 + 0.5 * thickness_ratio
    added = stretch**3 - 1.0
    if inner**3 + added <= 0.0:
        raise ValueError(f"the cavity is closed at stretch {stretch:.6g}")
    return (1.0 + added / inner**3) ** (1.0 / 3.0), (1.0 + added / outer**3) ** (1.0 / 3.0)


def mid_stretch(inner_stretch: float, thickness_ratio: float) -> float:
    """Stretch of the mid-surface at a hoop stretch of the inner face."""
    return float((1.0 + (1.0 - 0.5 * thickness_ratio) ** 3 * (inner_stretch**3 - 1.0)) ** (1.0 / 3.0))


def membrane_pressure(stretch: float, thickness_ratio: float, law: Law | None = None) -> float:
    """p = (T/R) W'(l) / l^2 with W(l) for stretches (l, l, l^-2): 2 mu (T/R) (l^-1 - l^-7) for neo-Hooke.

    Green and Adkins, Large Elastic Deformations (membrane theory).
    """
    law = law or neo_hookean()
    return 2.0 * thickness_ratio * law.stress_difference(stretch, stretch**-2) / stretch**3


def membrane_slope(stretch: float, thickness_ratio: float, law: Law | None = None) -> float:
    """Derivative of `membrane_pressure` with respect to the stretch, to rounding."""
    return complex_slope(lambda s: membrane_pressure(s, thickness_ratio, law), stretch)


def _rate(stretch: float, law: Law) -> float:
    """W'(s) / (s^3 - 1) with W(s) for stretches (s, s, s^-2); 4 c1 (s^-2 + s^-5) + 4 c2 (1 + s^-3) by Mooney-Rivlin."""
    if isinstance(law, MooneyRivlin):
        return 4.0 * law.c1 * (stretch**-2 + stretch**-5) + 4.0 * law.c2 * (1.0 + stretch**-3)

    def difference(s: complex) -> complex:
        return law.stress_difference(s, s**-2)

    if abs(stretch - 1.0) < 1e-5:  # the mean slope by that in the middle: relative error 1e-10
        slope = complex_slope(difference, 0.5 * (1.0 + stretch))
    else:
        slope = difference(stretch) / (stretch - 1.0)
    return 2.0 * slope / (stretch * (stretch**2 + stretch + 1.0))


def thick_pressure(stretch: float, thickness_ratio: float, law: Law | None = None) -> float:
    """Exact pressure of the thick sphere: integral of W'(s) / (s^3 - 1) from outer to inner face stretch.

    Radial equilibrium with the hoop stretch as variable (Haughton and Ogden, J. Mech. Phys. Solids 26 (1978)
    111-138). In closed form for Mooney-Rivlin, by quadrature for other laws.
    """
    law = law or neo_hookean()
    inner, outer = face_stretches(stretch, thickness_ratio)
    if not isinstance(law, MooneyRivlin):
        return float(quad(_rate, outer, inner, args=(law,), epsabs=0.0, epsrel=1e-12)[0])

    def primitive(s: float) -> float:
        return 4.0 * law.c1 * (-1.0 / s - 0.25 * s**-4) + 4.0 * law.c2 * (s - 0.5 * s**-2)

    return primitive(inner) - primitive(outer)


def bending_pressure(stretch: float, thickness_ratio: float) -> float:
    """The membrane's pressure plus the exact term of third order in T/R, neo-Hooke with mu = 1.

    Expansion of `thick_pressure`: -(x - 1)(x^2 + 14 x - 35) / (6 l^13) (T/R)^3 with x = l^3. A shell with bending
    of that order follows it; the remainder is O((T/R)^5).
    """
    x = stretch**3
    cubic = -(x - 1.0) * (x**2 + 14.0 * x - 35.0) / (6.0 * stretch**13)
    return membrane_pressure(stretch, thickness_ratio) + cubic * thickness_ratio**3


def thick_slope(stretch: float, thickness_ratio: float, law: Law | None = None) -> float:
    """Derivative of `thick_pressure` with respect to the mid-surface stretch."""
    law = law or neo_hookean()
    inner, outer = face_stretches(stretch, thickness_ratio)

    def rate(s: float, radius: float) -> float:
        return _rate(s, law) * stretch**2 / (radius**3 * s**2)

    return rate(inner, 1.0 - 0.5 * thickness_ratio) - rate(outer, 1.0 + 0.5 * thickness_ratio)


def as_published_pressure(
    stretch: float, thickness_ratio: float, pressure_top: float = 0.0, law: Law | None = None
) -> float:
    """p_b - p_t of the membrane under the load variant "as-published", where it does depend on p_t.

    With the mean pressure weighted by the reference curvature H = -1/R, the virtual work of the faces per
    reference area is (p_b - p_t) l^2 + 2 (T/R) (1/l - 1) (p_t + p_b)/2, set equal to (T/R) W'(l). Consistent
    theory has no second term: for comparison only.
    """
    excess = 2.0 * thickness_ratio * (1.0 / stretch - 1.0)
    elastic = membrane_pressure(stretch, thickness_ratio, law) * stretch**2
    return (elastic - excess * pressure_top) / (stretch**2 + 0.5 * excess)


Curve = Callable[[float, float, Law | None], float]
PRESSURES: dict[Theory, tuple[Curve, Curve]] = {
    "membrane": (membrane_pressure, membrane_slope),
    "thick": (thick_pressure, thick_slope),
}


def limit_points(
    thickness_ratio: float, law: Law | None = None, theory: Theory = "thick", largest_stretch: float = 50.0
) -> tuple[LimitPoint, ...]:
    """Extrema of the pressure on 1 < stretch < `largest_stretch`: the maximum, then the minimum if any.

    Roots of the exact derivative. Membrane neo-Hooke: one maximum at 7^(1/6).
    """
    pressure, slope = PRESSURES[theory]
    roots = sign_changes(lambda stretch: slope(stretch, thickness_ratio, law), 1.0, largest_stretch)
    return tuple(LimitPoint(root, pressure(root, thickness_ratio, law)) for root in roots)


def stretch_at(
    pressure: float, thickness_ratio: float, law: Law | None = None, theory: Theory = "thick"
) -> float:
    """Stretch on the first branch, from collapse to the first maximum of the pressure.

    Raises ValueError where the pressure exceeds that maximum.
    """
    curve, _ = PRESSURES[theory]

    def excess(stretch: float) -> float:
        return curve(stretch, thickness_ratio, law) - pressure

    limits = limit_points(thickness_ratio, law, theory)
    if limits and pressure > limits[0].load:
        raise ValueError(f"pressure {pressure:.6g} exceeds the limit {limits[0].load:.6g}")
    if limits and pressure > 0.0:
        return bracketed_root(excess, 1.0, limits[0].stretch)
    if theory == "membrane":
        return increasing_root(excess)
    # By the stretch of the inner face, which may be any positive number: the cavity never closes on the way.
    inner = increasing_root(lambda s: excess(mid_stretch(s, thickness_ratio)))
    return mid_stretch(inner, thickness_ratio)
