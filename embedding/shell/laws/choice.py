"""From a material of the scene to its law."""

from __future__ import annotations

from embedding.scene import Gent, Material, MooneyRivlin, NeoHookean, Ogden, StrainEnergy, Yeoh
from embedding.shell.laws.invariants import GentLaw, MooneyRivlinLaw, YeohLaw
from embedding.shell.laws.koiter import KoiterLaw
from embedding.shell.laws.law import Law
from embedding.shell.laws.ogden import OgdenLaw
from embedding.shell.laws.strain_energy import StrainEnergyLaw


def law_of(material: Material, stress: float) -> Law:
    """The law of a scene's ``material``, made dimensionless by the scale ``stress`` in Pa."""
    if isinstance(material, NeoHookean):
        return MooneyRivlinLaw(material.shear_modulus / (2 * stress))
    if isinstance(material, MooneyRivlin):
        return MooneyRivlinLaw(material.c1 / stress, material.c2 / stress)
    if isinstance(material, Yeoh):
        return YeohLaw(material.c1 / stress, material.c2 / stress, material.c3 / stress)
    if isinstance(material, Gent):
        return GentLaw(material.shear_modulus / stress, material.limit)
    if isinstance(material, Ogden):
        return OgdenLaw(tuple(modulus / stress for modulus in material.moduli), material.exponents)
    if isinstance(material, StrainEnergy):
        return StrainEnergyLaw(material.energy, material.factor / stress)
    return KoiterLaw(material.youngs_modulus / stress, material.poisson_ratio)
