"""Referees of the shell theory, by codes of their own: thick walls as solids, and the membrane on a line.

Units: mid radius and shear modulus 1. All bodies are symmetric about the polar axis and about the equator;
for the ring (plane strain) the polar axis lies in its plane. Pressures are functions of c = cos(theta) at the
reference polar angle, given as arithmetic that works on numbers and on symbols, and even in c.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Profile = Callable[[Any], Any]
Array = NDArray[np.float64]

NINE_ANGLES: Array = np.linspace(0.0, 0.5 * np.pi, 9)


class MidSurface(NamedTuple):
    """Deformed mid-surface: reference polar angle, distance from the polar axis, height above the equator."""

    theta: Array
    r: Array
    z: Array

    def distance(self, other: MidSurface) -> float:
        """Largest distance between the same particles of two surfaces."""
        return float(np.max(np.hypot(self.r - other.r, self.z - other.z)))


class Loading(NamedTuple):
    """Pressures on the outer and the inner face."""

    p_top: Profile
    p_bottom: Profile


def constant(pressure: float) -> Profile:
    """The same pressure everywhere."""
    return lambda c: pressure


def referee_load(thickness_ratio: float, net: float = 1.0, mean: float = 0.3) -> Loading:
    """The load on which the theories part: p_b - p_t = net * T/R, (p_t + p_b)/2 = mean * cos(theta)^2.

    The mean pressure is several times the net one and varies along the surface, so its gradient, of the order
    T, is as strong as the net pressure. The deformation tends to a limit as the wall gets thin.
    """
    half = 0.5 * net * thickness_ratio
    return Loading(lambda c: mean * c * c - half, lambda c: mean * c * c + half)


def require_even(loading: Loading) -> None:
    """Raise ValueError for a pressure that is not symmetric about the equator."""
    for name, profile in zip(Loading._fields, loading, strict=True):
        if any(abs(profile(c) - profile(-c)) > 1e-12 for c in (0.2, 0.5, 0.9)):
            raise ValueError(f"{name} must be even in cos(theta)")
