"""A permeable (or dielectric) infinite tube in a uniform transverse field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from problems.exact.three_regions import ThreeRegions


@dataclass(frozen=True)
class PermeableCylinder(ThreeRegions):
    """Circular tube; all results in `ThreeRegions`, moments and energies per axial length.

    H_inner / H0 = 4 mu / [(mu + 1)^2 - (a/b)^2 (mu - 1)^2] (the two-dimensional matching in closed form).
    """

    dimension: ClassVar[int] = 2


def permeable_cylinder(thickness_ratio: float, relative_permeability: float) -> PermeableCylinder:
    """Tube of mid radius 1 in a unit field, with mu0 = 1."""
    return PermeableCylinder(1.0 - 0.5 * thickness_ratio, 1.0 + 0.5 * thickness_ratio, relative_permeability)
