"""Incompressible laws by their principal stresses, in plain arithmetic: real and complex stretches alike."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass


class Law(ABC):
    """An isotropic law at J = 1."""

    @property
    @abstractmethod
    def shear_modulus(self) -> float:
        """mu, the modulus of small shear."""

    @abstractmethod
    def energy(self, stretch_1: float, stretch_2: float) -> float:
        """Energy per reference volume; the third stretch is 1 / (stretch_1 stretch_2)."""

    @abstractmethod
    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        """Cauchy stress sigma_i - sigma_j between two principal directions; the third is 1 / (i j)."""


@dataclass(frozen=True)
class MooneyRivlin(Law):
    """Energy per reference volume W = c1 (I1 - 3) + c2 (I2 - 3) at J = 1 (Mooney 1940; Rivlin 1948)."""

    c1: float
    c2: float = 0.0

    @property
    def shear_modulus(self) -> float:
        """mu = 2 (c1 + c2)."""
        return 2.0 * (self.c1 + self.c2)

    def energy(self, stretch_1: float, stretch_2: float) -> float:
        third = 1.0 / (stretch_1 * stretch_2)
        first = stretch_1**2 + stretch_2**2 + third**2
        second = stretch_1**-2 + stretch_2**-2 + third**-2
        return self.c1 * (first - 3.0) + self.c2 * (second - 3.0)

    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        """From sigma_i = -p + stretch_i dW/dstretch_i with I1 = sum of squares, I2 = sum of inverse squares."""
        return 2.0 * self.c1 * (stretch_i**2 - stretch_j**2) - 2.0 * self.c2 * (stretch_i**-2 - stretch_j**-2)


@dataclass(frozen=True)
class Yeoh(Law):
    """W = c1 x + c2 x^2 + c3 x^3 with x = I1 - 3 (Yeoh 1993)."""

    c1: float
    c2: float
    c3: float

    @property
    def shear_modulus(self) -> float:
        """mu = 2 c1."""
        return 2.0 * self.c1

    def energy(self, stretch_1: float, stretch_2: float) -> float:
        x = excess(stretch_1, stretch_2)
        return self.c1 * x + self.c2 * x**2 + self.c3 * x**3

    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        x = excess(stretch_i, stretch_j)
        return 2.0 * (self.c1 + 2.0 * self.c2 * x + 3.0 * self.c3 * x**2) * (stretch_i**2 - stretch_j**2)


@dataclass(frozen=True)
class Gent(Law):
    """W = -(mu Jm / 2) ln(1 - (I1 - 3) / Jm) (Gent 1996); infinitely stiff from I1 - 3 = Jm on."""

    modulus: float
    limit: float

    @property
    def shear_modulus(self) -> float:
        return self.modulus

    def energy(self, stretch_1: float, stretch_2: float) -> float:
        return -0.5 * self.modulus * self.limit * math.log(1.0 - excess(stretch_1, stretch_2) / self.limit)

    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        left, difference = self.limit - excess(stretch_i, stretch_j), stretch_i**2 - stretch_j**2
        if left.real <= 0.0:
            return math.copysign(math.inf, difference.real)
        return self.modulus * self.limit / left * difference


@dataclass(frozen=True)
class Ogden(Law):
    """W = sum mu_p / alpha_p (sum of stretch^alpha_p - 3) (Ogden 1972)."""

    moduli: tuple[float, ...]
    exponents: tuple[float, ...]

    @property
    def shear_modulus(self) -> float:
        """mu = sum mu_p alpha_p / 2."""
        return 0.5 * sum(mu * alpha for mu, alpha in self._terms())

    def _terms(self) -> list[tuple[float, float]]:
        return list(zip(self.moduli, self.exponents, strict=True))

    def energy(self, stretch_1: float, stretch_2: float) -> float:
        stretches = stretch_1, stretch_2, 1.0 / (stretch_1 * stretch_2)
        return sum(mu / alpha * (sum(s**alpha for s in stretches) - 3.0) for mu, alpha in self._terms())

    def stress_difference(self, stretch_i: float, stretch_j: float) -> float:
        return sum(mu * (stretch_i**alpha - stretch_j**alpha) for mu, alpha in self._terms())


def excess(stretch_1: float, stretch_2: float) -> float:
    """I1 - 3 at J = 1."""
    return stretch_1**2 + stretch_2**2 + (stretch_1 * stretch_2) ** -2 - 3.0


def neo_hookean(shear_modulus: float = 1.0) -> MooneyRivlin:
    """W = mu/2 (I1 - 3)."""
    return MooneyRivlin(0.5 * shear_modulus)


def mooney_rivlin(c1: float, c2: float) -> MooneyRivlin:
    """W = c1 (I1 - 3) + c2 (I2 - 3)."""
    return MooneyRivlin(c1, c2)
