"""What Robin's condition misses of a potential: the share of the harmonics for which it is not exact.

On the outer boundary, of radius R, the condition has the form (1 + l (l + 1) / 2) / R in place of (l + 1) / R for the
harmonic of degree l, in the plane (2 + l^2) / 3R in place of l / R. It is exact for the degrees 0 and 1 (in the plane 1
and 2); for the first that it is not, by 1 / R (2 / 3R). To first order the field's co-energy is off by half of that
times the square of what is left of the potential on the boundary without the exact degrees.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import CF, InnerProduct, Integrate, sqrt

from embedding.geometry.domain import Domain


def missed_by_robin(domain: Domain, decaying: Any, reach: float, *, odd: tuple[str, ...]) -> float:
    """By what part of itself Robin's condition changes the co-energy of the ``decaying`` part of the potential.

    ``reach`` is how far its sources extend, in shell sizes: outside of it the energy of the harmonic of degree l grows
    inwards as (l + 1) / r^(2 l + 1), in the plane as l / r^(2 l). Across the planes ``odd`` the potential changes its
    sign.
    """
    weight, radius = domain.reduction.measure, domain.sizes.radius
    outer = domain.mesh.Boundaries("outer")
    order = 2 * domain.sizes.potential_order + 2

    def integral(value: Any) -> float:
        return float(Integrate(weight * value, domain.mesh, definedon=outer, order=order))

    exact = _exact(domain, odd)
    basis, plane = [function for _, function in exact], domain.reduction.name == "plane-strain"
    gram = np.array([[integral(a * b) for b in basis] for a in basis])
    moments = np.array([integral(a * decaying) for a in basis])
    whole = integral(decaying * decaying)
    shares = moments * np.linalg.lstsq(gram, moments, rcond=1e-10)[0] if basis else moments
    left = max(0.0, whole - float(shares.sum()))
    if whole == 0.0:
        return 0.0
    first = 3 if plane else 2  # the first degree for which the condition is not exact, and that of all that is left
    degrees = np.array([*(degree for degree, _ in exact), first])
    parts = np.maximum([*shares, left], 0.0)
    inward = (radius / reach) ** (2 * degrees + (0 if plane else 1)) * (degrees if plane else degrees + 1)
    missed = 2.0 / 3.0 if plane else 1.0
    return missed * left / float(parts @ inward)


def _exact(domain: Domain, odd: tuple[str, ...]) -> list[tuple[int, Any]]:
    """Harmonics on the outer boundary for which the condition is exact, of the symmetry of the potential, and their
    degrees."""
    place = domain.reduction.position - CF(domain.sizes.centre(domain.mesh.dim))
    place = place / sqrt(InnerProduct(place, place))
    axes = domain.reduction.axes
    along = dict(zip(axes, (place[i] for i in range(domain.mesh.dim)), strict=True))
    if domain.reduction.name == "plane-strain":
        x, y = along["x"], along["y"]
        functions = {("x",): x, ("y",): y, (): x * x - y * y, ("x", "y"): 2 * x * y}
    else:
        functions = {(): CF(1.0)} | {(axis,): value for axis, value in along.items() if axis != "r"}
    planes = domain.reduction.planes
    return [
        (2 if signs == () and domain.reduction.name == "plane-strain" else len(signs), function)
        for signs, function in functions.items()
        if all((axis in signs) == (axis in odd) for axis in planes)
    ]
