"""Hyperelastic laws as energies of the mid-surface in plane stress, one family a file; theory page "Laws"."""

from embedding.shell.laws.choice import law_of
from embedding.shell.laws.invariants import GentLaw, MooneyRivlinLaw, YeohLaw
from embedding.shell.laws.koiter import KoiterLaw
from embedding.shell.laws.law import IncompressibleLaw, Law
from embedding.shell.laws.ogden import OgdenLaw
from embedding.shell.laws.pieces import PiecewiseLaw, piecewise
from embedding.shell.laws.strain_energy import StrainEnergyLaw

__all__ = [
    "GentLaw",
    "IncompressibleLaw",
    "KoiterLaw",
    "Law",
    "MooneyRivlinLaw",
    "OgdenLaw",
    "PiecewiseLaw",
    "StrainEnergyLaw",
    "YeohLaw",
    "law_of",
    "piecewise",
]
