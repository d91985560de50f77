"""Incompressible hyperelastic laws, as energies per reference volume of I1 and I2.

Source: R. W. Ogden, Non-linear Elastic Deformations (1984), section 4.3.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Tag

from embedding.scene.part import Part, kind_under
from embedding.scene.units import NonNegativePressure, PositivePressure


class NeoHookean(Part):
    """W = mu/2 (I1 - 3), with the shear modulus mu in Pa."""

    law: Literal["neo-hookean"] = "neo-hookean"
    shear_modulus: PositivePressure


class MooneyRivlin(Part):
    """W = c1 (I1 - 3) + c2 (I2 - 3), with c1 > 0 and c2 >= 0 in Pa."""

    law: Literal["mooney-rivlin"] = "mooney-rivlin"
    c1: PositivePressure
    c2: NonNegativePressure

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of small strains, 2 (c1 + c2), in Pa."""
        return 2.0 * (self.c1 + self.c2)


Material = Annotated[
    Annotated[NeoHookean, Tag("neo-hookean")] | Annotated[MooneyRivlin, Tag("mooney-rivlin")],
    Discriminator(kind_under("law")),
]
