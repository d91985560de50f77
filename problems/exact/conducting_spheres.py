"""Two conducting spheres, a sphere before a plane, and the forces that pull hemispheres apart.

Radii a and b, centres c apart. Charges q1 = c11 V1 + c12 V2 and so on; the force that pushes the spheres apart is the
derivative of (c11 V1^2 + 2 c12 V1 V2 + c22 V2^2) / 2 with respect to c.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

from problems.exact.roots import complex_slope

LARGEST_ANGLE = 300.0  # sinh of it is 1e130: the terms beyond are nothing


class TwoSpheres(NamedTuple):
    """Coefficients of capacity, in units of permittivity times length."""

    c11: float
    c12: float
    c22: float


def _own(a: float, b: float, distance: complex) -> complex:
    """c11 / (4 pi eps): a b sinh u times the sum of 1 / (b sinh(n u) + a sinh((n-1) u)), n > 0."""
    u = _angle(a, b, distance)
    total: complex = 0.0
    for n in range(1, _terms(u)):
        total += 1.0 / (b * cmath.sinh(n * u) + a * cmath.sinh((n - 1) * u))
    return a * b * cmath.sinh(u) * total


def _mutual(a: float, b: float, distance: complex) -> complex:
    """c12 / (4 pi eps): -(a b / c) sinh u times the sum of 1 / sinh(n u)."""
    u = _angle(a, b, distance)
    total: complex = 0.0
    for n in range(1, _terms(u)):
        total += 1.0 / cmath.sinh(n * u)
    return -a * b / distance * cmath.sinh(u) * total


def _angle(a: float, b: float, distance: complex) -> complex:
    """cosh u = (c^2 - a^2 - b^2) / (2 a b); ValueError for spheres that touch."""
    if not distance.real > a + b:
        raise ValueError(f"the spheres touch: need a distance of the centres above {a + b:.6g}")
    return cmath.acosh((distance**2 - a**2 - b**2) / (2.0 * a * b))


def _terms(u: complex) -> int:
    return 2 + int(min(40.0 / u.real, 1e6)) if u.real < LARGEST_ANGLE else 2


def two_spheres(a: float, b: float, distance: float, permittivity: float = 1.0) -> TwoSpheres:
    """The coefficients by images (J. C. Maxwell, Treatise, art. 173; W. R. Smythe, sec. 5.08).

    Raises ValueError for spheres that touch.
    """
    scale = 4.0 * math.pi * permittivity
    own, mutual = _own(a, b, distance).real, _mutual(a, b, distance).real
    return TwoSpheres(scale * own, scale * mutual, scale * _own(b, a, distance).real)


def repulsion(a: float, b: float, distance: float, voltages: tuple[float, float], permittivity: float = 1.0) -> float:
    """Force that pushes the spheres apart at held voltages: half the derivative of V c V, exact."""
    first, second = voltages

    def energy(c: complex) -> complex:
        own = first**2 * _own(a, b, c) + second**2 * _own(b, a, c)
        return 2.0 * math.pi * permittivity * (own + 2.0 * first * second * _mutual(a, b, c))

    return complex_slope(energy, distance)


def sphere_and_plane(radius: float, height: float, permittivity: float = 1.0) -> float:
    """Capacitance to a grounded plane `height` h below the centre.

    4 pi eps R sinh m times the sum of 1 / sinh(k m), cosh m = h/R.
    """
    pair = two_spheres(radius, radius, 2.0 * height, permittivity)
    return pair.c11 - pair.c12


def attraction_to_plane(radius: float, height: float, voltage: float, permittivity: float = 1.0) -> float:
    """Force on the sphere towards the plane at a held voltage."""
    return -repulsion(radius, radius, 2.0 * height, (voltage, -voltage), permittivity)


def charged_hemispheres(voltage: float, permittivity: float = 1.0) -> float:
    """Force that pulls the halves of a sphere at a voltage apart: pi eps V^2 / 2 = Q^2 / (32 pi eps R^2).

    Lord Kelvin; J. D. Jackson, Classical Electrodynamics, sec. 2.
    """
    return 0.5 * math.pi * permittivity * voltage**2


def hemispheres_in_field(radius: float, applied_field: float, permittivity: float = 1.0) -> float:
    """Force that pulls the halves of a neutral sphere apart along a field: 9/4 pi eps R^2 E0^2 (Jackson, sec. 2.5)."""
    return 2.25 * math.pi * permittivity * radius**2 * applied_field**2


def sphere_pressure(
    angle: float, radius: float, applied_field: float, charge: float = 0.0, permittivity: float = 1.0
) -> float:
    """Outward pull on a conducting sphere: eps/2 (3 E0 cos(angle) + Q / (4 pi eps R^2))^2, the net force is Q E0."""
    normal = 3.0 * applied_field * math.cos(angle) + charge / (4.0 * math.pi * permittivity * radius**2)
    return 0.5 * permittivity * normal**2
