"""Fitting hyperelastic laws to tests of a material: tables of stretch and nominal stress in simple deformations."""

from embedding.fit.errors import FitError
from embedding.fit.fitting import Doubt, Fit, ModeError, Parameter, fit_law
from embedding.fit.measurements import MODES, Measurements, Mode, Series, read_measurements
from embedding.fit.picture import fit_picture
from embedding.fit.stress import nominal_stress

__all__ = [
    "MODES",
    "Doubt",
    "Fit",
    "FitError",
    "Measurements",
    "Mode",
    "ModeError",
    "Parameter",
    "Series",
    "fit_law",
    "fit_picture",
    "nominal_stress",
    "read_measurements",
]
