"""Reference mid-surfaces: their edges, whether they are closed, their size, the reductions that fit them."""

from __future__ import annotations

from typing import Annotated

from pydantic import Discriminator, Tag

from embedding.scene.part import kind_under
from embedding.scene.shapes.base import Point, Revolved, Surface
from embedding.scene.shapes.file import SurfaceFile
from embedding.scene.shapes.flat import Annulus, Disc, Plate, TSection
from embedding.scene.shapes.round import Cap, Cone, Cylinder, Ellipsoid, Hemisphere, Sphere, Torus
from embedding.scene.shapes.section import Arch, InfiniteCylinder, Strip

Shape = Annotated[
    Annotated[Plate, Tag("plate")]
    | Annotated[Disc, Tag("disc")]
    | Annotated[Annulus, Tag("annulus")]
    | Annotated[Sphere, Tag("sphere")]
    | Annotated[Cylinder, Tag("cylinder")]
    | Annotated[Cap, Tag("cap")]
    | Annotated[Hemisphere, Tag("hemisphere")]
    | Annotated[Cone, Tag("cone")]
    | Annotated[Torus, Tag("torus")]
    | Annotated[Ellipsoid, Tag("ellipsoid")]
    | Annotated[TSection, Tag("t-section")]
    | Annotated[InfiniteCylinder, Tag("infinite-cylinder")]
    | Annotated[Strip, Tag("strip")]
    | Annotated[Arch, Tag("arch")]
    | Annotated[SurfaceFile, Tag("file")],
    Discriminator(kind_under("kind")),
]

__all__ = [
    "Annulus",
    "Arch",
    "Cap",
    "Cone",
    "Cylinder",
    "Disc",
    "Ellipsoid",
    "Hemisphere",
    "InfiniteCylinder",
    "Plate",
    "Point",
    "Revolved",
    "Shape",
    "Sphere",
    "Strip",
    "Surface",
    "SurfaceFile",
    "TSection",
    "Torus",
]
