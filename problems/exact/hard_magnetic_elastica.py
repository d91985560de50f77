"""A hard-magnetic cantilever in a uniform field, any angle between the field and its axis.

An inextensible beam of length L, clamped along x, carries a remanence B_r along its tangent (soft matter filled with
magnetised particles; own demagnetising field left out: it is of the order of thickness over length). A field B at the
angle alpha from x turns it: with the angle t of the tangent,

    EI t'' = A (B_r / mu0) B sin(t - alpha),    t(0) = 0,    t'(L) = 0

(R. Zhao, Y. Kim, S. A. Chester, P. Sharma, X. Zhao, J. Mech. Phys. Solids 124 (2019) 244). With the load
a = A (B_r/mu0) B L^2 / EI, q = pi - alpha + t and k = sin(q(L)/2), sin(q/2) = k sin f as of a pendulum:

    a^(1/2) s/L = F(f | k^2) - F(f0 | k^2),    f = pi/2 at the free end.

At alpha = pi/2 this is the cantilever under a dead transverse end force a: `elastica`. At alpha = pi (field against the
magnetisation) the beam stays straight up to the buckling load pi^2/4.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.special import ellipeinc, ellipj, ellipkinc, ellipkm1

from problems.exact.elastica import LARGEST_LOAD, Array, Tip
from problems.exact.roots import bracketed_root

BUCKLING = 0.25 * math.pi**2


def load(
    length: float, thickness: float, young: float, remanence: float, field: float, permeability: float = 4e-7 * math.pi
) -> float:
    """a = (B_r / mu0) B L^2 / (E T^2 / 12) of a rectangular beam, any width; E = 3 mu for a soft incompressible one."""
    return 12.0 * remanence * field * length**2 / (permeability * young * thickness**2)


def tip(load: float, field_angle: float = 0.5 * math.pi) -> Tip:
    """The free end; see `shape` for the arguments."""
    x, y, angle = shape(load, 1.0, field_angle)
    return Tip(1.0 - float(x[0]), float(y[0]), float(angle[0]))


def shape(load: float, s: npt.ArrayLike, field_angle: float = 0.5 * math.pi) -> tuple[Array, Array, Array]:
    """(x, y)/L and angle of the particles at s/L in [0, 1]; the buckled shape at alpha = pi beyond `BUCKLING`.

    Raises ValueError for a load outside [0, LARGEST_LOAD] or a field angle outside [0, pi].
    """
    if not (0.0 <= load <= LARGEST_LOAD and 0.0 <= field_angle <= math.pi):
        raise ValueError(f"load {load:.6g} and field_angle {field_angle:.6g} must lie in [0, 1000] and [0, pi]")
    points = np.atleast_1d(np.asarray(s, dtype=np.float64))
    straight = load == 0.0 or field_angle == 0.0 or (field_angle == math.pi and load <= BUCKLING)
    if straight:
        return points.copy(), np.zeros_like(points), np.zeros_like(points)
    half = _half_gap(load, field_angle)
    k, m, start = math.cos(half), math.cos(half) ** 2, _start(half, field_angle)
    first, root = float(ellipkinc(start, m)), math.sqrt(load)
    sn, cn, _, f = ellipj(first + root * points, m)
    end = points == 1.0  # a quarter period by definition of the load
    sn, cn, f = np.where(end, 1.0, sn), np.where(end, 0.0, cn), np.where(end, 0.5 * math.pi, f)
    along = points - 2.0 / root * (ellipeinc(f, m) - ellipeinc(start, m))  # along the field: integral of -cos q
    across = 2.0 * k / root * (math.cos(start) - cn)  # integral of sin q
    angle = np.where(end, field_angle - 2.0 * half, 2.0 * np.arcsin(k * sn) - math.pi + field_angle)
    cos, sin = math.cos(field_angle), math.sin(field_angle)
    return cos * along + sin * across, sin * along - cos * across, angle


def _start(half: float, field_angle: float) -> float:
    """f at the clamp: sin f0 = cos(alpha/2) / k."""
    return math.asin(min(1.0, math.cos(0.5 * field_angle) / math.cos(half)))


def _half_gap(load: float, field_angle: float) -> float:
    """Half the angle from the tangent at the free end to the field, (alpha - t(L))/2: of it the load is a function."""

    def excess(logarithm: float) -> float:
        half = math.exp(logarithm)
        remaining = float(ellipkm1(math.sin(half) ** 2) - ellipkinc(_start(half, field_angle), math.cos(half) ** 2))
        return remaining - math.sqrt(load)

    return math.exp(bracketed_root(excess, -40.0, math.log(0.5 * field_angle)))
