"""The shell: a mid-surface with a thickness and a material."""

from __future__ import annotations

from embedding.scene.materials import Material
from embedding.scene.part import Part
from embedding.scene.shapes import Shape
from embedding.scene.units import Density, Length, Ratio


class Shell(Part):
    """A thin body around ``shape``; permittivity and permeability are relative to vacuum, None if unknown.

    ``density`` in kg/m^3 is needed under gravity.
    """

    shape: Shape
    thickness: Length
    material: Material
    density: Density | None = None
    relative_permittivity: Ratio | None = None
    relative_permeability: Ratio | None = None
