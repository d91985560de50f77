"""Spherical and cylindrical membrane under pressures on the two faces, as a problem on a line.

What the shell theory of first order in T should give, with the three ways to load it that the scene calls
`variant`. The unknowns r(theta), z(theta) live on a line from pole to equator.
"""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from ngsolve import CF, H1, BilinearForm, GridFunction, Parameter, Variation, cos, dx, grad, sin
from ngsolve import x as theta
from ngsolve.meshes import Make1DMesh

from tests.solids import NINE_ANGLES, Array, Loading, MidSurface, Profile, require_even
from tests.solids.newton import solve_in_steps

Body = Literal["sphere", "ring"]
Variant = Literal["embedding-aware", "net", "as-published"]


def membrane_sphere(
    thickness_ratio: float,
    p_top: Profile,
    p_bottom: Profile,
    variant: Variant = "embedding-aware",
    *,
    order: int = 5,
    elements: int = 16,
    load_steps: int = 4,
    angles: Array = NINE_ANGLES,
) -> MidSurface:
    """Mid-surface of the spherical membrane under the same pressures as the thick sphere.

    Raises ValueError for a pressure that is not even, RuntimeError where Newton's method fails, as it does
    where the membrane would be compressed.
    """
    loading = Loading(p_top, p_bottom)
    return _solve("sphere", thickness_ratio, loading, variant, order, elements, load_steps, angles)


def membrane_ring(
    thickness_ratio: float,
    p_top: Profile,
    p_bottom: Profile,
    variant: Variant = "embedding-aware",
    *,
    order: int = 5,
    elements: int = 16,
    load_steps: int = 4,
    angles: Array = NINE_ANGLES,
) -> MidSurface:
    """Mid-line of the membrane tube in plane strain; arguments as `membrane_sphere`."""
    loading = Loading(p_top, p_bottom)
    return _solve("ring", thickness_ratio, loading, variant, order, elements, load_steps, angles)


def _solve(
    body: Body,
    thickness: float,
    loading: Loading,
    variant: Variant,
    order: int,
    elements: int,
    load_steps: int,
    angles: Array,
) -> MidSurface:
    require_even(loading)
    mesh = Make1DMesh(elements, mapping=lambda s: 0.5 * math.pi * s)
    space = H1(mesh, order=order, dirichlet="left") * H1(mesh, order=order, dirichlet="right")
    load = Parameter(0.0)
    top, bottom = (load * CF(profile(cos(theta))) for profile in loading)
    form = _equilibrium(body, space, thickness, top, bottom, variant)
    state = GridFunction(space)
    for part, direction in zip(state.components, (sin(theta), cos(theta)), strict=True):
        part.Set(0.1 * direction)  # a blown-up guess: unstretched, a membrane has no stiffness across itself
    solve_in_steps(form, state, load, load_steps)
    u = np.array([[part(mesh(float(angle))) for part in state.components] for angle in angles])
    return MidSurface(angles, np.sin(angles) + u[:, 0], np.cos(angles) + u[:, 1])


def _equilibrium(
    body: Body, space: Any, thickness: float, p_top: Any, p_bottom: Any, variant: Variant
) -> Any:
    """Elastic energy and virtual work of the faces, over the reference mid-surface (per 2 pi for the sphere).

    Faces at r +- (T/2) lambda n carry -p_net n . v da - T grad_s(p_mean) . v dA to first order in T, on a
    closed shell: the pressure times the change of the face's area vector, integrated by parts once, curvature
    and variable thickness cancel. "net" drops the second term; "as-published" has T p_mean (a^i . v_,i + 2 H
    n . v) dA instead, with the reference curvature H = -1 of the sphere, -1/2 of the ring.
    """
    (u, w), (v, q) = space.TnT()
    sphere = body == "sphere"
    distance, d_r, d_z = sin(theta) + u, cos(theta) + grad(u)[0], -sin(theta) + grad(w)[0]
    meridian = d_r**2 + d_z**2  # square of the stretch
    across = distance / sin(theta) if sphere else CF(1.0)
    area, line = sin(theta) if sphere else CF(1.0), dx(bonus_intorder=6)  # dA = area * line
    energy = 0.5 * thickness * (meridian + across**2 + 1.0 / (meridian * across**2) - 3.0)
    outward = d_r * q - d_z * v  # n . v times the meridian stretch
    net, mean = p_top - p_bottom, 0.5 * (p_top + p_bottom)
    form = BilinearForm(space, symmetric=False)
    form += Variation(energy * area * line).Compile()
    form += (net * outward * across * area * line).Compile()
    if variant == "embedding-aware":
        slope = mean.Diff(theta)
        form += (thickness * slope * (d_r * v + d_z * q) / meridian * area * line).Compile()
    elif variant == "as-published":
        divergence = (d_r * grad(v)[0] + d_z * grad(q)[0]) / meridian + (v / distance if sphere else CF(0.0))
        curvature = -2.0 if sphere else -1.0  # 2 H
        work = divergence + curvature * outward / meridian**0.5
        form += (-thickness * mean * work * area * line).Compile()
    return form
