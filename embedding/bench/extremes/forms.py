"""Closed forms that several families are held against; each with its source."""

from __future__ import annotations


def thick_sphere_pressure(stretch: float, ratio: float) -> float:
    """Inner pressure over shear modulus of a thick neo-Hookean sphere, ``ratio`` = T/R, at a mid-surface ``stretch``.

    Exact: 2 (1/a + 1/(4 a^4)) between the hoop stretches of the faces, r^3 - R^3 being the same for all particles.
    A. Green and W. Zerna, Theoretical Elasticity (1954), sec. 3.10.
    """
    inner, outer = 1.0 - 0.5 * ratio, 1.0 + 0.5 * ratio
    added = stretch**3 - 1.0
    # The difference of two primitives, arranged so that nothing cancels at T/R = 1e-7.
    a, b = (float((1.0 + added / radius**3) ** (1.0 / 3.0)) for radius in (inner, outer))
    cubes = added * (outer**3 - inner**3) / (inner * outer) ** 3
    gap = cubes / (a * a + a * b + b * b)
    first, fourth = gap / (a * b), gap * (a + b) * (a * a + b * b) / (a * b) ** 4
    return 2.0 * first + 0.5 * fourth
