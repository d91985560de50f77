"""Bending boundary layer of a thin cylindrical shell at its edge, at small deflection.

S. Timoshenko and S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed. (1959), secs. 114-117: the radial
deflection w obeys D w'''' + E T w / R^2 = p, hence decays from an edge as exp(-b x) times cos and sin of b x with

    b = (3 (1 - nu^2))^(1/4) / (R T)^(1/2).

x is the distance from the edge of a semi-infinite tube, w positive outwards. The axial force is zero. Relative
error of the theory: O(T/R).
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Tube:
    """Semi-infinite tube of mid radius `radius`. Any consistent units."""

    radius: float
    thickness: float
    young: float
    poisson_ratio: float

    @property
    def decay(self) -> float:
        """b, per length."""
        return float((3.0 * (1.0 - self.poisson_ratio**2)) ** 0.25) / math.sqrt(self.radius * self.thickness)

    @property
    def stiffness(self) -> float:
        """D."""
        return self.young * self.thickness**3 / (12.0 * (1.0 - self.poisson_ratio**2))

    def free_edge(self, x: float, force: float = 0.0, moment: float = 0.0) -> float:
        """w(x) under an outward edge force and an edge moment per length; the moment alone lifts the edge.

        w(0) = Q / (2 b^3 D) + M / (2 b^2 D), w'(0) = -Q / (2 b^2 D) - M / (b D): D w'' = M, D w''' = Q at x = 0.
        """
        b = self.decay
        wave = force * math.cos(b * x) + b * moment * (math.cos(b * x) - math.sin(b * x))
        return math.exp(-b * x) * wave / (2.0 * b**3 * self.stiffness)

    def pressurised(self, x: float, pressure: float, edge: str = "clamped") -> float:
        """w(x) under an inner pressure, edge "clamped" or "supported" (w = 0, no moment)."""
        b = self.decay
        wave = math.cos(b * x) + (math.sin(b * x) if edge == "clamped" else 0.0)
        return pressure * self.radius**2 / (self.young * self.thickness) * (1.0 - math.exp(-b * x) * wave)
