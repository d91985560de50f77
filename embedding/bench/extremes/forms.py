"""Closed forms that several families are held against; each with its source."""

from __future__ import annotations

import math


def thick_sphere_pressure(stretch: float, ratio: float) -> float:
    """Inner pressure over shear modulus of a thick neo-Hookean sphere, ``ratio`` = T/R, at a mid-surface ``stretch``.

    Exact: 2 (1/a + 1/(4 a^4)) between the hoop stretches of the faces, r^3 - R^3 being the same for all particles.
    A. Green and W. Zerna, Theoretical Elasticity (1954), sec. 3.10.
    """
    inner, outer = 1.0 - 0.5 * ratio, 1.0 + 0.5 * ratio
    added = stretch**3 - 1.0
    # The difference of two primitives, arranged so that nothing cancels at T/R = 1e-7.
    a, b = (float((1.0 + added / radius**3) ** (1.0 / 3.0)) for radius in (inner, outer))
    cubes = added * ratio * (3.0 + 0.25 * ratio**2) / (inner * outer) ** 3
    gap = cubes / (a * a + a * b + b * b)
    first, fourth = gap / (a * b), gap * (a + b) * (a * a + b * b) / (a * b) ** 4
    return 2.0 * first + 0.5 * fourth


def thick_tube_pressure(stretch: float, ratio: float) -> float:
    """Inner pressure over shear modulus of a thick neo-Hookean tube in plane strain, ``ratio`` = T/R.

    Exact: ln(a/b) + (b^-2 - a^-2) / 2 between the hoop stretches of the faces, r^2 - R^2 being the same for all
    particles. R. Rivlin, Phil. Trans. R. Soc. A 242 (1949) 173.
    """
    inner, outer = 1.0 - 0.5 * ratio, 1.0 + 0.5 * ratio
    added = stretch**2 - 1.0
    squares = added * 2.0 * ratio / (inner * outer) ** 2  # a^2 - b^2
    a2, b2 = 1.0 + added / inner**2, 1.0 + added / outer**2
    return 0.5 * math.log1p(squares / b2) + 0.5 * squares / (a2 * b2)


def rolled(curvature: float) -> tuple[float, float]:
    """Moment per width over (shear modulus times T^2), and stretch of the mid-surface, of an incompressible plate that
    is bent in plane strain to the angle t = ``curvature`` per thickness of its reference length.

    Exact in three dimensions: M = [t (1 + t^2)^(1/2) - asinh t] / (2 t^2), l^4 = 1 + t^2. R. Rivlin, Proc. R. Soc. A
    195 (1949) 463.
    """
    t = curvature
    if t < 0.02:  # the closed form cancels
        moment = t / 3.0 - t**3 / 10.0 + 3.0 * t**5 / 56.0
    else:
        moment = (t * math.hypot(1.0, t) - math.asinh(t)) / (2.0 * t**2)
    return moment, math.sqrt(math.hypot(1.0, t))
