"""A law of the user's own: an energy W(I_1, I_2), whose derivatives are taken from its text.

    sigma_i - sigma_j = 2 (l_i^2 - l_j^2) (W_1 + l_k^2 W_2)

Source: R. W. Ogden, Non-linear Elastic Deformations (1984), section 4.3; theory page "Laws".
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from embedding.scene.differentiation import derivative
from embedding.scene.expression import Expression
from embedding.scene.strain_energy import AT_REST, INVARIANTS
from embedding.shell.functions import functions_for
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws.law import IncompressibleLaw


@dataclass(frozen=True)
class StrainEnergyLaw(IncompressibleLaw):
    """Psi = ``factor`` (W(I_1, I_2) - W(3, 3)) with the expression W = ``of_invariants``."""

    of_invariants: Expression
    factor: float

    def energy(self, kinematics: Kinematics) -> Any:
        return self.factor * (_at(self.of_invariants, *_invariants(kinematics)) - _at(self.of_invariants, *AT_REST))

    def bending_modulus(self, kinematics: Kinematics) -> Any:
        """2 (W_1 + W_2 I_1 / 3)."""
        first, second = _invariants(kinematics)
        w1, w2 = self._slopes(first, second)
        return 2 * (w1 + w2 * first / 3)

    def principal_stresses(self, major: Any, minor: Any) -> tuple[Any, Any]:
        a, b = major**2, minor**2
        across = 1 / (a * b)
        w1, w2 = self._slopes(a + b + across, a * b + across * (a + b))
        return 2 * (w1 + w2 * b) * (a - across), 2 * (w1 + w2 * a) * (b - across)

    def _slopes(self, first: Any, second: Any) -> tuple[Any, Any]:
        w1, w2 = (self.factor * _at(slope, first, second) for slope in self._derivatives)
        return w1, w2

    @cached_property
    def _derivatives(self) -> tuple[Expression, ...]:
        return tuple(derivative(self.of_invariants, name) for name in INVARIANTS)


def _at(expression: Expression, first: Any, second: Any) -> Any:
    return expression(first, second, functions=functions_for(first, second))


def _invariants(kinematics: Kinematics) -> tuple[Any, Any]:
    inverse = 1 / kinematics.surface_stretch_squared
    first = kinematics.metric_trace + inverse
    return first, kinematics.surface_stretch_squared + kinematics.metric_trace * inverse
