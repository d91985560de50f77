"""Thin rings, columns and shells: pinched ring, and classical critical loads.

S. Timoshenko and J. Gere, Theory of Elastic Stability, 2nd ed. (1961); S. Timoshenko, Strength of Materials,
part 1 (pinched ring). Stiffnesses are per width: EI = D = E T^3 / (12 (1 - nu^2)) in plane strain.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

Ends = Literal["clamped-free", "pinned-pinned", "clamped-pinned", "clamped-clamped"]
# Roots of the stability conditions: critical load over EI / L^2. 4.4934094579 solves tan u = u.
COLUMNS: dict[Ends, float] = {
    "clamped-free": 0.25 * math.pi**2,
    "pinned-pinned": math.pi**2,
    "clamped-pinned": 4.493409457909064**2,
    "clamped-clamped": 4.0 * math.pi**2,
}


class PinchedRing(NamedTuple):
    """Changes of the two diameters: shortening along the forces, lengthening across."""

    along: float
    across: float


def pinched_ring(force: float, radius: float, stiffness: float) -> PinchedRing:
    """Inextensible circular ring under two opposite inward forces: 0.149 and 0.137 times F R^3 / EI."""
    scale = force * radius**3 / stiffness
    return PinchedRing((0.25 * math.pi - 2.0 / math.pi) * scale, (2.0 / math.pi - 0.5) * scale)


def ring_pressure(radius: float, stiffness: float, waves: int = 2) -> float:
    """Outer pressure at which a ring, or a long tube, buckles into n waves: (n^2 - 1) EI / R^3.

    The pressure follows the normal (Levy 1884). Extension before buckling is neglected: relative O((T/R)^2).
    """
    return (waves**2 - 1.0) * stiffness / radius**3


def column_force(length: float, stiffness: float, ends: Ends) -> float:
    """Euler's critical compressive force, dead, of an inextensible column or strip."""
    return COLUMNS[ends] * stiffness / length**2


def sphere_pressure(radius: float, thickness: float, young: float, poisson_ratio: float) -> float:
    """Classical pressure of a complete sphere, 2 E (T/R)^2 / (3 (1 - nu^2))^(1/2) (Zoelly 1915).

    Real spheres fail at a fraction of it, by imperfections: a perfect mesh can be compared, not an experiment.
    """
    return 2.0 * young * (thickness / radius) ** 2 / math.sqrt(3.0 * (1.0 - poisson_ratio**2))


def cylinder_stress(radius: float, thickness: float, young: float, poisson_ratio: float) -> float:
    """Classical axial stress of a moderately long tube, E T / (R (3 (1 - nu^2))^(1/2)); see `sphere_pressure`."""
    return young * thickness / (radius * math.sqrt(3.0 * (1.0 - poisson_ratio**2)))
