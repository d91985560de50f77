"""A line current beside a permeable tube or cylinder, and along the axis of a tube that may saturate.

Beside: current I along z at the distance c from the axis of a tube of radii a < b < c, plane problem. For r < c the
applied H = -grad phi has phi = sum over n of I / (2 pi n) (r/c)^n sin(n t), t the angle from the line to the wire;
the tube answers outside with -I / (2 pi n) k_n b^(2n) / (c r)^n sin(n t), where

    k_n = k (1 - q) / (1 - k^2 q),    k = (mu_r - 1)/(mu_r + 1),    q = (a/b)^(2n).

A solid cylinder has k_n = k: image currents k I at b^2/c and -k I on the axis (W. R. Smythe, Static and Dynamic
Electricity (1950), sec. 7.22, 7.23).

On the axis: H = I / (2 pi r) around, whatever the matter: exact for any law M(H). The vacuum pushes on both faces with
mu0 H^2 / 2, and the tube is squeezed as by a pressure mu0 times the integral of M H dr/r over its wall.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad


@dataclass(frozen=True)
class TubeBesideCurrent:
    """Inner radius 0 is the solid cylinder. Raises ValueError unless 0 <= a < b < c."""

    inner_radius: float
    outer_radius: float
    relative_permeability: float
    distance: float
    current: float = 1.0
    permeability: float = 1.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.inner_radius < self.outer_radius < self.distance:
            got = f"{self.inner_radius:.6g}, {self.outer_radius:.6g}, {self.distance:.6g}"
            raise ValueError(f"need 0 <= inner_radius < outer_radius < distance, got {got}")

    def _orders(self) -> tuple[np.ndarray, np.ndarray]:
        """n and k_n, until (b/c)^n is below rounding."""
        n = np.arange(1.0, 3.0 + math.ceil(40.0 / math.log(self.distance / self.outer_radius)))
        k = (self.relative_permeability - 1.0) / (self.relative_permeability + 1.0)
        q = (self.inner_radius / self.outer_radius) ** (2.0 * n)
        return n, k * (1.0 - q) / (1.0 - k**2 * q)

    @property
    def force(self) -> float:
        """Force per length that draws the tube towards the wire: mu0 I^2 / (2 pi c) times the sum of k_n (b/c)^(2n).

        Solid: mu0 I^2 k b^2 / (2 pi c (c^2 - b^2)).
        """
        n, k = self._orders()
        series = float(np.sum(k * (self.outer_radius / self.distance) ** (2.0 * n)))
        return self.permeability * self.current**2 / (2.0 * math.pi * self.distance) * series

    def field_at(self, radius: float, angle: float) -> tuple[float, float]:
        """(H_r, H_t) in the vacuum, on and outside the outer face or in the cavity; ValueError within the wall."""
        if self.inner_radius < radius < self.outer_radius:
            raise ValueError(f"radius {radius:.6g} lies within the wall")
        n, k = self._orders()
        if radius <= self.inner_radius:
            inside = -self._shielding(n) * (radius / self.distance) ** n
            radial, along = inside, inside
        else:
            answer = k * (self.outer_radius**2 / (radius * self.distance)) ** n
            radial, along = -answer, answer
        scale = self.current / (2.0 * math.pi * radius)
        own = scale * float(radial @ np.sin(n * angle)), scale * float(along @ np.cos(n * angle))
        if radius <= self.inner_radius:
            return own
        # The wire's own field, I / (2 pi s) around it: its series converges slowly near by.
        c, square = self.distance, radius**2 + self.distance**2 - 2.0 * radius * self.distance * math.cos(angle)
        strength = self.current / (2.0 * math.pi * square)
        return own[0] - strength * c * math.sin(angle), own[1] + strength * (radius - c * math.cos(angle))

    def _shielding(self, n: np.ndarray) -> np.ndarray:
        """Field in the cavity over the applied one: 4 mu / [(mu + 1)^2 - (a/b)^(2n) (mu - 1)^2]."""
        mu, q = self.relative_permeability, (self.inner_radius / self.outer_radius) ** (2.0 * n)
        return 4.0 * mu / ((mu + 1.0) ** 2 - q * (mu - 1.0) ** 2)


def squeeze(
    inner_radius: float,
    outer_radius: float,
    current: float,
    magnetisation: Callable[[float], float],
    permeability: float = 1.0,
) -> float:
    """Inflating pressure that balances the magnetic forces on a tube around a line current; deformed radii.

    mu0 times the integral of M(H) H dr/r, H = I / (2 pi r): radial balance of the total stress B H - w*, with w* the
    co-energy and the vacuum's mu0 H^2/2 at the faces. For M = chi H: mu0 chi/2 (H_a^2 - H_b^2).
    """

    def rate(radius: float) -> float:
        field = current / (2.0 * math.pi * radius)
        return magnetisation(field) * field / radius

    return permeability * float(quad(rate, inner_radius, outer_radius, epsabs=0.0, epsrel=1e-12)[0])


def saturating(susceptibility: float, saturation: float) -> Callable[[float], float]:
    """The law M = M_s tanh(chi H / M_s)."""
    return lambda field: saturation * math.tanh(susceptibility * field / saturation)
