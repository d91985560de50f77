"""Every shape with closed forms of its area, volume, edges, normal and curvature, for sizes of order one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from embedding import (
    Annulus,
    Arch,
    Cap,
    Cone,
    Cylinder,
    Ellipsoid,
    Hemisphere,
    Strip,
    Torus,
    TSection,
)
from embedding.geometry.domain import Domain, MeshSizes, Shape, build
from embedding.geometry.reduction import Reduction

Array = npt.NDArray[np.float64]
Field = Callable[[Array], Array]
PI = math.pi
FORTY, HOLE = math.radians(40), math.radians(18)


def upwards(axis: int) -> Field:
    """The unit vector along an axis."""
    return lambda x: np.eye(3)[axis] + 0 * x


def radial(x: Array) -> Array:
    """Away from the z axis."""
    across = x * (1.0, 1.0, 0.0)
    return np.asarray(across / np.linalg.norm(across, axis=1)[:, None])


def central(x: Array) -> Array:
    """Away from the origin."""
    return np.asarray(x / np.linalg.norm(x, axis=1)[:, None])


def of_capped(x: Array) -> Array:
    """Radial on the wall, along z on the caps of a cylinder of length 2."""
    on_cap = np.abs(np.abs(x[:, 2:]) - 1) < 1e-9
    return np.where(on_cap, np.sign(x) * (0.0, 0.0, 1.0), radial(np.where(on_cap, x + (1e-9, 0.0, 0.0), x)))


def of_cone(x: Array) -> Array:
    """Normal of the cone from radius 1 at z = 0 to 0.4 at z = 1."""
    return np.asarray((radial(x) + (0.0, 0.0, 0.6)) / math.hypot(1.0, 0.6))


def of_torus(x: Array) -> Array:
    """Away from the circle of radius 1."""
    away = (x - radial(x)) / 0.3
    return np.asarray(away / np.linalg.norm(away, axis=1)[:, None])


def of_ellipsoid(*axes: float) -> Field:
    """Gradient of the quadratic form."""

    def normal(x: Array) -> Array:
        gradient = x / np.square(axes)
        return np.asarray(gradient / np.linalg.norm(gradient, axis=1)[:, None])

    return normal


def of_t(x: Array) -> Array:
    """Along z on the top plate, along x on the other."""
    return np.where(x[:, 2:] > 1 - 1e-9, upwards(2)(x), upwards(0)(x))


def ellipsoid_area(a: float, b: float, c: float) -> float:
    """By quadrature over angles; the trapezoidal rule converges geometrically in the periodic one."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    polar, azimuth = (nodes[:, None] + 1) * PI / 2, 2 * PI * np.arange(120) / 120
    s, k = np.sin(polar), np.cos(polar)
    density = s * np.sqrt((b * c * s * np.cos(azimuth)) ** 2 + (a * c * s * np.sin(azimuth)) ** 2 + (a * b * k) ** 2)
    return float((weights[:, None] * density).sum() * PI / 2 * 2 * PI / 120)


@dataclass(frozen=True)
class Case:
    """A shape of size 1 and what is known of it; ``edges`` holds lengths, ``volume`` is None on open shapes."""

    shape: Shape
    area: float
    normal: Field
    curvature: Field
    edges: dict[str, float] = field(default_factory=dict)
    rims: tuple[str, ...] | None = None
    volume: float | None = None

    @property
    def true_edges(self) -> set[str]:
        """Names of edges that bound the shape."""
        return set(self.edges) if self.rims is None else set(self.rims)


def flat(x: Array) -> Array:
    """No curvature."""
    return 0 * x[:, 0]


def constant(value: float) -> Field:
    """The same mean curvature everywhere."""
    return lambda x: value + 0 * x[:, 0]


def cone_curvature(x: Array) -> Array:
    """- cos(slope) / 2r."""
    return np.asarray(-1 / math.hypot(1.0, 0.6) / (2 * np.hypot(x[:, 0], x[:, 1])))


def torus_curvature(x: Array) -> Array:
    """From 1/a along the tube and cos(angle) / r around the axis."""
    r = np.hypot(x[:, 0], x[:, 1])
    return np.asarray(-0.5 * (1 / 0.3 + (r - 1) / 0.3 / r))


def capped_curvature(x: Array) -> Array:
    """Of the wall, and none on the caps."""
    return np.where(np.abs(np.abs(x[:, 2]) - 1) < 1e-9, 0.0, -0.5)


def spheroid_curvature(a: float, c: float) -> Field:
    """Meridian of a spheroid, radius a across and c along the axis: curvatures a c / w^3 and c / (a w)."""

    def curvature(x: Array) -> Array:
        angle = np.arctan2(np.hypot(x[:, 0], x[:, 1]) / a, x[:, 2] / c)
        w = np.sqrt((a * np.cos(angle)) ** 2 + (c * np.sin(angle)) ** 2)
        return np.asarray(-0.5 * (a * c / w**3 + c / (a * w)))

    return curvature


def _revolved(shape: type[Shape], sector: float, sides: float, area: float, edges: dict[str, float], **keys: float):  # type: ignore[no-untyped-def]
    """The whole turn and a sector of ``sector`` radians with sides of length ``sides``."""
    part = sector / (2 * PI)
    whole = {"area": area, "edges": edges}
    some = {
        "area": part * area,
        "edges": {name: part * e for name, e in edges.items()} | {"side0": sides, "side1": sides},
    }
    return (shape(**keys), whole), (shape(**keys, start=-0.4, angle=sector), some)


CASES: dict[str, Case] = {}


def _add(name: str, pair: tuple[tuple[Shape, dict], tuple[Shape, dict]], normal: Field, curvature: Field) -> None:  # type: ignore[type-arg]
    for label, (shape, known) in zip((name, f"sector of {name}"), pair, strict=True):
        CASES[label] = Case(shape, normal=normal, curvature=curvature, **known)


_add(
    "annulus",
    _revolved(Annulus, 1.9, 0.4, PI * 0.64, {"inner": 1.2 * PI, "outer": 2 * PI}, inner_radius=0.6, outer_radius=1.0),
    upwards(2),
    flat,
)
_add(
    "cylinder",
    _revolved(Cylinder, 1.9, 2.0, 4 * PI, {"end0": 2 * PI, "end1": 2 * PI}, radius=1.0, length=2.0),
    radial,
    constant(-0.5),
)
_add(
    "cap",
    _revolved(Cap, 1.9, 2.0, 2 * PI * (1 - math.cos(2.0)), {"rim": 2 * PI * math.sin(2.0)}, radius=1.0, half_angle=2.0),
    central,
    constant(-1.0),
)
_add(
    "hemisphere",
    _revolved(
        Hemisphere,
        1.9,
        PI / 2 - HOLE,
        2 * PI * math.cos(HOLE),
        {"rim": 2 * PI, "hole": 2 * PI * math.sin(HOLE)},
        radius=1.0,
        hole_half_angle=HOLE,
    ),
    central,
    constant(-1.0),
)
_add(
    "cone",
    _revolved(
        Cone,
        1.9,
        math.hypot(1.0, 0.6),
        PI * 1.4 * math.hypot(1.0, 0.6),
        {"end0": 2 * PI, "end1": 0.8 * PI},
        radius=1.0,
        top_radius=0.4,
        height=1.0,
    ),
    of_cone,
    cone_curvature,
)
CASES |= {
    "slit ring": Case(
        Annulus(inner_radius=0.6, outer_radius=1.0, slit=True),
        PI * 0.64,
        upwards(2),
        flat,
        {"inner": 1.2 * PI, "outer": 2 * PI, "lip0": 0.4, "lip1": 0.4},
    ),
    "half cylinder": Case(
        Cylinder(radius=1.0, length=2.0, half=True), 2 * PI, radial, constant(-0.5), {"end0": 2 * PI, "end1": 2 * PI}
    ),
    "whole hemisphere": Case(Hemisphere(radius=1.0), 2 * PI, central, constant(-1.0), {"rim": 2 * PI}),
    "T": Case(
        TSection(length=1.0),
        2.0,
        of_t,
        flat,
        {"bottom": 1.0, "left": 1.0, "right": 1.0, "front": 2.0, "back": 2.0, "junction": 1.0},
        ("bottom", "left", "right", "front", "back"),
    ),
    "capped cylinder": Case(
        Cylinder(radius=1.0, length=2.0, ends="capped"),
        6 * PI,
        of_capped,
        capped_curvature,
        {"end0": 2 * PI, "end1": 2 * PI},
        (),
        2 * PI,
    ),
    "torus": Case(Torus(radius=1.0, tube_radius=0.3), 1.2 * PI**2, of_torus, torus_curvature, volume=0.18 * PI**2),
    "oblate spheroid": Case(
        Ellipsoid(semi_axes=(1.0, 1.0, 0.6)),
        2 * PI * (1 + 0.36 / 0.8 * math.atanh(0.8)),
        of_ellipsoid(1.0, 1.0, 0.6),
        spheroid_curvature(1.0, 0.6),
        volume=4 / 3 * PI * 0.6,
    ),
    "prolate spheroid": Case(
        Ellipsoid(semi_axes=(0.6, 0.6, 1.0)),
        2 * PI * 0.36 * (1 + 1 / 0.6 / 0.8 * math.asin(0.8)),
        of_ellipsoid(0.6, 0.6, 1.0),
        spheroid_curvature(0.6, 1.0),
        volume=4 / 3 * PI * 0.36,
    ),
    "strip": Case(Strip(length=1.0), 1.0, upwards(1), flat, {"x0": 1.0, "x1": 1.0}),
    "arch": Case(Arch(radius=1.0, half_angle=2.0), 4.0, central, constant(-0.5), {"end0": 1.0, "end1": 1.0}),
}
TRIAXIAL = Ellipsoid(semi_axes=(1.0, 0.8, 0.6))
BODIES = [
    (name, reduction, planes)
    for name, case in CASES.items()
    for reduction in case.shape.reductions
    for planes in ([(), case.shape.mirrors] if reduction == "3d" and case.shape.mirrors else [()])
]
"""Every shape in every reduction that fits it, whole and between all its mirror planes."""


def body(name: str, reduction: str, planes: tuple[str, ...] = (), size: float = 0.3, order: int = 3) -> Domain:
    """The meshed shape ``name`` of ``CASES``."""
    return build(CASES[name].shape, Reduction(reduction, planes), MeshSizes(size, size, 0.0, 0.3, order))  # type: ignore[arg-type]


def embedded(domain: Domain, values: Array) -> Array:
    """Places or vectors on the mesh, as rows in space."""
    return domain.reduction.embed(values)
