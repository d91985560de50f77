"""A hyperelastic law of the user's own, given by its energy."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Annotated, ClassVar, Literal, Self

from pydantic import model_validator

from embedding.scene.differentiation import derivative
from embedding.scene.expression import Expression, parse_expression
from embedding.scene.messages import refusal
from embedding.scene.part import Part
from embedding.scene.surface_fields import expression_in, unit_of
from embedding.scene.units import LARGEST, unit_factor

INVARIANTS = ("I1", "I2")
AT_REST = (3.0, 3.0)


class StrainEnergy(Part):
    """W(I1, I2) of any incompressible material: ``expression`` in I1 and I2, times ``unit``, per reference volume.

    Such as ``"15*(I1 - 3) + 2*(exp(0.1*(I1 - 3)) - 1)"`` with the unit kPa; a constant does not matter. The shear
    modulus of small strains, 2 (dW/dI1 + dW/dI2) at I1 = I2 = 3, must be positive.
    Source: R. W. Ogden, Non-linear Elastic Deformations (1984), section 4.3.
    """

    incompressible: ClassVar[bool] = True

    law: Literal["strain-energy"] = "strain-energy"
    expression: Annotated[str, expression_in(INVARIANTS)]
    unit: Annotated[str, unit_of("Pa", "pressure", "kPa")] = "Pa"

    @cached_property
    def energy(self) -> Expression:
        """W / ``factor``, of I1 and I2."""
        return parse_expression(self.expression, INVARIANTS)

    @property
    def factor(self) -> float:
        """Pa per ``unit``."""
        return float(unit_factor(self.unit, "Pa"))

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of small strains, 2 (dW/dI1 + dW/dI2), in Pa; nan where it has none."""
        try:
            slopes = [float(derivative(self.energy, name)(*AT_REST)) for name in INVARIANTS]
        except (ArithmeticError, ValueError, TypeError):  # TypeError: a root of a negative number is complex
            return math.nan
        return 2.0 * self.factor * sum(slopes)

    @model_validator(mode="after")
    def _resists(self) -> Self:
        modulus = self.shear_modulus
        if not 1.0 / LARGEST <= modulus <= LARGEST:
            reason = f"the shear modulus at rest, 2 (dW/dI1 + dW/dI2) at I1 = I2 = 3, is {modulus:.6g} Pa"
            raise refusal(f"{reason} and must be positive", field="expression", value=self.expression)
        return self
