"""The shell: a mid-surface with a thickness and a material, and where it is held."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator

from embedding.scene.materials import Material
from embedding.scene.messages import refusal
from embedding.scene.part import Part
from embedding.scene.shapes import Shape
from embedding.scene.texts import Name
from embedding.scene.units import Length, Ratio

Axis = Literal["x", "y", "z"]


class Shell(Part):
    """A thin body around ``shape``; permittivity and permeability are relative to vacuum, None if unknown."""

    shape: Shape
    thickness: Length
    material: Material
    relative_permittivity: Ratio | None = None
    relative_permeability: Ratio | None = None


def _axes(value: Any) -> Any:
    if not isinstance(value, (list, tuple)) or not value or len(set(map(str, value))) < len(value):
        raise refusal('must be a list of different axes, such as ["x", "z"]')
    return value


class Support(Part):
    """Displacements that are held at zero.

    ``where`` is an edge of the shape or "surface", the whole shell; ``fix`` lists the directions. In an
    axisymmetric reduction x and y both mean the radial direction.
    """

    where: Name
    fix: Annotated[tuple[Axis, ...], BeforeValidator(_axes), AfterValidator(lambda axes: tuple(sorted(axes)))]
