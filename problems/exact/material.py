"""Incompressible Mooney-Rivlin law, with neo-Hooke as its special case."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Law:
    """Energy per reference volume W = c1 (I1 - 3) + c2 (I2 - 3) at J = 1 (Mooney 1940; Rivlin 1948)."""

    c1: float
    c2: float = 0.0

    @property
    def shear_modulus(self) -> float:
        """mu = 2 (c1 + c2), the modulus of small shear."""
        return 2.0 * (self.c1 + self.c2)

    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        """Cauchy stress sigma_i - sigma_j between two principal directions.

        From sigma_i = -p + stretch_i dW/dstretch_i with I1 = sum of squares and I2 = sum of inverse squares.
        """
        return 2.0 * self.c1 * (stretch_i**2 - stretch_j**2) - 2.0 * self.c2 * (stretch_i**-2 - stretch_j**-2)


def neo_hookean(shear_modulus: float = 1.0) -> Law:
    """W = mu/2 (I1 - 3)."""
    return Law(0.5 * shear_modulus)


def mooney_rivlin(c1: float, c2: float) -> Law:
    """W = c1 (I1 - 3) + c2 (I2 - 3)."""
    return Law(c1, c2)
