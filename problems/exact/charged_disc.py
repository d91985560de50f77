"""A thin conducting disc at a voltage in free space: charge, potential, and the force on its rim.

Radius R in the plane z = 0 (W. R. Smythe, Static and Dynamic Electricity (1950), sec. 5.03). The charge density goes
as the inverse root of the distance from the rim: the rim is pulled outwards by a finite force per length, as a crack
tip is, though every point of the faces is pulled along their normals only.
"""

from __future__ import annotations

import math

from problems.exact.capacitance import disc


def charge_density(rho: float, radius: float, voltage: float, permittivity: float = 1.0) -> float:
    """Charge per area of both sides together: 4 eps V / (pi (R^2 - rho^2)^(1/2))."""
    return 4.0 * permittivity * voltage / (math.pi * math.sqrt(radius**2 - rho**2))


def potential(rho: float, z: float, radius: float, voltage: float) -> float:
    """(2 V / pi) arccot(h), h the oblate coordinate: 2 R^2 h^2 = d + (d^2 + 4 R^2 z^2)^(1/2), d = rho^2 + z^2 - R^2."""
    excess = rho**2 + z**2 - radius**2
    root = math.hypot(excess, 2.0 * radius * z)
    square = 0.5 * (excess + root) if excess > 0.0 else 2.0 * (radius * z) ** 2 / (root - excess or 1.0)
    return 2.0 * voltage / math.pi * math.atan2(radius, math.sqrt(square))


def edge_force(radius: float, voltage: float, permittivity: float = 1.0) -> float:
    """Outward pull per length of rim: 2 eps V^2 / (pi R), which is dC/dR V^2 / 2 over 2 pi R."""
    return radial_force(voltage, permittivity) / (2.0 * math.pi * radius)


def radial_force(voltage: float, permittivity: float = 1.0) -> float:
    """Derivative of the energy at held voltage with the radius, dC/dR V^2 / 2 = 4 eps V^2, C = 8 eps R."""
    return 0.5 * disc(1.0, permittivity) * voltage**2
