"""Mechanical loads: pressures on the two faces, forces on the surface, on edges and lines, at points, in the volume.

Every load refers to the whole body, also where the plan meshes only the part between mirror planes.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Tag, model_validator

from embedding.scene.messages import TABLE, VALUE, refusal
from embedding.scene.part import Part
from embedding.scene.surface_fields import PressureField, value_or_table
from embedding.scene.texts import Name
from embedding.scene.units import (
    AccelerationVector,
    EdgeMomentValue,
    ForceDensityVector,
    ForceVector,
    LengthVector,
    LineForceVector,
    Pressure,
    PressureVector,
)
from embedding.scene.vector_fields import ForceField

FacePressure = Annotated[
    Annotated[Pressure, Tag(VALUE)] | Annotated[PressureField, Tag(TABLE)],
    Discriminator(value_or_table(PressureField)),
]
SurfaceForce = Annotated[
    Annotated[PressureVector, Tag(VALUE)] | Annotated[ForceField, Tag(TABLE)],
    Discriminator(value_or_table(ForceField)),
]


class EdgeTraction(Part):
    """A load on an edge of the shape, in N per metre of the reference edge.

    ``frame`` says what the three components are along: x, y and z ("global"), or the outward conormal, the edge
    (counter-clockwise seen from the top) and the normal towards the top ("edge"). A "follower" load turns with the
    edge's frame and keeps its components; a "dead" one keeps its direction.
    """

    edge: Name
    traction: LineForceVector
    frame: Literal["global", "edge"] = "global"
    kind: Literal["dead", "follower"] = "dead"

    @model_validator(mode="after")
    def _follower_has_a_frame(self) -> Self:
        if self.kind == "follower" and self.frame == "global":
            raise refusal('a load that follows the edge needs frame = "edge"', field="kind", value=self.kind)
        return self


class LineLoad(Part):
    """A dead load on a named curve of the shape, edge or junction, in N per metre of the reference curve."""

    line: Name
    force: LineForceVector


class EdgeMoment(Part):
    """A moment about the edge's tangent, in N m per metre of the reference edge.

    Positive turns the outward conormal towards the top normal. It follows the edge.
    """

    edge: Name
    moment: EdgeMomentValue


class PointLoad(Part):
    """A dead force in N at a point of the reference mid-surface, given in m."""

    at: LengthVector
    force: ForceVector


class Loads(Part):
    """Mechanical loads; positive pressures push on their face (top along -n, bottom along +n).

    ``surface_force`` is a dead force per reference area, ``body_force`` one per reference volume, ``gravity`` an
    acceleration that acts on ``shell.density``. ``rim`` says whether the thin rim face is free or pressed by the mean
    of the two pressures. ``variant`` selects how face pressures act: with the shell's finite thickness
    ("embedding-aware"), as their difference on the mid-surface ("net"), or in the form first published
    ("as-published").
    """

    pressure_top: FacePressure = 0.0
    pressure_bottom: FacePressure = 0.0
    surface_force: SurfaceForce = (0.0, 0.0, 0.0)
    edge_tractions: tuple[EdgeTraction, ...] = ()
    line_loads: tuple[LineLoad, ...] = ()
    edge_moments: tuple[EdgeMoment, ...] = ()
    point_loads: tuple[PointLoad, ...] = ()
    body_force: ForceDensityVector = (0.0, 0.0, 0.0)
    gravity: AccelerationVector = (0.0, 0.0, 0.0)
    rim: Literal["traction-free", "pressurised"] = "traction-free"
    variant: Literal["embedding-aware", "net", "as-published"] = "embedding-aware"

    @property
    def any(self) -> bool:
        """Is there a load?"""
        return self != Loads(rim=self.rim, variant=self.variant)

    @property
    def pressure_fields(self) -> dict[str, PressureField]:
        """The face pressures that vary over the surface, by their field name."""
        pressures = {"pressure_top": self.pressure_top, "pressure_bottom": self.pressure_bottom}
        return {name: value for name, value in pressures.items() if isinstance(value, PressureField)}

    @property
    def dead_vectors(self) -> dict[str, tuple[float, float, float]]:
        """The constant vectors in global components, by the path of their field under ``loads``."""
        vectors: dict[str, Any] = {"body_force": self.body_force, "gravity": self.gravity}
        if not isinstance(self.surface_force, ForceField):
            vectors["surface_force"] = self.surface_force
        for i, traction in enumerate(self.edge_tractions):
            if traction.frame == "global":
                vectors[f"edge_tractions.{i}.traction"] = traction.traction
        for i, load in enumerate(self.line_loads):
            vectors[f"line_loads.{i}.force"] = load.force
        return vectors
