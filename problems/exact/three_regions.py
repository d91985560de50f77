"""A linear permeable (or dielectric) spherical or circular cylindrical shell in a uniform applied field.

Potential with H = -grad phi in d = 2 or 3 dimensions, theta measured from the applied field H0, e_theta
pointing away from it (Jackson, Classical Electrodynamics, sec. 5.12 for the sphere):

    outside   phi = (-H0 r + dipole r^(1-d)) cos theta
    in shell  phi = (-shell_uniform r + shell_dipole r^(1-d)) cos theta
    inside    phi = -H_inner r cos theta

Continuity of phi and of mu dphi/dr on both faces gives the four coefficients; with a uniform remanence B_r along
the applied field the shell has B = mu0 mu_r H + B_r, and B_r cos theta joins its flux. Vacuum Maxwell stress at the
faces, sigma = mu0 (H H - H^2/2 I), gives the tractions. For a dielectric read E, eps0, eps_r, P for H, mu0,
mu_r, B_r.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np


class Coefficients(NamedTuple):
    """Coefficients of the potential, see the head of the module."""

    dipole: float
    shell_uniform: float
    shell_dipole: float
    inner_field: float


class Tractions(NamedTuple):
    """Traction on the two faces of the shell by the vacuum outside (t) and inside (b), per deformed area.

    p pushes on the face: the traction is -p_t n on the top, +p_b n on the bottom (n radial), p = mu0 (H_t^2 -
    H_n^2)/2. tau is the component along e_theta of the traction on the shell: +mu0 H_r H_theta on the top, -
    on the bottom.
    """

    p_t: float
    tau_t: float
    p_b: float
    tau_b: float


@dataclass(frozen=True)
class ThreeRegions:
    """Base of `PermeableSphere` and `PermeableCylinder`; the radii are those of the two faces."""

    inner_radius: float
    outer_radius: float
    relative_permeability: float
    applied_field: float = 1.0
    permeability: float = 1.0
    remanence: float = 0.0
    dimension: ClassVar[int]

    def __post_init__(self) -> None:
        if not 0.0 < self.inner_radius < self.outer_radius:
            got = f"{self.inner_radius:.6g} and {self.outer_radius:.6g}"
            raise ValueError(f"need 0 < inner_radius < outer_radius, got {got}")

    @cached_property
    def coefficients(self) -> Coefficients:
        """The four coefficients, from the 4 x 4 system of the interface conditions."""
        d, a, b, mu = self.dimension, self.inner_radius, self.outer_radius, self.relative_permeability
        h0, source = self.applied_field, self.remanence / self.permeability
        # Unknowns scaled to fields at the faces, so that the matrix has entries of order one.
        ratio = (a / b) ** d
        matrix = np.array(
            [
                [1.0, 1.0, -1.0, 0.0],  # potential at b
                [1.0 - d, mu, mu * (d - 1.0), 0.0],  # flux at b
                [0.0, -1.0, 1.0 / ratio, 1.0],  # potential at a
                [0.0, -mu, -mu * (d - 1.0) / ratio, 1.0],  # flux at a
            ]
        )
        dipole, uniform, shell_dipole, inner = np.linalg.solve(matrix, np.array([h0, h0 - source, 0.0, source]))
        return Coefficients(float(dipole) * b**d, float(uniform), float(shell_dipole) * b**d, float(inner))

    @property
    def inner_field(self) -> float:
        """The uniform field inside the cavity, along the applied one."""
        return self.coefficients.inner_field

    def potential(self, radius: float, angle: float) -> float:
        """Potential phi at a point, H = -grad phi, zero in the symmetry plane of the field."""
        uniform, dipole = self._pair(radius)
        return (-uniform * radius + dipole * radius ** (1 - self.dimension)) * math.cos(angle)

    def field_at(self, radius: float, angle: float) -> tuple[float, float]:
        """(H_r, H_theta) at a point; on a face, the value of the vacuum side."""
        uniform, dipole = self._pair(radius)
        decayed = dipole * radius**-self.dimension
        radial = (uniform + (self.dimension - 1) * decayed) * math.cos(angle)
        return radial, (-uniform + decayed) * math.sin(angle)

    def _pair(self, radius: float) -> tuple[float, float]:
        """Uniform and dipole coefficient of the region of a radius; faces count as vacuum."""
        c = self.coefficients
        if radius >= self.outer_radius:
            return self.applied_field, c.dipole
        return (c.shell_uniform, c.shell_dipole) if radius > self.inner_radius else (c.inner_field, 0.0)

    def tractions(self, angle: float) -> Tractions:
        """Maxwell tractions of the vacuum sides on the two faces at the polar angle, see `Tractions`."""
        top_n, top_t = self.field_at(self.outer_radius, angle)
        bottom_n, bottom_t = self.field_at(self.inner_radius, angle)
        half = 0.5 * self.permeability
        return Tractions(
            p_t=half * (top_t**2 - top_n**2),
            tau_t=self.permeability * top_n * top_t,
            p_b=half * (bottom_t**2 - bottom_n**2),
            tau_b=-self.permeability * bottom_n * bottom_t,
        )

    @property
    def moment(self) -> float:
        """Magnetic moment along the field: 4 pi times the dipole, for a cylinder 2 pi and per length."""
        return (4.0 if self.dimension == 3 else 2.0) * math.pi * self.coefficients.dipole

    @property
    def energy_change(self) -> float:
        """Change of the integral of -(mu H^2 / 2 + B_r . H) when the body enters a field of fixed sources.

        -mu0 m H0 / 2, less half the integral of B_r . H over the body, in which the dipole's part of H has no mean
        (Landau and Lifshitz, Electrodynamics of Continuous Media, sec. 11 and 32). Its decrease is the work of the
        field's forces; per length for a cylinder.
        """
        d = self.dimension
        volume = (4.0 / 3.0 if d == 3 else 1.0) * math.pi * (self.outer_radius**d - self.inner_radius**d)
        own = 0.5 * self.remanence * self.coefficients.shell_uniform * volume
        return -0.5 * self.permeability * self.moment * self.applied_field - own
