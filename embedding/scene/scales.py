"""The scales of a scene: the solver works with numbers of order one, these carry them back to SI."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

EPSILON_0 = 8.8541878128e-12
"""Vacuum electric permittivity in F/m (CODATA 2018)."""
MU_0 = 1.25663706212e-6
"""Vacuum magnetic permeability in H/m (CODATA 2018)."""


@dataclass(frozen=True)
class Scales:
    """Length (m), stress (Pa) and permittivity (F/m) or permeability (H/m); the rest follows from them."""

    length: float
    stress: float
    permittivity: float

    @classmethod
    def of(cls, scene: Scene) -> Scales:
        """Size of the shape, shear modulus, vacuum constant of the scene's field (electric without one)."""
        magnetic = scene.ambient is not None and scene.ambient.field == "magnetic"
        shell = scene.shell
        return cls(shell.shape.size, shell.material.shear_modulus, MU_0 if magnetic else EPSILON_0)

    @property
    def area(self) -> float:
        """m^2."""
        return self.length**2

    @property
    def volume(self) -> float:
        """m^3."""
        return self.length**3

    @property
    def force(self) -> float:
        """N."""
        return self.stress * self.area

    @property
    def line_force(self) -> float:
        """N/m."""
        return self.stress * self.length

    @property
    def force_density(self) -> float:
        """N/m^3."""
        return self.stress / self.length

    @property
    def energy(self) -> float:
        """J."""
        return self.stress * self.volume

    @property
    def magnetic(self) -> bool:
        """Is the field a magnetic one?"""
        return self.permittivity == MU_0

    @property
    def field(self) -> float:
        """V/m, or A/m for a magnetic scene: the field whose Maxwell stress is of the size of ``stress``."""
        return sqrt(self.stress / self.permittivity)

    @property
    def potential(self) -> float:
        """V, or A for a magnetic scene."""
        return self.length * self.field

    @property
    def flux_density(self) -> float:
        """C/m^2, or T for a magnetic scene."""
        return self.permittivity * self.field

    @property
    def charge(self) -> float:
        """C, or Wb for a magnetic scene."""
        return self.flux_density * self.area
