"""A conducting infinite tube in plane strain at a voltage, inside a concentric grounded cylinder."""

from __future__ import annotations

import math
from dataclasses import dataclass

from problems.exact import cylinder
from problems.exact.charged_shell import ChargedShell


@dataclass(frozen=True)
class ChargedTube(ChargedShell):
    """Circular cylindrical case of `charged_shell`: E = V / (b ln(R_o / b)) at the face radius b.

    Elastic pressure of `cylinder` at axial stretch 1. A charged line has no potential at infinity, so the
    ground is needed: raises ValueError without one.
    """

    def __post_init__(self) -> None:
        if math.isinf(self.outer_radius):
            raise ValueError("outer_radius must be finite: a charged infinite tube needs a ground")
        super().__post_init__()

    def face_radius(self, stretch: float) -> float:
        """b = (B^2 + R^2 (l^2 - 1))^(1/2) for the outer face B = R + T/2; l R for the membrane."""
        if self.theory == "membrane":
            return stretch * self.radius
        outer = self.radius + 0.5 * self.thickness
        return outer * cylinder.face_stretches(stretch, self.thickness / self.radius)[1]

    def _face_slope(self, stretch: float) -> float:
        return self.radius**2 * stretch / self.face_radius(stretch)

    def _elastic(self, stretch: float) -> tuple[float, float]:
        arguments = stretch, self.thickness / self.radius, self.law
        if self.theory == "membrane":
            return cylinder.membrane_pressure(*arguments), cylinder.membrane_slope(*arguments)
        return cylinder.thick_pressure(*arguments), cylinder.thick_slope(*arguments)

    def _unelectrified(self, pressure: float) -> float:
        ratio = self.thickness / self.radius
        if self.theory == "membrane":
            return cylinder.membrane_stretch(pressure, ratio, self.law)
        return cylinder.thick_stretch(pressure, ratio, self.law)

    def _distance(self, face: float) -> tuple[float, float]:
        logarithm = math.log(self.outer_radius / face)
        return face * logarithm, logarithm - 1.0

    def _capacitance(self, face: float) -> float:
        return 2.0 * math.pi * self.permittivity / math.log(self.outer_radius / face)
