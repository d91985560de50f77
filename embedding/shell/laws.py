"""Incompressible hyperelastic laws as energies of the invariants of a shell in plane stress.

With the thickness stretch eliminated by incompressibility, lambda = 1 / J_s, the invariants of C are

    I_1 = I_C + J_s^-2,        I_2 = J_s^2 + I_C J_s^-2

(theory page, "Membrane energy"; paper section 5 with the factor 1/2 of erratum E1).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from embedding.scene import MooneyRivlin, NeoHookean
from embedding.shell.kinematics import Kinematics


@dataclass(frozen=True)
class Law:
    """Psi = c1 (I_1 - 3) + c2 (I_2 - 3), energy per reference volume; neo-Hookean when ``c2`` is 0."""

    c1: float
    c2: float

    @staticmethod
    def of(material: NeoHookean | MooneyRivlin, stress: float) -> Law:
        """The law of a scene's ``material``, made dimensionless by the scale ``stress`` in Pa."""
        if isinstance(material, NeoHookean):
            return Law(material.shear_modulus / (2 * stress), 0.0)
        return Law(material.c1 / stress, material.c2 / stress)

    def energy(self, kinematics: Kinematics) -> Any:
        """Psi at a point of the mid-surface."""
        inverse = 1 / kinematics.surface_stretch_squared
        energy = self.c1 * (kinematics.metric_trace + inverse - 3)
        if self.c2:
            second = kinematics.surface_stretch_squared + kinematics.metric_trace * inverse
            energy = energy + self.c2 * (second - 3)
        return energy
