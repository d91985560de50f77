"""A clamped strip magnetised along itself, in a weak field across: how much more it bends by its own field.

Its poles, b' per length for the remanence b(s) per width and height, are lines in the plane at a logarithmic potential,

    U = -1 / (4 pi mu0) int int b'(s) b'(t) ln r(s, t) ds dt.

Bent by a small v(s) and inextensible, two of them at the distance d = |s - t| come closer:

    ln r = ln d + [ (v(s) - v(t))^2 / d^2 - mean of v'^2 between them ] / 2 + O(v^4),

which has no singularity at d = 0. With the bending energy int D v''^2 / 2 and the work int h b v' of the field across,
h, that is a quadratic form of v, here of the polynomials s^2 ... s^n. Poles at the ends alone, D v'''' under an end
force that points to the clamp: 3 (1 - k cot k) / k^2 with k^2 = b^2 L / (2 pi mu0 D).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
POINTS, DEGREE = 400, 10


def fading(width: float) -> tuple[Callable[[Array], Array], Callable[[Array], Array]]:
    """tanh(s / width) tanh((1 - s) / width), a remanence that fades out over ``width`` at both ends, and its slope."""

    def ends(s: Array) -> tuple[Array, Array]:
        return np.tanh(s / width), np.tanh((1.0 - s) / width)

    def profile(s: Array) -> Array:
        return np.multiply(*ends(s))

    def slope(s: Array) -> Array:
        near, far = ends(s)
        return (far * (1.0 - near**2) - near * (1.0 - far**2)) / width

    return profile, slope


def own_field(strength: float, profile: Callable[[Array], Array], slope: Callable[[Array], Array]) -> float:
    """Deflection of the tip with the strip's own field over that without.

    ``strength`` is b_max^2 L / (mu0 D), ``profile`` the remanence over its largest at places s in [0, 1], which
    vanishes at both ends, and ``slope`` its derivative.
    """
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    s, w = 0.5 * (nodes + 1.0), 0.5 * weights
    powers = np.arange(2, DEGREE + 1)
    first, second = powers * s[:, None] ** (powers - 1), powers * (powers - 1) * s[:, None] ** (powers - 2)
    bending = second.T @ (w[:, None] * second)
    load = (w * profile(s)) @ first
    distance = s[:, None] - s[None, :] + np.eye(POINTS)
    poles = np.outer(w * slope(s), w * slope(s)) * (1.0 - np.eye(POINTS))

    def rise(power: int) -> Array:
        return (s[:, None] ** power - s[None, :] ** power) / distance

    closer = np.array(
        [
            [np.sum(poles * (rise(i) * rise(j) - i * j / (i + j - 1) * rise(i + j - 1))) for j in powers]
            for i in powers
        ]
    )
    bent = np.linalg.solve(bending - strength / (4.0 * np.pi) * closer, load)
    return float(bent.sum() / np.linalg.solve(bending, load).sum())
