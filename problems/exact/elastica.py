"""The inextensible elastica: a cantilever under a dead transverse end force, or an end moment.

Length L, bending stiffness EI, clamped at s = 0 along x, the force F at s = L along y and fixed in direction:
EI t'' = -F cos t for the angle t of the tangent. Solved by elliptic integrals (Bisshopp and Drucker, Quart.
Appl. Math. 3 (1945) 272-275). With a = F L^2 / EI, m = (1 + sin t_L) / 2, sin f0 = (2 m)^(-1/2) and
sin^2 f = (1 + sin t) / (2 m):

    a^(1/2) s/L = F(f | m) - F(f0 | m),    y/L = s/L - 2 a^(-1/2) [E(f | m) - E(f0 | m)],
    x/L = (2/a)^(1/2) [sin(t_L)^(1/2) - (sin t_L - sin t)^(1/2)].

A shell strip has EI = E T^3 b / 12 if its long edges are free to contract, E T^3 b / (12 (1 - nu^2)) in plane
strain, E = 3 mu and nu = 1/2 if it is incompressible, and is inextensible in the limit of T/L to 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.special import ellipe, ellipeinc, ellipj, ellipkinc, ellipkm1

from problems.exact.roots import bracketed_root

Array = npt.NDArray[np.float64]
LARGEST_LOAD = 1000.0


class Tip(NamedTuple):
    """Of the free end, per length: how far it moves back along x, how far along y; its angle."""

    shortening: float
    deflection: float
    angle: float


def _load(gap: float) -> float:
    """a as a function of pi/2 - t_L."""
    complement = math.sin(0.5 * gap) ** 2
    start = math.asin(min(1.0, math.sqrt(0.5 / (1.0 - complement))))
    return float((ellipkm1(complement) - ellipkinc(start, 1.0 - complement)) ** 2)


def _gap(load: float) -> float:
    """Inverse of `_load`; ValueError for a load that is not in (0, LARGEST_LOAD]."""
    if not 0.0 < load <= LARGEST_LOAD:
        raise ValueError(f"load is {load:.6g}: F L^2 / EI must lie in (0, {LARGEST_LOAD:g}]")
    return math.exp(bracketed_root(lambda x: _load(math.exp(x)) - load, -40.0, math.log(0.5 * math.pi)))


def end_force(load: float) -> Tip:
    """The free end under the force `load` = F L^2 / EI > 0."""
    angle = 0.5 * math.pi - _gap(load)
    x, y, _ = shape_under_force(load, 1.0)
    return Tip(1.0 - float(x[0]), float(y[0]), angle)


def shape_under_force(load: float, s: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """(x, y)/L and angle of the particles at s/L in [0, 1] under the force `load` = F L^2 / EI > 0."""
    points = np.atleast_1d(np.asarray(s, dtype=np.float64))
    m = 1.0 - math.sin(0.5 * _gap(load)) ** 2
    start = math.asin(min(1.0, math.sqrt(0.5 / m)))
    root = math.sqrt(load)
    sn, _, _, amplitude = ellipj(ellipkinc(start, m) + root * points, m)
    amplitude = np.where(points == 1.0, 0.5 * math.pi, amplitude)  # a quarter period by definition of the load
    sn = np.where(points == 1.0, 1.0, sn)
    sine, tip = 2.0 * m * sn**2 - 1.0, 2.0 * m - 1.0
    second = np.where(points == 1.0, ellipe(m), ellipeinc(amplitude, m))
    y = points - 2.0 / root * (second - ellipeinc(start, m))
    x = math.sqrt(2.0 / load) * (math.sqrt(tip) - np.sqrt(np.maximum(tip - sine, 0.0)))
    return np.asarray(x), np.asarray(y.real), np.arcsin(np.clip(sine, -1.0, 1.0))


def end_moment(load: float) -> Tip:
    """The free end under the moment `load` = M L / EI: an arc of a circle, closed at 2 pi."""
    if load == 0.0:
        return Tip(0.0, 0.0, 0.0)
    return Tip(1.0 - math.sin(load) / load, 2.0 * math.sin(0.5 * load) ** 2 / load, load)
