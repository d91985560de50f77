"""From a shape to its mesh: the shell alone, or as an interface inside the ambient."""

from __future__ import annotations

import math

from ngsolve import Mesh

from embedding.geometry import file, plates, revolution, surface, surroundings
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import MeshSizes
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


def mesh(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Mesh:
    """Straight-sided mesh of the dimensionless ``shape``: lengths are divided by its size."""
    if sizes.radius:
        make = surroundings.sphere_in_ball if isinstance(shape, Sphere) else surroundings.ring_in_disc
        return make(reduction, sizes.radius, sizes.shell, sizes.far, sizes.grading)
    match shape:
        case Plate():
            return surface.plate(shape.length / shape.size, shape.width / shape.size, sizes)
        case Disc():
            return surface.disc(reduction, sizes)
        case Sphere():
            return surface.sphere(reduction, sizes)
        case Ellipsoid():
            a, b, c = (axis / shape.size for axis in shape.semi_axes)
            return surface.ellipsoid((a, b, c), reduction, sizes)
        case InfiniteCylinder():
            return surface.ring(reduction, sizes)
        case Strip():
            return surface.strip(sizes)
        case Arch():
            return surface.arch(shape.radius / shape.size, shape.half_angle, sizes)
        case SurfaceFile():
            return file.file(shape, sizes)
        case TSection():
            return plates.t_section(sizes)
        case Annulus() if shape.slit:
            return plates.slit_ring(shape.inner_radius / shape.size, 1.0, sizes)
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
    return revolution.mesh(meridian, reduction, sector, sizes)
