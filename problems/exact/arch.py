"""The shallow sinusoidal arch: snap-through at a limit point or by sideways bifurcation, in closed form.

Y. C. Fung and A. Kaplan, NACA TN 2840 (1952). Pinned ends at rest, a rise a0 sin(pi x / L), a dead downward load
P sin(pi x / L) per length. With the radius of gyration g = (I/A)^(1/2) and the shape y = 2 g [b1 sin(pi x / L) +
b2 sin(2 pi x / L)], the shallow (Marguerre) energy is exact in these two terms:

    Q = b0 - b1 - b1 (b1^2 + 4 b2^2 - b0^2),    b2 (4 + b1^2 + 4 b2^2 - b0^2) = 0,

b0 = a0 / (2 g), Q = P (L/pi)^4 / (2 g EI). A strip of thickness T has g = T / 12^(1/2), EI/EA = g^2 in plane
stress and plane strain alike. A fully nonlinear strip tends to it as a0/L does to 0, with error O((a0/L)^2).
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Critical(NamedTuple):
    """A critical point of the symmetric path: the remaining rise b1 and the load Q."""

    rise: float
    load: float


def load(rise: float, initial_rise: float) -> float:
    """Q that holds the symmetric shape b1 = `rise` of an arch with b0 = `initial_rise`."""
    return initial_rise - rise - rise * (rise**2 - initial_rise**2)


def limit_point(initial_rise: float) -> Critical | None:
    """Where the load of the symmetric path has its maximum: b1^2 = (b0^2 - 1)/3. None for b0 <= 1: no snap."""
    if initial_rise <= 1.0:
        return None
    rise = math.sqrt((initial_rise**2 - 1.0) / 3.0)
    return Critical(rise, load(rise, initial_rise))


def lower_limit_point(initial_rise: float) -> Critical | None:
    """The minimum of the load, after the snap."""
    upper = limit_point(initial_rise)
    return Critical(-upper.rise, load(-upper.rise, initial_rise)) if upper else None


def bifurcation_point(initial_rise: float) -> Critical | None:
    """Where the unsymmetric branch leaves the symmetric path: b1^2 = b0^2 - 4, Q = b0 + 3 b1. None for b0 <= 2.

    It comes before the limit point if b0 > 5.5^(1/2).
    """
    if initial_rise <= 2.0:
        return None
    rise = math.sqrt(initial_rise**2 - 4.0)
    return Critical(rise, initial_rise + 3.0 * rise)


def unsymmetric(rise: float, initial_rise: float) -> tuple[float, float]:
    """(b2, Q) of the unsymmetric branch at b1 = `rise`, |b1| below the bifurcation's; Q = b0 + 3 b1."""
    return 0.5 * math.sqrt(initial_rise**2 - 4.0 - rise**2), initial_rise + 3.0 * rise


def scaled_load(load: float, length: float, thickness: float, bending: float) -> float:
    """Amplitude P per length of the load for Q = `load`, strip of thickness T and bending stiffness EI."""
    return load * 2.0 * thickness / math.sqrt(12.0) * bending * (math.pi / length) ** 4
