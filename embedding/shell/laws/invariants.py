"""Incompressible laws in the invariants of C, with lambda = 1 / J_s:

    I_1 = I_C + J_s^-2,        I_2 = J_s^2 + I_C J_s^-2

Sources: theory page "Laws"; paper section 5 with the factor 1/2 of erratum E1.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

from ngsolve import log

from embedding.shell.kinematics import Kinematics
from embedding.shell.laws.law import IncompressibleLaw


@dataclass(frozen=True)
class MooneyRivlinLaw(IncompressibleLaw):
    """Psi = c1 (I_1 - 3) + c2 (I_2 - 3); neo-Hookean when ``c2`` is 0."""

    c1: float
    c2: float = 0.0

    def energy(self, kinematics: Kinematics) -> Any:
        energy = self.c1 * kinematics.excess
        return energy + self.c2 * kinematics.second_excess if self.c2 else energy

    def bending_modulus(self, kinematics: Kinematics) -> Any:
        """2 (c1 + c2 I_1 / 3)."""
        if not self.c2:
            return 2 * self.c1
        return 2 * self.c1 + (2 * self.c2 / 3) * (kinematics.excess + 3)

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        across = (major * minor) ** -2
        return (
            2 * (self.c1 + self.c2 * minor**2) * (major**2 - across),
            2 * (self.c1 + self.c2 * major**2) * (minor**2 - across),
        )


class FirstInvariantLaw(IncompressibleLaw):
    """A law in I_1 alone, stated as a function of x = I_1 - 3."""

    @abstractmethod
    def of_excess(self, x: Any) -> Any:
        """Psi at x = I_1 - 3."""

    @abstractmethod
    def slope(self, x: Any) -> Any:
        """d Psi / d I_1 at x = I_1 - 3."""

    def energy(self, kinematics: Kinematics) -> Any:
        return self.of_excess(kinematics.excess)

    def bending_modulus(self, kinematics: Kinematics) -> Any:
        """2 d Psi / d I_1, the same for every pair."""
        return 2 * self.slope(kinematics.excess)

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        across = (major * minor) ** -2
        modulus = 2 * self.slope(major**2 + minor**2 + across - 3)
        return modulus * (major**2 - across), modulus * (minor**2 - across)


@dataclass(frozen=True)
class YeohLaw(FirstInvariantLaw):
    """Psi = c1 x + c2 x^2 + c3 x^3 (Yeoh 1993)."""

    c1: float
    c2: float
    c3: float

    def of_excess(self, x: Any) -> Any:
        return x * (self.c1 + x * (self.c2 + x * self.c3))

    def slope(self, x: Any) -> Any:
        return self.c1 + x * (2 * self.c2 + x * (3 * self.c3))


@dataclass(frozen=True)
class GentLaw(FirstInvariantLaw):
    """Psi = -(mu Jm / 2) ln(1 - x / Jm) (Gent 1996); not a number from x = Jm on, which cuts a step."""

    shear_modulus: float
    limit: float

    def of_excess(self, x: Any) -> Any:
        return (-0.5 * self.shear_modulus * self.limit) * log(1 - x / self.limit)

    def slope(self, x: Any) -> Any:
        return 0.5 * self.shear_modulus / (1 - x / self.limit)
