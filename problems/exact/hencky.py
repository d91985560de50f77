"""Hencky's membrane: a clamped circular membrane under pressure at small strain (Foppl's equations).

H. Hencky, Z. Math. Phys. 63 (1915) 311-317. Radius a, thickness h, Hooke's law with E and nu, pressure p
without follower effects. With q = p a / (E h), radial force N = E h q^(2/3) n(x) and deflection
w = a q^(1/3) W(x), x = r/a:

    n W' = -x/2,    n'' + 3 n'/x = -1/(8 n^2),    n' + (1 - nu) n = 0 and W = 0 on the rim.

Its power series in x^2 converges up to the rim. The finite membrane of `circular_membrane` tends to it with
E = 3 mu, nu = 1/2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from problems.exact.roots import bracketed_root

Array = npt.NDArray[np.float64]
TERMS = 200
RIM = 15.5  # beyond the rim for every Poisson ratio, inside the circle of convergence


@dataclass(frozen=True)
class Hencky:
    """Coefficients of the solution: w0/a = C q^(1/3), apex strain = S q^(2/3), apex force = n0 E h q^(2/3)."""

    poisson_ratio: float
    deflection: float
    strain: float
    force: float

    def profile(self, x: npt.ArrayLike) -> Array:
        """W(x) at x = r/a in [0, 1]; W(0) is `deflection`."""
        return _deflection(1.0, self.force) - _deflection(np.asarray(x, dtype=np.float64), self.force)


@lru_cache(maxsize=1)
def _series() -> tuple[Array, Array]:
    """Coefficients in y^2 of the solution m of m'' + 3 m'/y = -1/(8 m^2), m(0) = 1, and of 1/m."""
    m, inverse = np.zeros(TERMS), np.zeros(TERMS)
    m[0] = inverse[0] = 1.0
    for k in range(1, TERMS):
        square = float(inverse[:k] @ inverse[k - 1 :: -1])
        m[k] = -square / (8.0 * 2.0 * k * (2.0 * k + 2.0))
        inverse[k] = -float(m[1 : k + 1] @ inverse[k - 1 :: -1])
    return m, inverse


def _sum(coefficients: Array, square: Array | float) -> Array:
    return np.asarray(np.polynomial.polynomial.polyval(square, coefficients), dtype=np.float64)


def _deflection(x: npt.ArrayLike, force: float) -> Array:
    """Integral of x / (2 n) from 0 to x, for n(x) = n0 m(x / n0^(3/2))."""
    square = np.asarray(x, dtype=np.float64) ** 2 / force**3
    _, inverse = _series()
    primitive = inverse / (np.arange(TERMS) + 1.0)
    return 0.25 * force**2 * square * _sum(primitive, square)


@lru_cache(maxsize=64)
def hencky(poisson_ratio: float) -> Hencky:
    """The solution for a Poisson ratio in [0, 1/2]; ValueError outside.

    n(x) = n0 m(x / n0^(3/2)) solves the equation for every n0; the rim fixes n0.
    """
    if not 0.0 <= poisson_ratio <= 0.5:
        raise ValueError(f"poisson_ratio is {poisson_ratio:.6g}: it must lie between 0 and 1/2")
    m, _ = _series()
    slope = 2.0 * np.arange(TERMS) * m

    def rim(square: float) -> float:
        return float(_sum(slope, square) + (1.0 - poisson_ratio) * _sum(m, square))

    force = bracketed_root(rim, 0.0, RIM) ** (-1.0 / 3.0)
    return Hencky(poisson_ratio, float(_deflection(1.0, force)), (1.0 - poisson_ratio) * force, force)
