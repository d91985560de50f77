"""The shell: a mid-surface with a thickness and a material, the same everywhere or not."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Discriminator, Tag, model_validator

from embedding.scene.materials import Material
from embedding.scene.messages import TABLE, VALUE, refusal
from embedding.scene.part import Part, known
from embedding.scene.shapes import Shape
from embedding.scene.surface_fields import ThicknessField, value_or_table
from embedding.scene.texts import Names
from embedding.scene.units import Density, FluxDensityVector, Length, PolarisationVector, PositiveFluxDensity, Ratio
from embedding.scene.vector_fields import PolarisationField, RemanenceField, VectorField

Thickness = Annotated[
    Annotated[Length, Tag(VALUE)] | Annotated[ThicknessField, Tag(TABLE)],
    Discriminator(value_or_table(ThicknessField)),
]


Remanence = Annotated[
    Annotated[FluxDensityVector, Tag(VALUE)] | Annotated[RemanenceField, Tag(TABLE)],
    Discriminator(value_or_table(RemanenceField)),
]
Polarisation = Annotated[
    Annotated[PolarisationVector, Tag(VALUE)] | Annotated[PolarisationField, Tag(TABLE)],
    Discriminator(value_or_table(PolarisationField)),
]


def _some(value: Any) -> Any:
    if not value:
        raise refusal('must be a list of different names of faces, such as ["web"]')
    return value


class Region(Part):
    """Faces of the shape with properties of their own; None: that of the shell."""

    faces: Annotated[Names, BeforeValidator(_some)]
    thickness: Thickness | None = None
    material: Material | None = None
    density: Density | None = None
    relative_permittivity: Ratio | None = None
    relative_permeability: Ratio | None = None
    remanence: Remanence | None = None
    polarisation: Polarisation | None = None
    saturation: PositiveFluxDensity | None = None

    @model_validator(mode="after")
    def _differs(self) -> Self:
        own = (getattr(self, name) for name in type(self).model_fields if name != "faces")
        if all(value is None for value in own):
            reason = "a region needs a thickness, a material or another property of its own"
            raise refusal(reason, field="faces", value=self.faces)
        return self


class Shell(Part):
    """A thin body around ``shape``; permittivity and permeability are relative to vacuum, None if unknown.

    ``thickness`` in m is a number or an expression of the place, ``density`` in kg/m^3 is needed under gravity.
    ``regions`` are faces of the shape that differ from the rest.

    ``remanence`` in T is a magnetisation that the material carries: B_r = F B~_r, given by its components in the
    reference; ``polarisation`` in C/m^2 is the same of an electret. Both are vectors or expressions of the place.
    ``saturation`` in T is the limit mu_0 M_s of the magnetisation that a magnetic field induces.
    """

    shape: Shape
    thickness: Thickness
    material: Material
    density: Density | None = None
    regions: tuple[Region, ...] = ()
    relative_permittivity: Ratio | None = None
    relative_permeability: Ratio | None = None
    remanence: Remanence | None = None
    polarisation: Polarisation | None = None
    saturation: PositiveFluxDensity | None = None

    @property
    def vector_fields(self) -> dict[str, VectorField]:
        """The remanences and polarisations that vary over the surface, by the path of their field under ``shell``."""
        return {path: value for path, value in self.carried.items() if isinstance(value, VectorField)}

    @property
    def constant_vectors(self) -> dict[str, tuple[float, float, float]]:
        """Those that are the same everywhere, by the path of their field under ``shell``."""
        return {path: value for path, value in self.carried.items() if isinstance(value, tuple)}

    @property
    def carried(self) -> dict[str, VectorField | tuple[float, float, float]]:
        """Every remanence and polarisation, by the path of its field under ``shell``."""
        names = ("remanence", "polarisation")
        stated: dict[str, Any] = {name: getattr(self, name) for name in names}
        stated |= {f"regions.{i}.{name}": getattr(part, name) for i, part in enumerate(self.regions) for name in names}
        return {path: value for path, value in stated.items() if known(value) is not None}

    @property
    def thickness_fields(self) -> dict[str, ThicknessField]:
        """The thicknesses that vary over the surface, by the path of their field under ``shell``."""
        stated: dict[str, Any] = {"thickness": self.thickness}
        stated |= {f"regions.{i}.thickness": region.thickness for i, region in enumerate(self.regions)}
        return {path: value for path, value in stated.items() if isinstance(value, ThicknessField)}

    @property
    def materials(self) -> tuple[Material, ...]:
        """The material of the shell and those of its regions."""
        return (self.material, *(region.material for region in self.regions if region.material is not None))

    @property
    def thickest(self) -> float:
        """The largest thickness, in m; of an expression the largest value at a few points of the shape."""
        stated = [self.thickness, *(region.thickness for region in self.regions if region.thickness is not None)]
        return max(_largest(value, self.shape) for value in stated)


def _largest(thickness: float | ThicknessField, shape: Shape) -> float:
    if isinstance(thickness, ThicknessField):
        return max(thickness.values_at(shape.sample_points()), default=0.0)
    return thickness
