"""Mean curvature of the reference mid-surface: exact where the shape is a formula, else from the mesh's normal.

H = - 1/2 div_S N, so that H = - 1/R on a sphere with outward normal N (theory page, "Conventions").
"""

from __future__ import annotations

from typing import Any

from ngsolve import CF, Grad, IfPos, Trace, sqrt, x

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
    Torus,
    TSection,
)

FLAT = Plate | Disc | Annulus | Strip | TSection


def mean_curvature(shape: Shape, reduction: Reduction, sign: Any) -> Any:
    """H of the dimensionless ``shape`` as a coefficient function on the shell.

    ``sign`` turns the mesh's own normal into N.
    """
    if isinstance(shape, FLAT):
        return CF(0.0)
    position = reduction.position
    square = position[0] * position[0]
    distance = x if reduction.name == "axisymmetric" else sqrt(square + position[1] * position[1])
    if isinstance(shape, Sphere | Cap | Hemisphere):
        return CF(-shape.size / shape.radius)
    if isinstance(shape, InfiniteCylinder | Arch):
        return CF(-shape.size / (2 * shape.radius))
    if isinstance(shape, Cylinder):
        wall = CF(-shape.size / (2 * shape.radius))
        along = reduction.normal[reduction.dimension - 1]
        return IfPos(along * along - 0.5, CF(0.0), wall) if shape.closed else wall
    if isinstance(shape, Cone):
        return -shape.height / shape.slant / (2 * distance)
    if isinstance(shape, Torus):
        tube, centre = shape.tube_radius / shape.size, shape.radius / shape.size
        return -0.5 * (1 / tube + (distance - centre) / (tube * distance))
    if isinstance(shape, Ellipsoid):
        return _ellipsoid(tuple(axis / shape.size for axis in shape.semi_axes), reduction)
    return mesh_curvature(reduction, sign)


def _ellipsoid(axes: tuple[float, ...], reduction: Reduction) -> Any:
    """- 1/2 div (g / |g|) with g = grad of the quadratic form that is 1 on the surface."""
    place, used = reduction.position, axes if reduction.dimension == 3 else (axes[0], axes[2])
    squares = [(place[i] * place[i], a) for i, a in enumerate(used)]
    gradient = sum((s / a**4 for s, a in squares), CF(0.0))
    stretched = sum((s / a**6 for s, a in squares), CF(0.0))
    return -0.5 * (sum(1 / a**2 for a in axes) - stretched / gradient) / sqrt(gradient)


def mesh_curvature(reduction: Reduction, sign: Any) -> Any:
    """H from the gradient of the mesh's own normal, the hoop's part included; an order of the geometry is lost."""
    normal = reduction.normal
    divergence = Trace(Grad(normal))
    if reduction.name == "axisymmetric":
        divergence = divergence + normal[0] / x
    return -0.5 * sign * divergence
