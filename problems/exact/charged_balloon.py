"""A conducting spherical balloon at a voltage, in free space or inside a concentric grounded sphere."""

from __future__ import annotations

import math
from dataclasses import dataclass

from problems.exact import sphere
from problems.exact.charged_shell import ChargedShell


@dataclass(frozen=True)
class ChargedBalloon(ChargedShell):
    """Spherical case of `charged_shell`: E = V R_o / (b (R_o - b)) at the face radius b, in free space V / b.

    Elastic pressure of `sphere`. Neo-Hookean membrane in free space: eps V^2 / (4 mu T R) = l - l^-5 - P l^2
    with P = p R / (2 mu T); times (1 - l R / R_o)^2 inside the grounded sphere.
    """

    def face_radius(self, stretch: float) -> float:
        """b = (B^3 + R^3 (l^3 - 1))^(1/3) for the outer face B = R + T/2; l R for the membrane."""
        if self.theory == "membrane":
            return stretch * self.radius
        outer = self.radius + 0.5 * self.thickness
        return outer * sphere.face_stretches(stretch, self.thickness / self.radius)[1]

    def _face_slope(self, stretch: float) -> float:
        return self.radius**3 * stretch**2 / self.face_radius(stretch) ** 2

    def _elastic(self, stretch: float) -> tuple[float, float]:
        pressure, slope = sphere.PRESSURES[self.theory]
        ratio = self.thickness / self.radius
        return pressure(stretch, ratio, self.law), slope(stretch, ratio, self.law)

    def _unelectrified(self, pressure: float) -> float:
        return sphere.stretch_at(pressure, self.thickness / self.radius, self.law, self.theory)

    def _distance(self, face: float) -> tuple[float, float]:
        return face * (1.0 - face / self.outer_radius), 1.0 - 2.0 * face / self.outer_radius

    def _capacitance(self, face: float) -> float:
        return 4.0 * math.pi * self.permittivity * face / (1.0 - face / self.outer_radius)
