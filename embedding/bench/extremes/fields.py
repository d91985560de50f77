"""Scenes that several families push: shells held still or free in a field, and the closed forms they are held against.

Radii are 1 m and voltages 1 kV unless a family says otherwise; loads scale with the square of the field.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from embedding.scene.scales import EPSILON_0, MU_0

VOLTAGE = 1e3
STILL = [{"where": "surface", "fix": ["x", "y", "z"]}]
STIFF = {"law": "neo-hookean", "shear_modulus": 1e6}
SPHERE = {"kind": "sphere", "radius": 1.0}
CLOSED = {"interface": "closed"}
"""The closed forms have their field at the mid-surface."""


def conductor(shape: dict[str, Any], ambient: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """A scene of a thin conductor at 1 kV that keeps its shape."""
    return {
        "shell": {"shape": shape, "thickness": 1e-6, "material": STIFF},
        "supports": STILL,
        "ambient": {"field": "electric", **ambient},
        "faces": {"both": {"voltage": VOLTAGE}},
        "model": CLOSED,
        **changes,
    }


def sphere_charge(outer: float = math.inf) -> float:
    """Charge of a conducting sphere of radius 1 m at 1 kV in a grounded one (Jackson, Classical Electrodynamics)."""
    return 4 * math.pi * EPSILON_0 * VOLTAGE / (1.0 - 1.0 / outer)


def disc_charge() -> float:
    """Charge of a conducting disc of radius 1 m at 1 kV, 8 eps0 R V; Jackson, sec. 3.13."""
    return 8 * EPSILON_0 * VOLTAGE


def disc_charge_over(gap: float) -> float:
    """The same over a grounded plane, for a small ``gap``: two discs at twice the gap by Kirchhoff (Landau and
    Lifshitz, Electrodynamics of Continuous Media, sec. 3), with the next term in the gap (S. J. N. Shaw, Phys. Fluids
    13 (1970) 1935)."""
    log = math.log(8 * math.pi / gap)
    return EPSILON_0 * VOLTAGE * (math.pi / gap + 2 * (log - 1) + gap / math.pi * (log**2 - 2))


class Faces(NamedTuple):
    """Means of p_t and p_b over the shell, Pa."""

    top: float
    bottom: float


def shell_in_a_field(dimension: int, ratio: float, contrast: float, field: float, *, electric: bool) -> Faces:
    """Pressures on a linear spherical (``dimension`` 3) or cylindrical (2) shell of mid-surface radius 1 m and
    thickness ``ratio`` in a uniform ``field``.

    Potential of the shell of three regions, Jackson, eq. 5.121 and its like for the cylinder; p = eps (E_t^2 - E_n^2)/2
    on either face. Denominators are arranged so that nothing cancels.
    """
    inner, outer, permittivity = 1.0 - 0.5 * ratio, 1.0 + 0.5 * ratio, EPSILON_0 if electric else MU_0
    d = dimension
    thick = -math.expm1(d * math.log(inner / outer))  # 1 - (a/b)^d
    if d == 3:
        below = 9 * contrast + 2 * thick * (contrast - 1) ** 2
        dipole = (2 * contrast + 1) * (contrast - 1) * thick / below
        within = 9 * contrast / below
    else:
        below = 4 * contrast + thick * (contrast - 1) ** 2
        dipole = (contrast**2 - 1) * thick / below
        within = 4 * contrast / below
    normal, along = 1 + (d - 1) * dipole, -1 + dipole
    share = 1 / d  # of cos^2 over the sphere or the circle; the rest is that of sin^2
    half = 0.5 * permittivity * field**2
    return Faces(half * ((1 - share) * along**2 - share * normal**2), half * (1 - 2 * share) * within**2)


R, T, MU = 0.02, 1e-3, 3e4
RUBBER = {"law": "neo-hookean", "shear_modulus": MU}
BALLOON = {"shape": {"kind": "sphere", "radius": R}, "thickness": T, "material": RUBBER}
GROUND = 4.0
"""Radius of the grounded sphere around the balloon, in radii at rest."""


def charged(drive: dict[str, float], *, grounded: bool = False, **changes: Any) -> dict[str, Any]:
    """A balloon with a voltage or a charge, in open space or in a grounded sphere."""
    around = {"outer": "grounded", "radius": GROUND * R} if grounded else {}
    return {
        "shell": BALLOON,
        "ambient": {"field": "electric", **around},
        "faces": {"both": drive},
        "model": CLOSED,
        **changes,
    }


def balloon_voltage(load: float) -> float:
    """Voltage at which w = eps0 V^2 / (4 mu T R) is the ``load``."""
    return math.sqrt(load * 4 * MU * T * R / EPSILON_0)


PULL_IN = 0.541797260201
"""w = (l - l^-5)(1 - l/4)^2 of a charged neo-Hookean membrane in a grounded sphere of 4 radii is largest at the stretch
1.61644100288: the pull of eps E^2/2, E = V R_o / (b (R_o - b)), against the tension of an inflated sphere."""


def balloon_strain(load: float) -> float:
    """l - 1 of the balloon at a voltage in open space: l - l^-5 = w."""
    strain = load / 6
    for _ in range(60):
        # (1 + e)^-5 - 1 by expm1 and log1p, so that a strain of 1e-13 keeps its digits
        residual = strain - math.expm1(-5 * math.log1p(strain)) - load
        strain -= residual / (1 + 5 * (1 + strain) ** -6)
    return strain
