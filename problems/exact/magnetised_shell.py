"""Remanent shells: uniformly magnetised spheres and tubes, and shells magnetised along their normal.

Uniform: `ThreeRegions` with a remanence. Without an applied field and with mu_r = 1 nothing is left in the cavity, and
the outside is that of a dipole of the moment (B_r/mu0) times the volume of the shell: two uniformly magnetised bodies
laid over each other. With mu_r > 1 a field of first order in T/R is left in the cavity.

Normal: a closed shell magnetised along its normal, constant B_r, has no field but within itself, H = -B_r/(mu0 mu_r) n
on the sphere and on the tube; the potential jumps across it, and every other closed shape does the same in the limit
of a thin wall (a closed double layer of constant strength).
"""

from __future__ import annotations

import math

from problems.exact.permeable_cylinder import PermeableCylinder
from problems.exact.permeable_sphere import PermeableSphere


def magnetised_sphere(
    thickness_ratio: float, relative_permeability: float = 1.0, remanence: float = 1.0
) -> PermeableSphere:
    """Shell of mid radius 1, remanence uniform along z, no applied field, mu0 = 1."""
    half = 0.5 * thickness_ratio
    return PermeableSphere(1.0 - half, 1.0 + half, relative_permeability, 0.0, 1.0, remanence)


def magnetised_tube(
    thickness_ratio: float, relative_permeability: float = 1.0, remanence: float = 1.0
) -> PermeableCylinder:
    """Tube of mid radius 1, remanence uniform across its axis, no applied field, mu0 = 1."""
    half = 0.5 * thickness_ratio
    return PermeableCylinder(1.0 - half, 1.0 + half, relative_permeability, 0.0, 1.0, remanence)


def saturated_sphere(thickness_ratio: float, saturation: float, applied_field: float) -> PermeableSphere:
    """A soft-magnetic shell far beyond saturation: M = M_s along the applied field everywhere, mu0 = 1.

    The limit of any law M(H) that saturates, for fields H0 well above M_s; below, the linear `permeable_sphere` with
    mu_r = 1 + chi is the limit of small fields.
    """
    half = 0.5 * thickness_ratio
    return PermeableSphere(1.0 - half, 1.0 + half, 1.0, applied_field, 1.0, saturation)


def potential_drop(
    thickness: float, remanence: float, relative_permeability: float = 1.0, permeability: float = 1.0
) -> float:
    """phi outside less phi in the cavity of a closed shell magnetised along its outward normal: B_r T / (mu0 mu_r)."""
    return remanence * thickness / (permeability * relative_permeability)


def cap_field_on_axis(rim_radius: float, height: float, strength: float) -> float:
    """H on the axis, `height` above the plane of the rim of a thin sheet magnetised along its normal.

    `strength` is M T, the magnetic moment per area. Outside a double layer of constant strength depends on its rim
    only, be the sheet a disc, a cap or a hemisphere: the field of a current M T around the rim, rho^2 M T / (2 s^3).
    """
    return 0.5 * strength * rim_radius**2 / math.hypot(rim_radius, height) ** 3


def disc_field_on_axis(radius: float, thickness: float, height: float, magnetisation: float) -> float:
    """B / mu0 on the axis of a disc of finite thickness, magnetised along its axis; `height` from its middle.

    M/2 [(z + T/2) / (R^2 + (z + T/2)^2)^(1/2) - (z - T/2) / (R^2 + (z - T/2)^2)^(1/2)], as of a solenoid.
    """
    up, down = height + 0.5 * thickness, height - 0.5 * thickness
    return 0.5 * magnetisation * (up / math.hypot(radius, up) - down / math.hypot(radius, down))
