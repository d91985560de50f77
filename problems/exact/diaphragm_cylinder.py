"""Linear cylindrical shells of Koiter's theory over rigid diaphragms: pinched cylinder and Scordelis-Lo roof.

Axial, hoop and outward displacement (u, v, w) = sum over m of (u_m cos, v_m sin, w_m sin)(m pi x / L) of the angle
f satisfy the diaphragms: no displacement in the end's plane, no axial force, no moment. Strains and changes of
curvature (linear changes of the first and second fundamental form, W. T. Koiter, in Theory of Thin Elastic
Shells, North-Holland (1960) 12-33; the shell's surface is the exact cylinder), with D the angle derivative,

    e_x = u_x,    e_f = (Dv + w)/R,    e_xf = (Du/R + v_x)/2,
    k_x = w_xx,   k_f = (D^2 w - 2 Dv - w)/R^2,    k_xf = (D w_x - v_x)/R,

and the energy per area E T / (2 (1 - nu^2)) [(e_x + e_f)^2 - 2 (1 - nu) (e_x e_f - e_xf^2)] + T^2/12 times the
same of k. The closed cylinder is a double Fourier series, as in G. M. Lindberg, M. D. Olson and G. R. Cowper, NRC
Canada DME/NAE Quarterly Bulletin 1969(4), 1-99; the open one a Fourier series in x and a spectral solution in f.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import legendre

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class DiaphragmCylinder:
    """Radius R, distance L of the diaphragms, thickness T, Hooke's law. Any consistent units."""

    radius: float
    length: float
    thickness: float
    young: float
    poisson_ratio: float

    @property
    def membrane(self) -> float:
        """E T / (1 - nu^2)."""
        return self.young * self.thickness / (1.0 - self.poisson_ratio**2)

    def pinched(self, force: float = 1.0, terms: int = 400) -> float:
        """Inward displacement under each of two opposite inward forces at half the length of a closed cylinder.

        Harmonics m < 2 `terms` (odd), n < 2 `terms` (even); the tail, which falls like terms^-2, is extrapolated.
        """
        coarse, fine = self._pinched(terms // 2), self._pinched(terms)
        return force * (fine + (fine - coarse) / 3.0)

    def _pinched(self, terms: int) -> float:
        around = np.arange(0, 2 * terms, 2, dtype=np.float64)
        # Mean squares of the harmonics over the cylinder, and both forces on cos(n f) at f = 0 and pi.
        area = math.pi * self.radius * self.length * np.where(around == 0.0, 1.0, 0.5)
        total = 0.0
        for m in range(1, 2 * terms, 2):
            total += float(np.sum(2.0 / (area * self._radial_stiffness(m, around))))
        return total

    def _radial_stiffness(self, m: int, n: Array) -> Array:
        """Stiffness per area of w in the harmonic cos(n f), with u and v condensed out."""
        k, r, nu, one = m * math.pi / self.length, self.radius, self.poisson_ratio, np.ones_like(n)
        zero = np.zeros_like(n)
        # Rows: strains of the amplitudes (u, v, w); v goes with sin(n f), so D v = n v, D w = -n w.
        membrane = [[-k * one, zero, zero], [zero, n / r, one / r], [-0.5 * n / r, 0.5 * k * one, zero]]
        bending = [
            [zero, zero, -(k**2) * one],
            [zero, -2.0 * n / r**2, -(n**2 + 1.0) / r**2],
            [zero, -k / r * one, -k * n / r],
        ]
        matrix = np.zeros((len(n), 3, 3))
        for rows, factor in ((membrane, 1.0), (bending, self.thickness**2 / 12.0)):
            b = np.moveaxis(np.array(rows), 2, 0)
            hooke = np.array([[1.0, nu, 0.0], [nu, 1.0, 0.0], [0.0, 0.0, 2.0 * (1.0 - nu)]])
            matrix += factor * self.membrane * np.einsum("nij,ik,nkl->njl", b, hooke, b)
        matrix[n == 0.0, 1, 1] = 1.0  # v has no such harmonic
        matrix[n == 0.0, 1, 2] = matrix[n == 0.0, 2, 1] = 0.0
        couple = matrix[:, :2, 2]
        condensed: Array = matrix[:, 2, 2] - np.einsum(
            "ni,ni->n", couple, np.linalg.solve(matrix[:, :2, :2], couple[..., None])[..., 0]
        )
        return condensed

    def roof(self, half_angle: float, weight: float, terms: int = 40, degree: int = 40) -> float:
        """Downward displacement of the middle of a free straight edge under a weight per area.

        The panel spans -half_angle < f < half_angle from the crown. Amplitudes are Legendre series in f.
        """
        nodes, weights = legendre.leggauss(degree + 10)
        angle = half_angle * nodes
        basis = [legendre.legval(nodes, c) for c in np.eye(degree + 1)]
        p = np.asarray(basis, dtype=np.float64).T
        d1 = np.array([legendre.legval(nodes, legendre.legder(c)) for c in np.eye(degree + 1)]).T / half_angle
        d2 = np.array([legendre.legval(nodes, legendre.legder(c, 2)) for c in np.eye(degree + 1)]).T / half_angle**2
        scale = weights * half_angle * self.radius
        zero, count, total = np.zeros_like(p), degree + 1, 0.0
        # u and v, w: weight along +f is sin f, outwards -cos f.
        load = np.concatenate([np.zeros(count), p.T @ (scale * np.sin(angle)), -p.T @ (scale * np.cos(angle))])
        for m in range(1, 2 * terms, 2):
            strains = self._panel_strains(m * math.pi / self.length, p, d1, d2, zero)
            matrix = sum(
                factor * self._quadratic(rows, scale)
                for rows, factor in zip(strains, (1.0, self.thickness**2 / 12.0), strict=True)
            )
            found = np.linalg.solve(matrix, weight * 4.0 / (m * math.pi) * load)
            v, w = found[count : 2 * count].sum(), found[2 * count :].sum()  # every Legendre polynomial is 1 at 1
            total += math.sin(0.5 * m * math.pi) * (v * math.sin(half_angle) - w * math.cos(half_angle))
        return total

    def _panel_strains(self, k: float, p: Any, d1: Any, d2: Any, zero: Any) -> tuple[list[Array], list[Array]]:
        """Strains and changes of curvature of the coefficients (u, v, w) at the nodes."""
        r = self.radius
        membrane = [
            np.hstack([-k * p, zero, zero]),
            np.hstack([zero, d1 / r, p / r]),
            np.hstack([0.5 * d1 / r, 0.5 * k * p, zero]),
        ]
        bending = [
            np.hstack([zero, zero, -(k**2) * p]),
            np.hstack([zero, -2.0 * d1 / r**2, (d2 - p) / r**2]),
            np.hstack([zero, -k * p / r, k * d1 / r]),
        ]
        return membrane, bending

    def _quadratic(self, rows: list[Array], scale: Array) -> Array:
        nu = self.poisson_ratio
        x, f, xf = (row * np.sqrt(scale)[:, None] for row in rows)
        return self.membrane * (x.T @ x + f.T @ f + nu * (x.T @ f + f.T @ x) + 2.0 * (1.0 - nu) * xf.T @ xf)
