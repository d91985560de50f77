"""Hyperelastic laws: incompressible ones as energies per reference volume, and one for small strains of any material.

Source: R. W. Ogden, Non-linear Elastic Deformations (1984), section 4.3, and the papers named at each law.
"""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, Discriminator, Tag, model_validator

from embedding.scene.messages import refusal
from embedding.scene.part import Part, kind_under
from embedding.scene.strain_energy import StrainEnergy
from embedding.scene.units import LARGEST, NonNegativePressure, Number, Plain, PositivePressure, Pressure, Ratio


class NeoHookean(Part):
    """W = mu/2 (I1 - 3), with the shear modulus mu in Pa."""

    incompressible: ClassVar[bool] = True

    law: Literal["neo-hookean"] = "neo-hookean"
    shear_modulus: PositivePressure


class MooneyRivlin(Part):
    """W = c1 (I1 - 3) + c2 (I2 - 3), with c1 > 0 and c2 >= 0 in Pa."""

    incompressible: ClassVar[bool] = True

    law: Literal["mooney-rivlin"] = "mooney-rivlin"
    c1: PositivePressure
    c2: NonNegativePressure

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of small strains, 2 (c1 + c2), in Pa."""
        return 2.0 * (self.c1 + self.c2)


class Yeoh(Part):
    """W = c1 (I1 - 3) + c2 (I1 - 3)^2 + c3 (I1 - 3)^3, in Pa (O. H. Yeoh, Rubber Chem. Technol. 66 (1993) 754).

    c1 > 0 and c3 >= 0; c2 may be negative as long as dW/dI1 stays positive, which needs c2 > -sqrt(3 c1 c3).
    """

    incompressible: ClassVar[bool] = True

    law: Literal["yeoh"] = "yeoh"
    c1: PositivePressure
    c2: Pressure
    c3: NonNegativePressure

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of small strains, 2 c1, in Pa."""
        return 2.0 * self.c1

    @model_validator(mode="after")
    def _never_softens_to_nothing(self) -> Self:
        least = -sqrt(3.0 * self.c1) * sqrt(self.c3)
        if self.c2 < 0.0 and self.c2 <= least:
            reason = f"must be greater than -sqrt(3 c1 c3) = {least:.6g} Pa, or dW/dI1 becomes negative"
            raise refusal(reason, "Pa", field="c2", value=self.c2)
        return self


class Gent(Part):
    """W = -(mu Jm / 2) ln(1 - (I1 - 3) / Jm): chains that lock at I1 - 3 = Jm = ``limit``.

    Source: A. N. Gent, Rubber Chem. Technol. 69 (1996) 59.
    """

    incompressible: ClassVar[bool] = True

    law: Literal["gent"] = "gent"
    shear_modulus: PositivePressure
    limit: Ratio


def _numbers(value: Any) -> Any:
    if not isinstance(value, (list, tuple)) or not value:
        raise refusal("must be a list of one number a term")
    return value


def _exponent(value: Any) -> Any:
    if Number()(value) == 0.0:
        raise refusal("must not be 0")
    return value


Exponent = Annotated[Plain, BeforeValidator(_exponent)]


class Ogden(Part):
    """W = sum mu_p / alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3), ``moduli`` mu_p in Pa, ``exponents`` alpha_p.

    The shear modulus of small strains, sum mu_p alpha_p / 2, must be positive.
    Source: R. W. Ogden, Proc. R. Soc. Lond. A 326 (1972) 565.
    """

    incompressible: ClassVar[bool] = True

    law: Literal["ogden"] = "ogden"
    moduli: Annotated[tuple[Pressure, ...], BeforeValidator(_numbers)]
    exponents: Annotated[tuple[Exponent, ...], BeforeValidator(_numbers)]

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of small strains, sum mu_p alpha_p / 2, in Pa."""
        return sum(mu * alpha for mu, alpha in zip(self.moduli, self.exponents, strict=True)) / 2.0

    @model_validator(mode="after")
    def _terms(self) -> Self:
        if len(self.exponents) != len(self.moduli):
            reason = f"must hold as many numbers as moduli, {len(self.moduli)}"
            raise refusal(reason, field="exponents", value=self.exponents)
        if not self.shear_modulus >= 1.0 / LARGEST:
            reason = f"the shear modulus, half the sum of moduli times exponents, is {self.shear_modulus:.6g} Pa"
            raise refusal(f"{reason} and must be positive", field="moduli", value=self.moduli)
        return self


class StVenantKirchhoff(Part):
    """Plane-stress Koiter shell of any isotropic material, for small strains and large rotations (metal, paper).

    ``youngs_modulus`` in Pa; ``poisson_ratio`` greater than -1 and at most 0.5. Source: W. T. Koiter, Proc. IUTAM
    Symp. Theory of Thin Elastic Shells (1960) 12.
    """

    incompressible: ClassVar[bool] = False

    law: Literal["st-venant-kirchhoff"] = "st-venant-kirchhoff"
    youngs_modulus: PositivePressure
    poisson_ratio: Annotated[float, BeforeValidator(Number(above=-1.0, at_most=0.5))]

    @property
    def shear_modulus(self) -> float:
        """Y / (2 (1 + nu)), in Pa."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))


Material = Annotated[
    Annotated[NeoHookean, Tag("neo-hookean")]
    | Annotated[MooneyRivlin, Tag("mooney-rivlin")]
    | Annotated[Yeoh, Tag("yeoh")]
    | Annotated[Gent, Tag("gent")]
    | Annotated[Ogden, Tag("ogden")]
    | Annotated[StVenantKirchhoff, Tag("st-venant-kirchhoff")]
    | Annotated[StrainEnergy, Tag("strain-energy")],
    Discriminator(kind_under("law")),
]
