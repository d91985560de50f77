"""Thick spherical shell and plane-strain ring as incompressible neo-Hookean solids, loaded on their faces.

Displacement and pressure are both unknown (Taylor-Hood, orders k and k - 1, on quadrilaterals). The elements
live on the rectangle (rho, theta), -1/2 < rho < 1/2 through the wall and 0 < theta < pi/2 from pole to
equator; the circle enters exactly through X = (1 + T rho) (sin theta, cos theta): no curved elements, no
error of the geometry.
"""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from ngsolve import CF, H1, BilinearForm, Grad, GridFunction, Parameter, Variation, VectorH1, cos, ds, dx, sin
from ngsolve import x as rho
from ngsolve import y as theta
from ngsolve.meshes import MakeStructured2DMesh

from tests.solids import NINE_ANGLES, Array, Loading, MidSurface, Profile, require_even
from tests.solids.newton import solve_in_steps

Body = Literal["sphere", "ring"]


def thick_sphere(
    thickness_ratio: float,
    p_top: Profile,
    p_bottom: Profile,
    *,
    order: int = 5,
    elements: tuple[int, int] = (1, 8),
    load_steps: int = 4,
    angles: Array = NINE_ANGLES,
) -> MidSurface:
    """Mid-surface of the thick sphere under follower pressures on its outer and inner face.

    `elements`: through the wall, and from pole to equator; `angles`: where to report. Raises ValueError for a
    pressure that is not even, RuntimeError where Newton's method fails (a limit point is near: take more
    steps or less load).
    """
    return _solve("sphere", thickness_ratio, Loading(p_top, p_bottom), order, elements, load_steps, angles)


def thick_ring(
    thickness_ratio: float,
    p_top: Profile,
    p_bottom: Profile,
    *,
    order: int = 5,
    elements: tuple[int, int] = (1, 8),
    load_steps: int = 4,
    angles: Array = NINE_ANGLES,
) -> MidSurface:
    """Mid-line of the thick ring, a tube's section in plane strain; arguments as `thick_sphere`."""
    return _solve("ring", thickness_ratio, Loading(p_top, p_bottom), order, elements, load_steps, angles)


def _solve(
    body: Body,
    thickness: float,
    loading: Loading,
    order: int,
    elements: tuple[int, int],
    load_steps: int,
    angles: Array,
) -> MidSurface:
    require_even(loading)
    mesh = MakeStructured2DMesh(
        nx=elements[0], ny=elements[1], mapping=lambda a, b: (a - 0.5, 0.5 * math.pi * b)
    )
    space = VectorH1(mesh, order=order, dirichletx="bottom", dirichlety="top") * H1(mesh, order=order - 1)
    load = Parameter(0.0)
    top, bottom = (load * CF(profile(cos(theta))) for profile in loading)
    state = GridFunction(space)
    solve_in_steps(_equilibrium(body, space, thickness, top, bottom), state, load, load_steps)
    u = np.array([state.components[0](mesh(0.0, float(angle))) for angle in angles])
    return MidSurface(angles, np.sin(angles) + u[:, 0], np.cos(angles) + u[:, 1])


def _equilibrium(body: Body, space: Any, thickness: float, p_top: Any, p_bottom: Any) -> Any:
    """Energy mu/2 (I1 - 3) - p (J - 1) of the wall, virtual work p n . v da of the faces (over 2 pi)."""
    (u, p), (v, _) = space.TnT()
    radius = 1.0 + thickness * rho
    radial, polar = CF((sin(theta), cos(theta))), CF((cos(theta), -sin(theta)))
    distance = radius * sin(theta) + u[0]
    d_rho, d_theta = thickness * radial + Grad(u)[:, 0], radius * polar + Grad(u)[:, 1]
    # F in the orthonormal frame of the reference: the meridian section, and the stretch across it.
    across = distance / (radius * sin(theta)) if body == "sphere" else CF(1.0)
    invariant = d_rho * d_rho / thickness**2 + d_theta * d_theta / radius**2 + across**2
    volume_ratio = (d_rho[1] * d_theta[0] - d_rho[0] * d_theta[1]) / (thickness * radius) * across
    volume = thickness * radius * (radius * sin(theta) if body == "sphere" else CF(1.0))
    wall = dx(bonus_intorder=4)
    form = BilinearForm(space, symmetric=False)
    form += Variation((0.5 * (invariant - 3.0) - p * (volume_ratio - 1.0)) * volume * wall).Compile()
    tangent = radius * polar + Grad(u).Trace()[:, 1]
    outward = CF((-tangent[1], tangent[0])) * (distance if body == "sphere" else CF(1.0))  # n da / dtheta
    form += (p_top * (outward * v) * ds("right", bonus_intorder=6)).Compile()
    form += (-p_bottom * (outward * v) * ds("left", bonus_intorder=6)).Compile()
    return form
