"""A dielectric elastomer tube in plane strain: a thin or thick wall with an electrode on each face."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

from problems.exact.charged_tube import ChargedTube
from problems.exact.dielectric_shell import DielectricShell


@dataclass(frozen=True)
class DielectricTube(DielectricShell):
    """Circular cylindrical case of `dielectric_shell`, all charges per axial length.

    Thick: E = k / r with k = U / ln(b/a), hence squeeze = eps/2 (E_a^2 - E_b^2) / U^2. Membrane: squeeze =
    eps / (T R), whatever the stretch; neo-Hooke p = mu (T/R) (1 - l^-4) - eps U^2 / (T R). A ground is needed for a
    voltage of the outer electrode; without one (`outer_radius` infinite) there is none, and any other is refused.
    """

    @property
    def conductor(self) -> ChargedTube:
        # Without a ground the outer electrode is at zero, and so is the field around it: any far ground will do.
        ground = 1e3 * self.radius if math.isinf(self.outer_radius) else self.outer_radius
        return ChargedTube(self.radius, self.thickness, self.law, self.vacuum, ground, self.theory)

    def pressure(self, stretch: float, voltage: float = 0.0, outer_voltage: float = 0.0) -> float:
        """As in `DielectricShell`; ValueError for an outer voltage without a ground."""
        if outer_voltage and math.isinf(self.outer_radius):
            raise ValueError("outer_radius must be finite: a charged infinite tube needs a ground")
        return super().pressure(stretch, voltage, outer_voltage)

    def _faces(self, stretch: complex) -> tuple[complex, complex, complex]:
        added = self.radius**2 * (stretch**2 - 1.0)
        within, outside = self.radius - 0.5 * self.thickness, self.radius + 0.5 * self.thickness
        inner, outer = (within**2 + added) ** 0.5, (outside**2 + added) ** 0.5
        return inner, outer, (outside**2 - within**2) / (inner + outer)

    def _squeeze(self, stretch: complex) -> complex:
        if self.theory == "membrane":
            return self.permittivity / (self.thickness * self.radius) + 0.0 * stretch
        inner, outer, wall = self._faces(stretch)
        return 0.5 * self.permittivity * wall * (inner + outer) / (inner * outer * cmath.log(outer / inner)) ** 2

    def capacitance(self, stretch: float) -> float:
        if self.theory == "membrane":
            return 2.0 * math.pi * self.permittivity * self.radius * stretch**2 / self.thickness
        inner, outer = self.face_radii(stretch)
        return 2.0 * math.pi * self.permittivity / math.log(outer / inner)
