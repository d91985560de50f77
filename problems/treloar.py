"""Treloar's rubber: his measurements by Ogden's law, with Ogden's own parameters and with fitted ones.

Data: `treloar.csv`, uniaxial and equibiaxial tension of vulcanised rubber up to stretches of 7.6 and 4.45 (Treloar,
Trans. Faraday Soc. 40 (1944) 59).

Reference: the three terms by which Ogden reproduced them (Proc. R. Soc. Lond. A 326 (1972) 565). They are within 14 %
of the measured stress up to a uniaxial stretch of 7.5, and within 9 % in equibiaxial tension but for the first point;
the last uniaxial point lies 19 % above them.

Run: about three seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from embedding import Ogden
from embedding.fit import Fit, Measurements, Series, fit_law, fit_picture, nominal_stress, read_measurements
from embedding.shell.laws import law_of
from problems.common import Array

DATA = Path(__file__).with_suffix(".csv")
PUBLISHED = Ogden(moduli=("0.63 MPa", "0.0012 MPa", "-0.01 MPa"), exponents=(1.3, 5.0, -2.0))


def measurements() -> Measurements:
    """The table, in Pa."""
    return read_measurements(DATA)


def fitted() -> Fit:
    """Three terms from scratch, every point weighed by its own stress."""
    return fit_law("ogden", measurements(), terms=3, relative=True)


def errors(material: Ogden, series: Series) -> Array:
    """Error of the nominal stress over the measured one, at the points that carry stress."""
    loaded = series.nominal_stress != 0.0
    measured = series.nominal_stress[loaded]
    return np.asarray(nominal_stress(law_of(material, 1.0), series.mode, series.stretch[loaded]) / measured - 1.0)


if __name__ == "__main__":
    fit = fitted()
    fit_picture(fit, "treloar.png")
    for words, material in (("Ogden 1972", PUBLISHED), ("fitted", fit.material)):
        print(f"{words}: moduli {material.moduli} Pa, exponents {material.exponents}")
        for series in measurements().series:
            error = errors(material, series)
            print(f"  {series.mode}: largest error {abs(error).max():.1e}, rms {np.sqrt(np.mean(error**2)):.1e}")
    print("picture: treloar.png")
