"""From a shape to its geometry."""

from __future__ import annotations

import math

from embedding.geometry import file, plates, revolution, surface
from embedding.geometry.outline import Outline
from embedding.geometry.reduction import Reduction
from embedding.scene import (
    Annulus,
    Arch,
    Cap,
    Cone,
    Cylinder,
    Disc,
    Ellipsoid,
    Hemisphere,
    InfiniteCylinder,
    Plate,
    Shape,
    Sphere,
    Strip,
    SurfaceFile,
    Torus,
    TSection,
)

WHOLE_TURN = (0.0, 2 * math.pi)


def outline(shape: Shape, reduction: Reduction) -> Outline:
    """The geometry of the dimensionless ``shape``: lengths are divided by its size."""
    match shape:
        case Plate():
            planes = reduction.planes if shape.centred else None
            return surface.plate(shape.length / shape.size, shape.width / shape.size, planes)
        case Disc():
            return surface.disc(reduction)
        case Sphere():
            return surface.sphere(reduction)
        case Ellipsoid():
            a, b, c = (axis / shape.size for axis in shape.semi_axes)
            return surface.ellipsoid((a, b, c), reduction)
        case InfiniteCylinder():
            return surface.ring(reduction)
        case Strip():
            return surface.strip()
        case Arch():
            return surface.arch(shape.radius / shape.size, shape.half_angle)
        case SurfaceFile():
            return file.file(shape)
        case TSection():
            return plates.t_section()
        case Annulus() if shape.slit:
            return plates.slit_ring(shape.inner_radius / shape.size, 1.0)
        case Torus():
            meridian, sector = revolution.torus(shape, "z" in reduction.planes), WHOLE_TURN
        case Annulus():
            meridian, sector = revolution.annulus(shape), revolution.sector(shape)
        case Cylinder():
            meridian, sector = revolution.cylinder(shape, "z" in reduction.planes), revolution.sector(shape)
        case Cap() | Hemisphere():
            meridian, sector = revolution.cap(shape), revolution.sector(shape)
        case Cone():
            meridian, sector = revolution.cone(shape), revolution.sector(shape)
    return revolution.outline(meridian, reduction, sector)
