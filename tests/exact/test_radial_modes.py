"""Force on permeable shells in the second radial mode, against fields of truly deformed shells."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial import legendre
from scipy.integrate import quad

from problems.exact.permeable_cylinder import permeable_cylinder
from problems.exact.permeable_sphere import permeable_sphere
from problems.exact.radial_modes import face_motion, generalised_force, work_of_tractions
from problems.exact.three_regions import ThreeRegions

BODIES: list[ThreeRegions] = [
    kind(*data) for kind in (permeable_sphere, permeable_cylinder) for data in ((0.1, 10.0), (0.3, 2.0))
]


def harmonics(body: ThreeRegions, n: int, radius: np.ndarray, angle: np.ndarray) -> list[tuple[np.ndarray, ...]]:
    """(value, radial, tangential derivative) of the growing and of the decaying harmonic of order n."""
    x = np.cos(angle)
    if body.dimension == 3:
        c = np.eye(n + 1)[n]
        y, dy, low = legendre.legval(x, c), -np.sin(angle) * legendre.legval(x, legendre.legder(c)), -(n + 1)
    else:
        y, dy, low = np.cos(n * angle), -n * np.sin(n * angle), -n
    return [(radius**p * y, p * radius ** (p - 1) * y, radius ** (p - 1) * dy) for p in (n, low)]


def deformed_dipole(body: ThreeRegions, amplitude: float, orders: int = 5) -> float:
    """Dipole of the shell whose faces have moved by the amplitude, by least squares over harmonics of odd order."""
    angle = 0.25 * math.pi * (legendre.leggauss(60)[0] + 1.0)  # the other half mirrors this one
    mu, rows, right = body.relative_permeability, [], []
    odd = range(1, 2 * orders, 2)
    for place, top in enumerate((True, False)):
        start = body.outer_radius if top else body.inner_radius
        moved = np.array([face_motion(body, float(t), top) for t in angle])
        step = 1e-6
        ahead, behind = (np.array([face_motion(body, float(t + d), top) for t in angle]) for d in (step, -step))
        slopes = (ahead - behind) / (2.0 * step)
        # Points start e_r + e (m_r, m_t) in the local frame; tangent = derivative with the angle.
        er, et = start + amplitude * moved[:, 0], amplitude * moved[:, 1]
        radius, turn = np.hypot(er, et), np.arctan2(et, er)
        tangent_r = amplitude * (slopes[:, 0] - moved[:, 1])
        tangent_t = start + amplitude * (slopes[:, 1] + moved[:, 0])
        # Into the frame of the moved point, then the normal is the tangent turned.
        c, s = np.cos(turn), np.sin(turn)
        t_r, t_t = c * tangent_r + s * tangent_t, c * tangent_t - s * tangent_r
        length = np.hypot(t_r, t_t)
        n_r, n_t = t_t / length, -t_r / length
        theta = angle + turn
        columns = []
        for n in odd:
            (g, g_r, g_t), (f, f_r, f_t) = harmonics(body, n, radius, theta)
            grow, fall = g_r * n_r + g_t * n_t, f_r * n_r + f_t * n_t
            nothing = np.zeros_like(g)
            outside = (f, fall) if place == 0 else (nothing, nothing)
            cavity = (g, grow) if place == 1 else (nothing, nothing)
            columns += [np.concatenate(p) for p in (outside, (-g, -mu * grow), (-f, -mu * fall), cavity)]
        rows.append(np.array(columns).T)
        (g, g_r, g_t), _ = harmonics(body, 1, radius, theta)
        applied = np.concatenate([g, g_r * n_r + g_t * n_t]) if place == 0 else np.zeros(2 * len(angle))
        right.append(applied * body.applied_field)
    scale = np.abs(np.vstack(rows)).max(axis=0)
    found = np.linalg.lstsq(np.vstack(rows) / scale, np.concatenate(right), rcond=None)[0] / scale
    return float(found[0])


@pytest.mark.parametrize("body", BODIES)
def test_force_is_the_derivative_of_the_energy(body: ThreeRegions) -> None:
    """-mu0 m H0 / 2 of shells whose faces have really moved, by differences in the amplitude."""
    assert deformed_dipole(body, 0.0) == pytest.approx(body.coefficients.dipole, rel=1e-10)
    step = 1e-3
    solid = 4.0 * math.pi if body.dimension == 3 else 2.0 * math.pi

    def energy(amplitude: float) -> float:
        return -0.5 * body.permeability * solid * deformed_dipole(body, amplitude) * body.applied_field

    coarse, fine = ((energy(s) - energy(-s)) / (2.0 * s) for s in (2.0 * step, step))
    assert generalised_force(body) == pytest.approx(-(4.0 * fine - coarse) / 3.0, rel=1e-6)


@pytest.mark.parametrize("body", BODIES)
def test_the_solid_takes_the_rest(body: ThreeRegions) -> None:
    """Work of the vacuum's tractions less that of the stress within the shell, at the same faces."""
    mu = body.permeability * body.relative_permeability

    def within(angle: float, radius: float, top: bool) -> float:
        offset = -1e-12 if top else 1e-12
        normal, along = body.field_at(radius + offset, angle)
        moved = face_motion(body, angle, top)
        ring = 2.0 * math.pi * radius**2 * math.sin(angle) if body.dimension == 3 else 2.0 * radius
        return mu * (0.5 * (normal**2 - along**2) * moved[0] + normal * along * moved[1]) * ring

    top = quad(within, 0.0, math.pi, args=(body.outer_radius, True))[0]
    bottom = quad(within, 0.0, math.pi, args=(body.inner_radius, False))[0]
    assert work_of_tractions(body) - top + bottom == pytest.approx(generalised_force(body), rel=1e-9)


def test_limits() -> None:
    """No matter, no force; in an ideal body there is no stress, and the outer face alone is pulled."""
    assert generalised_force(permeable_sphere(0.1, 1.0)) == 0.0
    ideal = permeable_sphere(0.1, 1e9)
    assert generalised_force(ideal) == pytest.approx(work_of_tractions(ideal), rel=1e-7)
    # Integral of 9/2 cos^2 P_2 over the sphere of the outer face, 12 pi / 5 b^2; the face moves by w (1 - T/R).
    assert work_of_tractions(ideal) == pytest.approx(2.4 * math.pi * 1.05**2 * 0.9, rel=1e-7)
