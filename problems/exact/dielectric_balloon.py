"""A dielectric elastomer balloon: a thin or thick spherical wall with an electrode on each face."""

from __future__ import annotations

import math
from dataclasses import dataclass

from problems.exact.charged_balloon import ChargedBalloon
from problems.exact.dielectric_shell import DielectricShell


@dataclass(frozen=True)
class DielectricBalloon(DielectricShell):
    """Spherical case of `dielectric_shell`.

    Thick (A. Dorfmann, R. W. Ogden, Int. J. Eng. Sci. 85 (2014) 163): E = k / r^2 with k = U / (1/a - 1/b), hence
    squeeze = eps/2 (E_a^2 - E_b^2) / U^2. Membrane (J. Zhu, S. Cai, Z. Suo, Polym. Int. 59 (2010) 378), neo-Hooke:
    p R / (mu T) = 2 (l^-1 - l^-7) - 2 eps U^2 l / (mu T^2).
    """

    @property
    def conductor(self) -> ChargedBalloon:
        return ChargedBalloon(self.radius, self.thickness, self.law, self.vacuum, self.outer_radius, self.theory)

    def _faces(self, stretch: complex) -> tuple[complex, complex, complex]:
        added = self.radius**3 * (stretch**3 - 1.0)
        within, outside = self.radius - 0.5 * self.thickness, self.radius + 0.5 * self.thickness
        inner, outer = (within**3 + added) ** (1.0 / 3.0), (outside**3 + added) ** (1.0 / 3.0)
        return inner, outer, (outside**3 - within**3) / (inner**2 + inner * outer + outer**2)

    def _squeeze(self, stretch: complex) -> complex:
        if self.theory == "membrane":
            return 2.0 * self.permittivity * stretch / (self.thickness * self.radius)
        inner, outer, wall = self._faces(stretch)
        return 0.5 * self.permittivity * (inner + outer) * (inner**2 + outer**2) / (wall * (inner * outer) ** 2)

    def capacitance(self, stretch: float) -> float:
        if self.theory == "membrane":
            return 4.0 * math.pi * self.permittivity * self.radius**2 * stretch**4 / self.thickness
        inner, outer, wall = self._faces(stretch)
        return 4.0 * math.pi * self.permittivity * (inner * outer / wall).real
