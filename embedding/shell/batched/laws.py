"""Laws as functions of two invariants of the strain, with their derivatives.

With the mixed components of E: t = tr E and e = det E. Then I_C = 2 + 2 t, b = J_s^2 = 1 + 2 t + 4 e, and with
x = I_C + 1 / b - 3 = I_1 - 3

    Koiter          Psi = Y / (2 (1 + nu)) (t^2 / (1 - nu) - 2 e)
    incompressible  Psi = phi(x) + c2 (b + I_C / b - 3)

where phi = c1 x for Mooney and Rivlin; Yeoh and Gent have no c2. Source: theory page "Laws".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from embedding.shell.batched.places import Block
from embedding.shell.batched.polynomials import Array
from embedding.shell.laws import GentLaw, KoiterLaw, Law, MooneyRivlinLaw, YeohLaw

Incompressible = MooneyRivlinLaw | YeohLaw | GentLaw


class Slopes(NamedTuple):
    """Derivatives of Psi in t and e."""

    t: Any
    e: Any
    tt: Any
    te: Any
    ee: Any


@dataclass(frozen=True)
class Hooke:
    """Koiter's law with the moduli (p, e) at the points."""

    youngs: Array
    poisson: Array

    def slopes(self, t: Array, e: Array) -> Slopes:
        """Derivatives of Psi at the invariants (p, e)."""
        stiff = self.youngs / (1 - self.poisson**2)
        return Slopes(stiff * t, -self.youngs / (1 + self.poisson), stiff, 0.0, 0.0)


@dataclass(frozen=True)
class Rubber:
    """An incompressible law."""

    law: Incompressible

    def slopes(self, t: Array, e: Array) -> Slopes:
        """Derivatives of Psi at the invariants (p, e)."""
        second = self.law.c2 if isinstance(self.law, MooneyRivlinLaw) else 0.0
        trace, grown = 2 + 2 * t, 2 * t + 4 * e  # of the metric, and b - 1: small ones keep their digits
        inverse = 1 / (1 + grown)
        phi, bend, _ = first_invariant(self.law, 4 * (t * t + 2 * t * e - e) * inverse)
        mixed = -(bend + second) * inverse**2
        curved = bend * inverse**4 + 2 * (phi + second * trace) * inverse**3
        along = phi * grown * (2 + grown) + second * (grown * (3 + grown) - 2 * t)
        across = second - (phi + second * trace) * inverse**2
        return Slopes(
            2 * along * inverse**2, 4 * across, 4 * (bend + 2 * mixed + curved), 8 * (mixed + curved), 16 * curved
        )

    def bending_modulus(self, x: Array) -> tuple[Any, Any, Any]:
        """mu_b and its two derivatives at x = I_1 - 3."""
        if isinstance(self.law, MooneyRivlinLaw):
            slope = 2 * self.law.c2 / 3
            return 2 * self.law.c1 + slope * (x + 3), slope, 0.0
        phi, bend, third = first_invariant(self.law, x)
        return 2 * phi, 2 * bend, 2 * third


def first_invariant(law: Incompressible, x: Array) -> tuple[Any, Any, Any]:
    """The first three derivatives of phi at ``x``."""
    if isinstance(law, MooneyRivlinLaw):
        return law.c1, 0.0, 0.0
    if isinstance(law, YeohLaw):
        return law.slope(x), 2 * law.c2 + 6 * law.c3 * x, 6 * law.c3
    slope = law.slope(x)
    stretched = 1 / (law.limit - x)
    return slope, slope * stretched, 2 * slope * stretched**2


def law_at(law: Law, block: Block, points: Array) -> Hooke | Rubber | None:
    """``law`` at reference ``points`` of a block; None for a law that is not supported."""
    if isinstance(law, KoiterLaw):
        return Hooke(block.at(points, law.youngs), block.at(points, law.poisson))
    return Rubber(law) if isinstance(law, Incompressible) else None
