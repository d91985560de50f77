"""Open tube: pressures on both faces, traction-free ends, free axial stretch.

Here the mean of the two face pressures does change the answer: it squeezes the wall, so that the tube grows
longer. The hoop stretch is that of the material mid-surface; pressures are those on the inner (bottom) and
outer (top) face.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from problems.exact import cylinder
from problems.exact.material import MooneyRivlin, neo_hookean

Pressures = Callable[[float, float], tuple[float, float]]
Vector = NDArray[np.float64]


def exact_pressures(
    hoop_stretch: float, axial_stretch: float, thickness_ratio: float, law: MooneyRivlin | None = None
) -> tuple[float, float]:
    """(inner, outer) pressures that hold the tube at the two stretches without axial force, exact.

    The difference is `cylinder.thick_pressure`. Zero resultant on the ends: with r sigma_rr' = sigma_tt -
    sigma_rr and one integration by parts, N / 2 pi = (p_in a^2 - p_out b^2) / 2 + integral of [(sigma_zz -
    sigma_rr) - (sigma_tt - sigma_rr) / 2] r dr over the deformed wall a < r < b; the squares of the stretches
    are integrated in closed form with L r^2 = R^2 + k. (Radial equilibrium as in Haughton and Ogden 1979.)
    """
    law = law or neo_hookean()
    difference = cylinder.thick_pressure(hoop_stretch, thickness_ratio, law, axial_stretch)
    inner, outer = 1.0 - 0.5 * thickness_ratio, 1.0 + 0.5 * thickness_ratio
    added = axial_stretch * hoop_stretch**2 - 1.0
    inner_square = (inner**2 + added) / axial_stretch
    outer_square = (outer**2 + added) / axial_stretch
    area = 0.5 * (outer_square - inner_square)
    radial = area / axial_stretch - added / axial_stretch**2 * 0.5 * math.log(outer_square / inner_square)
    hoop = (0.5 * (outer**2 - inner**2) + added * math.log(outer / inner)) / axial_stretch**2
    force = (
        2.0 * law.c1 * (axial_stretch**2 * area - radial)
        - 2.0 * law.c2 * (axial_stretch**-2 * area - axial_stretch**2 * hoop)
        - (law.c1 + law.c2 * axial_stretch**2) * (hoop - radial)
    )
    outside = (difference * inner_square + 2.0 * force) / (outer_square - inner_square)
    return outside + difference, outside


def membrane_pressures(
    hoop_stretch: float, axial_stretch: float, thickness_ratio: float, law: MooneyRivlin | None = None
) -> tuple[float, float]:
    """(inner, outer) pressures in the shell theory with loads on the true faces, first order in T.

    Virtual work of the hoop stretch gives the difference (`cylinder.membrane_pressure`); that of the axial
    stretch is done by the mean pressure on the thinning wall and gives the mean, sigma_zz - sigma_nn = mu
    (axial^2 - normal^2).
    """
    law = law or neo_hookean()
    difference = cylinder.membrane_pressure(hoop_stretch, thickness_ratio, law, axial_stretch)
    mean = law.stress_difference(axial_stretch, 1.0 / (hoop_stretch * axial_stretch))
    return mean + 0.5 * difference, mean - 0.5 * difference


def exact_stretches(
    pressure_inner: float, pressure_outer: float, thickness_ratio: float, law: MooneyRivlin | None = None
) -> tuple[float, float]:
    """(hoop, axial) stretches of the three-dimensional tube; ValueError where none is found from rest."""
    return _stretches(
        lambda h, a: exact_pressures(h, a, thickness_ratio, law), pressure_inner, pressure_outer
    )


def membrane_stretches(
    pressure_inner: float, pressure_outer: float, thickness_ratio: float, law: MooneyRivlin | None = None
) -> tuple[float, float]:
    """(hoop, axial) stretches of the shell theory; ValueError where none is found from rest."""
    return _stretches(
        lambda h, a: membrane_pressures(h, a, thickness_ratio, law), pressure_inner, pressure_outer
    )


def _stretches(pressures: Pressures, inner: float, outer: float, steps: int = 8) -> tuple[float, float]:
    state = np.zeros(2)  # logarithms, so that the stretches stay positive
    for step in range(1, steps + 1):
        target = np.array([inner, outer]) * step / steps

        def residual(logs: Vector, target: Vector = target) -> Vector:
            return np.array(pressures(math.exp(logs[0]), math.exp(logs[1]))) - target

        found = root(residual, state, tol=1e-14)
        if float(np.max(np.abs(residual(found.x)))) > 1e-11 * (1.0 + abs(inner) + abs(outer)):
            raise ValueError(f"no equilibrium found at pressures {target[0]:.6g}, {target[1]:.6g}")
        state = found.x
    return math.exp(state[0]), math.exp(state[1])
