"""A permeable (or dielectric) spherical shell in a uniform field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from problems.exact.three_regions import ThreeRegions


@dataclass(frozen=True)
class PermeableSphere(ThreeRegions):
    """Spherical shell; all results in `ThreeRegions`.

    H_inner / H0 = 9 mu / [(2 mu + 1)(mu + 2) - 2 (a/b)^3 (mu - 1)^2] (Jackson, eq. 5.121).
    """

    dimension: ClassVar[int] = 3


def permeable_sphere(thickness_ratio: float, relative_permeability: float) -> PermeableSphere:
    """Shell of mid radius 1 in a unit field, with mu0 = 1."""
    return PermeableSphere(1.0 - 0.5 * thickness_ratio, 1.0 + 0.5 * thickness_ratio, relative_permeability)
