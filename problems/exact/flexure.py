"""Finite bending of an incompressible block into a circular sector, in plane strain: exact in three dimensions.

R. S. Rivlin, Proc. R. Soc. A 195 (1949) 463-473. A plate of thickness T (-T/2 < X < T/2) is bent so that the
straight line at X becomes an arc with the angle c per undeformed length: hoop stretch s(X)^2 = c r, radial
stretch 1/s, and incompressibility gives s^2 = l^2 + 2 c X with l the stretch of the material mid-surface. Faces
free of traction have reciprocal stretches, for every isotropic law:

    s_out^2 = 1/s_in^2 = t + (1 + t^2)^(1/2),    l = (1 + t^2)^(1/4),    t = c T.

The resultant force vanishes and the moment per width is M = (1 / (2 c^2)) int (sigma_hoop - sigma_radial) s ds.
"""

from __future__ import annotations

import math

from scipy.integrate import quad

from problems.exact.material import Law, MooneyRivlin, neo_hookean


def mid_stretch(curvature: float) -> float:
    """Stretch l of the material mid-surface at t = c T: 1 + t^2/4 - ... (a thin shell without this term has 1)."""
    return math.sqrt(math.hypot(1.0, curvature))


def face_stretches(curvature: float) -> tuple[float, float]:
    """Hoop stretch on the inner (compressed) and the outer face at t = c T >= 0."""
    outer = math.exp(0.5 * math.asinh(curvature))
    return 1.0 / outer, outer


def mid_radius(curvature: float) -> float:
    """Deformed radius r/T of the material mid-surface at t = c T > 0."""
    return mid_stretch(curvature) / curvature


def moment(curvature: float, law: Law | None = None) -> float:
    """M / (mu T^2) per width at t = c T.

    Mooney-Rivlin, any c1 and c2: [t (1 + t^2)^(1/2) - asinh t] / (2 t^2), from M = -int sigma_radial r dr with
    sigma_radial = mu/2 (s^2 + s^-2 - s_out^2 - s_out^-2).
    """
    law = law or neo_hookean()
    if isinstance(law, MooneyRivlin):
        return _closed(curvature)
    return moment_by_quadrature(curvature, law)


def _closed(t: float) -> float:
    if abs(t) < 0.05:  # the closed form cancels
        return t / 3.0 - t**3 / 10.0 + 3.0 * t**5 / 56.0 - 5.0 * t**7 / 144.0 + 35.0 * t**9 / 1408.0
    return (t * math.hypot(1.0, t) - math.asinh(t)) / (2.0 * t**2)


def moment_by_quadrature(curvature: float, law: Law) -> float:
    """M / (mu T^2) by the integral at the head of the module, for any law; t > 0."""
    inner, outer = face_stretches(curvature)
    total, _ = quad(lambda s: law.stress_difference(s, 1.0 / s) * s, inner, outer, epsabs=1e-14, epsrel=1e-13)
    return float(total) / (2.0 * curvature**2 * law.shear_modulus)


def energy(curvature: float, law: Law) -> float:
    """Strain energy / (mu T) per mid-surface area and width by quadrature; its derivative by t is `moment`."""
    square = mid_stretch(curvature) ** 2

    def density(x: float) -> float:
        return law.energy(math.sqrt(square + 2.0 * curvature * x), 1.0)

    total, _ = quad(density, -0.5, 0.5, epsabs=1e-14, epsrel=1e-13)
    return float(total) / law.shear_modulus


def thin_moment(curvature: float) -> float:
    """The bending theory's M / (mu T^2) = t/3 (D = mu T^3 / 3), with the relative error 3 t^2 / 10."""
    return curvature / 3.0
