"""Kirchhoff plates at small deflection: circular and rectangular, closed forms and Navier's series.

S. Timoshenko and S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed. (1959), ch. 3 (circular), ch. 5
(Navier). D = E T^3 / (12 (1 - nu^2)); an incompressible plate has E = 3 mu, nu = 1/2, D = mu T^3 / 3. Deflections
are positive along the load; every result is linear in it.
"""

from __future__ import annotations

import math

# Deflection of the centre of a clamped square plate under uniform load, w D / (q a^4): R. L. Taylor and
# S. Govindjee, Commun. Numer. Meth. Engng 20 (2004) 757-765; 0.00126 in Timoshenko's table 35.
CLAMPED_SQUARE = 0.00126532


def stiffness(young: float, thickness: float, poisson_ratio: float) -> float:
    """D = E T^3 / (12 (1 - nu^2))."""
    return young * thickness**3 / (12.0 * (1.0 - poisson_ratio**2))


def clamped_circle(r: float, load: float, radius: float, stiffness: float) -> float:
    """Deflection at r under the pressure `load`, rim clamped: q (a^2 - r^2)^2 / (64 D)."""
    return load * (radius**2 - r**2) ** 2 / (64.0 * stiffness)


def clamped_circle_moments(r: float, load: float, radius: float, poisson_ratio: float) -> tuple[float, float]:
    """Radial and hoop moment per length at r under the pressure `load`, positive for tension on the far face."""
    nu = poisson_ratio
    return (
        load / 16.0 * ((1.0 + nu) * radius**2 - (3.0 + nu) * r**2),
        load / 16.0 * ((1.0 + nu) * radius**2 - (1.0 + 3.0 * nu) * r**2),
    )


def supported_circle(r: float, load: float, radius: float, stiffness: float, poisson_ratio: float) -> float:
    """Deflection at r under the pressure `load`, rim simply supported: q (a^2-r^2) (c a^2-r^2) / (64 D).

    c = (5 + nu) / (1 + nu).
    """
    factor = (5.0 + poisson_ratio) / (1.0 + poisson_ratio)
    return load * (radius**2 - r**2) * (factor * radius**2 - r**2) / (64.0 * stiffness)


def clamped_circle_point(r: float, force: float, radius: float, stiffness: float) -> float:
    """Deflection at r under a force on the centre, rim clamped: F a^2 / (16 pi D) at r = 0."""
    log_term = 2.0 * r**2 * math.log(r / radius) if r > 0.0 else 0.0
    return force * (log_term + radius**2 - r**2) / (16.0 * math.pi * stiffness)


def supported_rectangle(
    x: float, y: float, load: float, sides: tuple[float, float], stiffness: float, terms: int = 200
) -> float:
    """Deflection at (x, y), origin in a corner, under the pressure `load`, edges simply supported.

    Navier: 16 q / (pi^6 D) sum over odd m, n of sin(m pi x/a) sin(n pi y/b) / (m n (m^2/a^2 + n^2/b^2)^2), all
    m, n < 2 `terms`; the remainder falls like terms^-4. Centre of a square: 0.00406235 q a^4 / D.
    """
    a, b = sides
    total = 0.0
    for m in range(1, 2 * terms, 2):
        for n in range(1, 2 * terms, 2):
            wave = math.sin(m * math.pi * x / a) * math.sin(n * math.pi * y / b)
            total += wave / (m * n * ((m / a) ** 2 + (n / b) ** 2) ** 2)
    return 16.0 * load * total / (math.pi**6 * stiffness)


def supported_rectangle_point(force: float, sides: tuple[float, float], stiffness: float, terms: int = 200) -> float:
    """Deflection of the centre under a force there, edges simply supported.

    4 F / (pi^4 a b D) sum over odd m, n of (m^2/a^2 + n^2/b^2)^-2; the remainder falls like terms^-2. Square:
    0.01160 F a^2 / D.
    """
    a, b = sides
    odd = range(1, 2 * terms, 2)
    total = sum(((m / a) ** 2 + (n / b) ** 2) ** -2 for m in odd for n in odd)
    return 4.0 * force * total / (math.pi**4 * a * b * stiffness)


def strip(load: float, length: float, stiffness: float, clamped: bool) -> float:
    """Deflection of the middle of a long strip in cylindrical bending, both long edges alike.

    q L^4 / (384 D) clamped, 5 q L^4 / (384 D) simply supported.
    """
    return (1.0 if clamped else 5.0) * load * length**4 / (384.0 * stiffness)
