"""Coordinates of the mid-surface: convected by its motion, with lengths as units (angles count times the shape's size).

Meshes of triangles have no coordinates of their own that mean anything from one element to the next, so these are used:

* ``frame``        in 3D at every point the normal coordinates along the frame of ``Derivatives``: A_1 and A_2 are
                   orthonormal and Gamma = 0 there, so that gamma is what the deformation alone makes of it. In an
                   axisymmetric mesh (arc length of the meridian, angle phi), in plane strain (arc length, z)
* ``polar``        (distance from the z axis, angle phi about it)
* ``cylindrical``  (phi, z)
* ``spherical``    (angle from the z axis, phi)

For a pair of functions theta^a of position, A^a = P grad theta^a and
Gamma^a_bc = - A_b . (Hess theta^a + (grad theta^a . N) K) A_c, the surface's own Hessian. Source: differentiation of
A^a . A_b = delta^a_b; M. do Carmo, Differential Geometry of Curves and Surfaces (1976), section 4-3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ngsolve import CF, IfPos, InnerProduct, OuterProduct, sqrt

from embedding.shell.derivatives import Derivatives, dual

ON_AXIS = 1e-9
Coordinates = Literal["frame", "polar", "cylindrical", "spherical"]
Pair = tuple[Any, Any]
Triple = tuple[Any, Any, Any]


@dataclass(frozen=True)
class Chart:
    """``tangents`` A_1, A_2 of shape (3,); ``christoffel`` holds Gamma^a_11, Gamma^a_12, Gamma^a_22 for a = 1, 2."""

    tangents: tuple[Any, Any]
    christoffel: tuple[Triple, Triple]


def chart(derivatives: Derivatives, coordinates: Coordinates = "frame") -> Chart:
    """The reference chart of the mid-surface in the named ``coordinates``."""
    if coordinates != "frame":
        return _of_functions(derivatives, [FUNCTIONS[name] for name in PAIRS[coordinates]])
    if derivatives.reduction.name != "axisymmetric":
        return normal_chart(derivatives)
    first, second = derivatives.frame
    zero, radius, slope = CF(0.0), _off_axis(derivatives.position[0]), first[0]
    return Chart((first, radius * second), ((zero, zero, -radius * slope), (zero, slope / radius, zero)))


def normal_chart(derivatives: Derivatives) -> Chart:
    """At every point the normal coordinates along the orthonormal frame; regular on the axis too."""
    nothing = (CF(0.0), CF(0.0), CF(0.0))
    return Chart(derivatives.frame, (nothing, nothing))


def _of_functions(derivatives: Derivatives, functions: list[Any]) -> Chart:
    normal, curvature = derivatives.reference_normal, derivatives.curvature
    duals, hessians = [], []
    for function in functions:
        gradient, hessian = function(derivatives.position)
        upright = InnerProduct(gradient, normal)
        duals.append(gradient - upright * normal)
        hessians.append(hessian + upright * curvature)
    a, b = tangents = dual((duals[0], duals[1]))
    symbols = [tuple(-InnerProduct(p, h * q) for p, q in ((a, a), (a, b), (b, b))) for h in hessians]
    return Chart(tangents, (symbols[0], symbols[1]))


def _directions(place: Any) -> tuple[Any, Any, Any]:
    """Distance from the z axis, and the unit vectors away from it and around it."""
    distance = _off_axis(sqrt(place[0] * place[0] + place[1] * place[1]))
    return distance, CF((place[0], place[1], 0.0)) / distance, CF((-place[1], place[0], 0.0)) / distance


def _off_axis(distance: Any) -> Any:
    """A distance from the axis that is plainly 0 on it: what is singular there is then seen not to be finite."""
    return IfPos(distance - ON_AXIS, distance, 0.0)


def _radius(place: Any) -> tuple[Any, Any]:
    distance, away, around = _directions(place)
    return away, OuterProduct(around, around) / distance


def _angle(place: Any) -> tuple[Any, Any]:
    distance, away, around = _directions(place)
    mixed = OuterProduct(away, around) + OuterProduct(around, away)
    return around / distance, -1 * mixed / (distance * distance)


def _height(place: Any) -> tuple[Any, Any]:
    return CF((0.0, 0.0, 1.0)), CF((0.0,) * 9, dims=(3, 3))


def _colatitude(place: Any) -> tuple[Any, Any]:
    distance, away, around = _directions(place)
    square = InnerProduct(place, place)
    length = sqrt(square)
    out, down = place / length, (place[2] * away - distance * CF((0.0, 0.0, 1.0))) / length
    mixed = OuterProduct(out, down) + OuterProduct(down, out)
    return down / length, (place[2] / distance * OuterProduct(around, around) - mixed) / square


FUNCTIONS = {"radius": _radius, "angle": _angle, "height": _height, "colatitude": _colatitude}
"""Gradient (3,) and Hessian (3, 3) of a function of position."""
PAIRS = {"polar": ("radius", "angle"), "cylindrical": ("angle", "height"), "spherical": ("colatitude", "angle")}
