"""Ogden's law in the principal stretches, smooth where two of them are equal.

With s = alpha / 2 and a, b the squares of the in-plane principal stretches, the energy needs a^s + b^s. A reduction
shows a and b directly: one along the curve, one out of the mesh. On a surface they are h (1 +- sqrt q) with h = I_C / 2
and q = 1 - (J_s / h)^2, and the root has no derivative at q = 0 (a sphere!) although a^s + b^s has: near there it is

    a^s + b^s = 2 h^s sum_k C(s, 2k) q^k

Source: R. W. Ogden, Proc. R. Soc. Lond. A 326 (1972) 565; theory page "Laws".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ngsolve import IfPos, exp, log, sinh, sqrt

from embedding.shell.kinematics import Kinematics
from embedding.shell.laws.law import IncompressibleLaw

NEAR = 0.01
"""Largest q at which the series is used; above, two derivatives of the root lose a factor 1e3 = q^(-3/2)."""
NEGLIGIBLE = 1e-15
"""Where the series ends: relative size of a term in the second derivative at ``NEAR``."""
APART = 1e-7
"""Least q in the bending modulus, whose derivatives go through the root: it changes the modulus by less than this."""


@dataclass(frozen=True)
class OgdenLaw(IncompressibleLaw):
    """Psi = sum_p mu_p / alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3)."""

    moduli: tuple[float, ...]
    exponents: tuple[float, ...]

    def _terms(self) -> Iterator[tuple[float, float]]:
        """mu_p and s_p = alpha_p / 2."""
        return ((mu, alpha / 2) for mu, alpha in zip(self.moduli, self.exponents, strict=True))

    def energy(self, kinematics: Kinematics) -> Any:
        area = log(kinematics.surface_stretch_squared)
        across = sum(mu / (2 * s) * (exp(-s * area) - 3) for mu, s in self._terms())
        if kinematics.dimension == 2:
            return across + self._powers(*_shown(kinematics))
        h, q = _half_trace(kinematics), _inequality(kinematics)
        first = log(h) + log(1 + sqrt(IfPos(q - NEAR, q, NEAR)))
        return across + IfPos(q - NEAR, self._powers(first, area - first), self._series(log(h), q))

    def _powers(self, first: Any, second: Any) -> Any:
        """sum mu / alpha (a^s + b^s) from the logarithms of a and b."""
        return sum(mu / (2 * s) * (exp(s * first) + exp(s * second)) for mu, s in self._terms())

    def _series(self, log_h: Any, q: Any) -> Any:
        """The same for small q."""
        return sum(mu / s * exp(s * log_h) * _polynomial(even_binomials(s), q) for mu, s in self._terms())

    def bending_modulus(self, kinematics: Kinematics) -> Any:
        """A third of sum mu_p (a^s - b^s) / (a - b) over the pairs of squared stretches a, b."""
        if kinematics.dimension == 2:
            first, second = _shown(kinematics)
        else:
            root = sqrt(_inequality(kinematics) + APART)
            first = log(_half_trace(kinematics)) + log(1 + root)
            second = log(kinematics.surface_stretch_squared) - first
        third = -(first + second)
        return sum(self._pair(a, b) for a, b in ((first, second), (first, third), (second, third))) / 3

    def _pair(self, first: Any, second: Any) -> Any:
        """(sigma_i - sigma_j) / (l_i^2 - l_j^2), from the logarithms of the squared stretches.

        (a^s - b^s) / (a - b) = (a b)^((s-1)/2) sinh(s y) / sinh(y) with y = ln(a / b) / 2; a series in y^2 near 0.
        """
        near = 0.25 / max(1.0, *(s * s for _, s in self._terms()))
        square = 0.25 * (first - second) * (first - second)
        y = sqrt(IfPos(square - near, square, near))
        far = sum(mu * exp((s - 1) / 2 * (first + second)) * sinh(s * y) for mu, s in self._terms()) / sinh(y)
        close = sum(
            mu * s * exp((s - 1) / 2 * (first + second)) * _sinh_ratio(s * s * square) for mu, s in self._terms()
        ) / _sinh_ratio(square)
        return IfPos(square - near, far, close)

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        area = major * minor
        across = sum(mu * area ** (-2 * s) for mu, s in self._terms())
        return (
            sum(mu * major ** (2 * s) for mu, s in self._terms()) - across,
            sum(mu * minor ** (2 * s) for mu, s in self._terms()) - across,
        )


def even_binomials(s: float) -> list[float]:
    """C(s, 0), C(s, 2), C(s, 4), ... as many as the series needs at ``NEAR``."""
    coefficients, binomial, n = [1.0], 1.0, 0
    largest = 0.0
    while True:
        binomial *= (s - n) * (s - n - 1) / ((n + 1) * (n + 2))
        n += 2
        k = n // 2
        bend = abs(binomial) * k * (k - 1) * NEAR ** (k - 2)
        largest = max(largest, bend)
        if k > 2 and bend <= NEGLIGIBLE * max(1.0, largest):
            return coefficients
        coefficients.append(binomial)


def _polynomial(coefficients: list[float], q: Any) -> Any:
    value: Any = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        value = coefficient + q * value
    return value


def _sinh_ratio(square: Any) -> Any:
    """sinh(y) / y for y^2 = ``square`` up to 0.25, to rounding."""
    value: Any = 1.0
    for n in (6, 5, 4, 3, 2, 1):
        value = 1.0 + square / (2 * n * (2 * n + 1)) * value
    return value


def _half_trace(kinematics: Kinematics) -> Any:
    return 0.5 * kinematics.metric_trace


def _inequality(kinematics: Kinematics) -> Any:
    """q = ((a - b) / (a + b))^2, 0 where the in-plane stretches are equal."""
    h = _half_trace(kinematics)
    return 1 - kinematics.surface_stretch_squared / (h * h)


def _shown(kinematics: Kinematics) -> tuple[Any, Any]:
    """Logarithms of the squared stretches along the curve and out of the mesh."""
    square = kinematics.hoop * kinematics.hoop
    return log(kinematics.metric_trace - square), log(square)
