"""Plane stress of St Venant and Kirchhoff: small strains, large rotations, any Poisson ratio.

With the surface strain E = (C_s - P) / 2, the hoop strain included in the reductions,

    Psi = Y / (2 (1 + nu)) [E : E + nu / (1 - nu) (tr E)^2],        lambda = 1 - nu / (1 - nu) tr E

Source: W. T. Koiter (1960), the membrane part of his energy; theory page "Laws".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from ngsolve import InnerProduct, Trace

from embedding.shell.kinematics import Kinematics


@dataclass(frozen=True)
class KoiterLaw:
    """``youngs`` modulus and ``poisson`` ratio."""

    youngs: float
    poisson: float
    incompressible: ClassVar[bool] = False

    def energy(self, kinematics: Kinematics) -> Any:
        """Psi, energy per reference volume."""
        trace, square = _trace(kinematics), InnerProduct(kinematics.strain, kinematics.strain)
        if kinematics.dimension == 2:
            square = square + kinematics.hoop_strain ** 2
        return (self.youngs / (2 * (1 + self.poisson))) * (square + self._coupling * trace * trace)

    def thickness_stretch(self, kinematics: Kinematics) -> Any:
        """lambda = t / T = 1 - nu / (1 - nu) tr E."""
        return 1 - self._coupling * _trace(kinematics)

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        """l_i^2 S_i / J_s: per deformed length and undeformed thickness, as small strains allow."""
        first, second = (major**2 - 1) / 2, (minor**2 - 1) / 2
        modulus = self.youngs / (1 - self.poisson**2)
        return (
            modulus * (first + self.poisson * second) * major / minor,
            modulus * (second + self.poisson * first) * minor / major,
        )

    @property
    def _coupling(self) -> float:
        return self.poisson / (1 - self.poisson)


def _trace(kinematics: Kinematics) -> Any:
    trace = Trace(kinematics.strain)
    return trace if kinematics.dimension == 3 else trace + kinematics.hoop_strain
