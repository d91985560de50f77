"""Shells of several materials: the law of one region, or that of another, by the sign of an indicator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ngsolve import CF, IfPos

from embedding.shell.kinematics import Kinematics
from embedding.shell.laws.koiter import KoiterLaw
from embedding.shell.laws.law import IncompressibleLaw, Law


@dataclass(frozen=True)
class PiecewiseLaw(IncompressibleLaw):
    """``inside`` where the coefficient function ``indicator`` is positive, ``outside`` elsewhere."""

    indicator: Any
    inside: IncompressibleLaw
    outside: IncompressibleLaw

    def energy(self, kinematics: Kinematics) -> Any:
        return self._choose(self.inside.energy(kinematics), self.outside.energy(kinematics))

    def bending_modulus(self, kinematics: Kinematics) -> Any:
        return self._choose(self.inside.bending_modulus(kinematics), self.outside.bending_modulus(kinematics))

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        """As of one law; ``major`` and ``minor`` must be functions on the shell."""
        pairs = zip(
            self.inside.principal_stresses(major, minor), self.outside.principal_stresses(major, minor), strict=True
        )
        first, second = (self._choose(a, b) for a, b in pairs)
        return first, second

    def _choose(self, inside: Any, outside: Any) -> Any:
        return IfPos(self.indicator, CF(inside), CF(outside))


def piecewise(indicator: Any, inside: Law, outside: Law) -> Law:
    """One law made of two: both incompressible, or both of small strains, whose moduli then vary.

    Raises:
        TypeError: one law of each kind.
    """
    if isinstance(inside, KoiterLaw) and isinstance(outside, KoiterLaw):
        youngs = IfPos(indicator, CF(inside.youngs), CF(outside.youngs))
        return KoiterLaw(youngs, IfPos(indicator, CF(inside.poisson), CF(outside.poisson)))
    if isinstance(inside, IncompressibleLaw) and isinstance(outside, IncompressibleLaw):
        return PiecewiseLaw(indicator, inside, outside)
    raise TypeError("a shell follows incompressible laws, or the law of small strains")
