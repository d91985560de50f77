"""Capacitances of conductors alone in space, and of pairs.

Charge over voltage, in units of `permittivity` times a length (per axial length for `coaxial_cylinders`). A thin
conductor has both its sides. W. R. Smythe, Static and Dynamic Electricity (1950), ch. V; J. C. Maxwell, A Treatise on
Electricity and Magnetism.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import gammaln, hyp2f1

FOUR_PI = 4.0 * math.pi


def sphere(radius: float, permittivity: float = 1.0) -> float:
    """4 pi eps R."""
    return FOUR_PI * permittivity * radius


def disc(radius: float, permittivity: float = 1.0) -> float:
    """8 eps R."""
    return 8.0 * permittivity * radius


def square(side: float, permittivity: float = 1.0) -> float:
    """0.3667892 * 4 pi eps a: boundary elements in the limit of small ones (F. H. Read, J. Comput. Phys. 133 (1997) 1).

    No closed form is known: the charge density grows as the inverse root of the distance from the edges, and as the
    power -0.703 of that from the corners.
    """
    return 0.3667892 * FOUR_PI * permittivity * side


def cube(edge: float, permittivity: float = 1.0) -> float:
    """0.6606782(1) * 4 pi eps a, by random walks (C.-O. Hwang, M. Mascagni, J. Appl. Phys. 95 (2004) 3798).

    No closed form is known: the charge density grows as the power -1/3 of the distance from the edges.
    """
    return 0.6606782 * FOUR_PI * permittivity * edge


def spherical_cap(radius: float, half_angle: float, permittivity: float = 1.0) -> float:
    """4 eps R (alpha + sin alpha): a bowl that its half angle alpha, seen from the centre, cuts from a sphere.

    Lord Kelvin (1869). alpha = pi/2 is the hemisphere, pi the sphere.
    """
    return 4.0 * permittivity * radius * (half_angle + math.sin(half_angle))


def spheroid(equatorial: float, polar: float, permittivity: float = 1.0) -> float:
    """Half axes (a, a, c): 4 pi eps e / artanh(e/c) if prolate, 4 pi eps e / acos(c/a) if oblate, e^2 = |c^2 - a^2|."""
    focus = math.sqrt(abs(polar**2 - equatorial**2))
    if focus == 0.0:
        return sphere(equatorial, permittivity)
    turn = math.atanh(focus / polar) if polar > equatorial else math.acos(polar / equatorial)
    return FOUR_PI * permittivity * focus / turn


def torus(ring_radius: float, tube_radius: float, permittivity: float = 1.0) -> float:
    """A ring torus, R > r: 8 eps c [Q_{-1/2} / P_{-1/2} + 2 sum over n > 0 of Q_{n-1/2} / P_{n-1/2}] at R/r.

    c^2 = R^2 - r^2; Legendre functions of half-integer degree (E. W. Hobson, Spherical and Ellipsoidal Harmonics, art.
    254), here as hypergeometric functions of exp(-2 eta), cosh eta = R/r. Raises ValueError unless R > r.
    """
    if not 0.0 < tube_radius < ring_radius:
        raise ValueError(f"need 0 < tube_radius < ring_radius, got {tube_radius:.6g} and {ring_radius:.6g}")
    eta = math.acosh(ring_radius / tube_radius)
    n = np.arange(int(20.0 / eta) + 2)
    far = math.exp(-2.0 * eta)
    q = math.sqrt(math.pi) * np.exp(gammaln(n + 0.5) - gammaln(n + 1.0)) * hyp2f1(0.5, n + 0.5, n + 1.0, far)
    p = hyp2f1(0.5, 0.5 - n, 1.0, 1.0 - far)
    terms = q / p * np.exp(-2.0 * n * eta)
    focus = math.sqrt(ring_radius**2 - tube_radius**2)
    return float(8.0 * permittivity * focus * (2.0 * terms.sum() - terms[0]))


def concentric_spheres(inner: float, outer: float, permittivity: float = 1.0) -> float:
    """4 pi eps / (1/a - 1/b)."""
    return FOUR_PI * permittivity / (1.0 / inner - 1.0 / outer)


def coaxial_cylinders(inner: float, outer: float, permittivity: float = 1.0) -> float:
    """2 pi eps / ln(b/a) per axial length."""
    return 2.0 * math.pi * permittivity / math.log(outer / inner)


def parallel_discs(radius: float, gap: float, permittivity: float = 1.0, points: int = 400) -> float:
    """Two thin equal discs face to face at opposite potentials: charge over the difference, with all fringes.

    E. R. Love, Quart. J. Mech. Appl. Math. 2 (1949) 428: C = 2 eps R times the integral of f over (-1, 1), where
    f(x) less the integral of k f(t) / (pi (k^2 + (x - t)^2)) is 1, k = gap/R. By Gauss points: to rounding for gaps
    above R/20.
    """
    nodes, weights = np.polynomial.legendre.leggauss(points)
    ratio = gap / radius
    kernel = ratio / (math.pi * (ratio**2 + (nodes[:, None] - nodes[None, :]) ** 2))
    density = np.linalg.solve(np.eye(points) - kernel * weights[None, :], np.ones(points))
    return float(2.0 * permittivity * radius * (weights @ density))
