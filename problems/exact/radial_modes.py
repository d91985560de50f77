"""Generalised force of the field on a permeable shell in its second radial mode.

The mid-surface r of radius R = (a + b)/2 moves by e w(theta) n, n radial, w = P_2(cos theta) on the sphere and
cos 2 theta on the cylinder, per length. The faces follow as those of a thin incompressible shell do: they are
r +- (T/2) l n with the thickness stretch l = 1 / (deformed over undeformed area of the mid-surface). To first order
in the amplitude e, at the true faces (radii R +- T/2),

    n -> n - e w'/R e_theta,    l -> 1 - (d - 1) e w/R,
    dx = e [ (w -+ (T/2) (d - 1) w/R) e_r -+ (T/2) w'/R e_theta ],    upper signs on the top.

Two forces: the work of the vacuum's Maxwell tractions on the two faces in dx, which is what the surroundings do; and
minus the derivative of the whole magnetic energy at fixed sources and constant mu, to which only the jump of the
stress across the faces contributes, along their normals.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from scipy.integrate import quad

from problems.exact.three_regions import ThreeRegions


def mode(body: ThreeRegions, angle: float) -> tuple[float, float]:
    """w and w' at a polar angle."""
    if body.dimension == 3:
        return 0.5 * (3.0 * math.cos(angle) ** 2 - 1.0), -1.5 * math.sin(2.0 * angle)
    return math.cos(2.0 * angle), -2.0 * math.sin(2.0 * angle)


def face_motion(body: ThreeRegions, angle: float, top: bool) -> tuple[float, float]:
    """Displacement (e_r, e_theta) of a face per amplitude of the mode."""
    radius, half = 0.5 * (body.inner_radius + body.outer_radius), 0.5 * (body.outer_radius - body.inner_radius)
    sign = 1.0 if top else -1.0
    w, slope = mode(body, angle)
    return w * (1.0 - sign * half * (body.dimension - 1) / radius), -sign * half * slope / radius


def _over(body: ThreeRegions, density: Callable[[float], float], radius: float) -> float:
    """Integral over a face of a function of the polar angle."""

    def weighted(angle: float) -> float:
        ring = 2.0 * math.pi * radius**2 * math.sin(angle) if body.dimension == 3 else 2.0 * radius
        return density(angle) * ring

    return float(quad(weighted, 0.0, math.pi, epsabs=1e-13, epsrel=1e-12)[0])


def work_of_tractions(body: ThreeRegions) -> float:
    """Virtual work of the vacuum's tractions on both faces per amplitude."""

    def top(angle: float) -> float:
        traction, (normal, along) = body.tractions(angle), face_motion(body, angle, top=True)
        return -traction.p_t * normal + traction.tau_t * along

    def bottom(angle: float) -> float:
        traction, (normal, along) = body.tractions(angle), face_motion(body, angle, top=False)
        return traction.p_b * normal + traction.tau_b * along

    return _over(body, top, body.outer_radius) + _over(body, bottom, body.inner_radius)


def generalised_force(body: ThreeRegions) -> float:
    """Minus the derivative of the magnetic energy with the amplitude; ValueError for a remanent body.

    The stress jumps by (mu_r - 1) mu0 (H_t^2 + mu_r H_n^2) / 2, H within the shell, along the normal out of the shell
    (Landau and Lifshitz, Electrodynamics of Continuous Media, sec. 15 and 34).
    """
    if body.remanence:
        raise ValueError("the remanence of a deformed shell is not uniform: there is no closed form")

    def pull(angle: float, radius: float) -> float:
        normal, along = body.field_at(radius, angle)  # of the vacuum side
        excess = body.relative_permeability - 1.0
        return 0.5 * body.permeability * excess * (along**2 + normal**2 / body.relative_permeability)

    def top(angle: float) -> float:
        return pull(angle, body.outer_radius) * face_motion(body, angle, top=True)[0]

    def bottom(angle: float) -> float:
        return -pull(angle, body.inner_radius) * face_motion(body, angle, top=False)[0]

    return _over(body, top, body.outer_radius) + _over(body, bottom, body.inner_radius)
