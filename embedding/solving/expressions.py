"""Expressions of a scene as coefficient functions on the dimensionless mesh."""

from __future__ import annotations

from typing import Any

import ngsolve

from embedding.geometry.reduction import Reduction
from embedding.scene import Scales
from embedding.scene.surface_fields import SurfaceField
from embedding.shell.functions import SYMBOLIC


def over_surface(field: SurfaceField, reduction: Reduction, scales: Scales) -> Any:
    """The SI values of ``field``; in axisymmetry those of the half plane y = 0, x >= 0."""
    x, y, z = (scales.length * c for c in (ngsolve.x, ngsolve.y, ngsolve.z))
    zero = ngsolve.CF(0.0)
    place = {"3d": (x, y, z), "axisymmetric": (x, zero, y), "plane-strain": (x, y, zero)}[reduction.name]
    return ngsolve.CF(field(*place, SYMBOLIC))


def vector_at(field: Any, place: Any, reduction: Reduction, scales: Scales) -> Any:
    """SI values (mesh components) of a field of three expressions at ``place``, a position on the mesh (d,)."""
    x, y = (scales.length * place[i] for i in (0, 1))
    zero = ngsolve.CF(0.0)
    three = {
        "3d": lambda: (x, y, scales.length * place[2]),
        "axisymmetric": lambda: (x, zero, y),
        "plane-strain": lambda: (x, y, zero),
    }[reduction.name]()
    a, b, c = (component(*three, SYMBOLIC) for component in field.components)
    return ngsolve.CF({"3d": (a, b, c), "axisymmetric": (a, c), "plane-strain": (a, b)}[reduction.name])


def vector_over_surface(field: Any, reduction: Reduction, scales: Scales) -> Any:
    """SI values (mesh components) over the reference surface of a constant vector, or of a field of expressions."""
    if isinstance(field, tuple):
        return ngsolve.CF(reduction.project(field))
    return vector_at(field, reduction.position, reduction, scales)
