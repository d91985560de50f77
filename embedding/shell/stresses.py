"""Stress through the thickness of a shell, from the mid-surface's motion and the pressures on its faces.

The stress normal to the layers runs from -p_b to -p_t; to first order in the thickness it does so linearly,

    sigma_nn = - pbar - (eta/T) (p_t - p_b),

and the stress in a layer is that of the law in plane stress, shifted by sigma_nn. The layer's stretches follow from
both metrics at its height, zeta = lambda eta + z_2 eta^2 with z_2 = h lambda^2 - H lambda, which keeps the volume
between mid-surface and layer to second order. In this gauge the three-dimensional pressure of P = dW/dF - p F^-T is
p = lambda_n dW/dlambda_n - sigma_nn, at the mid-surface of a neo-Hookean shell p_0 = mu lambda^2 + pbar. The error is
of second order in the thickness. A law of small strains shifts the stress in the layer by nu/(1 - nu) sigma_nn instead,
and its layers lie at lambda eta.

Source: errata E12; z_2 from equal volumes of the deformed and the reference layer below a point,
zeta - h zeta^2 + ... = lambda (eta - H eta^2 + ...).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from ngsolve import CF, Det, IfPos, OuterProduct, Trace, sqrt

from embedding.shell.laws import KoiterLaw, Law, MooneyRivlinLaw, OgdenLaw, PiecewiseLaw
from embedding.shell.laws.invariants import FirstInvariantLaw
from embedding.shell.tables import Layer, Tables, dyads, raised

EQUAL = 1e-12


class LayerStretches(NamedTuple):
    """Larger and smaller principal stretch in a layer, and B = F F^T on its tangent plane (3 x 3)."""

    major: Any
    minor: Any
    cauchy_green: Any


@dataclass(frozen=True)
class Stresses:
    """Dimensionless stresses of a shell; ``place`` is eta/T, from -1/2 (bottom face) to 1/2 (top face)."""

    tables: Tables
    law: Law
    pressure_top: Any
    pressure_bottom: Any

    def normal(self, place: float) -> Any:
        """sigma_nn."""
        mean = (self.pressure_top + self.pressure_bottom) / 2
        return -1 * CF(mean + place * (self.pressure_top - self.pressure_bottom))

    def cauchy(self, place: float) -> Any:
        """Cauchy stress, 3 x 3."""
        layer = self.stretches(place)
        first, second = self.law.principal_stresses(layer.major, layer.minor)
        gap = layer.major**2 - layer.minor**2
        slope = IfPos(gap - EQUAL, (first - second) / gap, 0.0)
        mean = (first + second - slope * (layer.major**2 + layer.minor**2)) / 2 + self._share * self.normal(place)
        across = OuterProduct(self.tables.deformed.normal, self.tables.deformed.normal)
        return slope * layer.cauchy_green + mean * self.tables.deformed.projector + self.normal(place) * across

    def hydrostatic(self, place: float) -> Any:
        """- tr sigma / 3."""
        layer = self.stretches(place)
        first, second = self.law.principal_stresses(layer.major, layer.minor)
        return -1 * (first + second + (1 + 2 * self._share) * self.normal(place)) / 3

    def pressure(self, place: float) -> Any:
        """p = lambda_n dW/dlambda_n - sigma_nn.

        Raises:
            ValueError: the law is not incompressible.
        """
        layer = self.stretches(place)
        return normal_response(self.law, layer.major, layer.minor) - self.normal(place)

    @property
    def _share(self) -> Any:
        """Part of sigma_nn that adds to the stress in the layer."""
        return self.law.poisson / (1 - self.law.poisson) if isinstance(self.law, KoiterLaw) else 1.0

    def stretches(self, place: float) -> LayerStretches:
        """Principal stretches and B of the layer that starts at eta = ``place`` T."""
        tables, eta = self.tables, place * self.tables.thickness
        thin, H, h = tables.thickness_stretch, tables.reference.mean_curvature, tables.deformed.mean_curvature
        before = tables.reference_layer(place)
        height = thin * eta
        if self.law.incompressible:
            height = height + thin * (thin * h - H) * eta * eta
        after = Layer(tables.deformed, height)
        cauchy_green = dyads(after.tangents, raised(before.contravariant_metric, after.tangents))
        half = Trace(cauchy_green) / 2
        inside = half * half - Det(after.metric) / Det(before.metric)
        root = sqrt(IfPos(inside, inside, 0.0))
        return LayerStretches(sqrt(half + root), sqrt(half - root), cauchy_green)


def normal_response(law: Law, major: Any, minor: Any) -> Any:
    """lambda_n dW/dlambda_n, with W in terms of I_1 and I_2, or of the principal stretches for Ogden's law.

    Raises:
        ValueError: the law is not incompressible.
    """
    thin = 1 / (major * minor)
    if isinstance(law, MooneyRivlinLaw):
        return 2 * thin**2 * (law.c1 + law.c2 * (major**2 + minor**2))
    if isinstance(law, FirstInvariantLaw):
        return 2 * thin**2 * law.slope(major**2 + minor**2 + thin**2 - 3)
    if isinstance(law, OgdenLaw):
        return sum(modulus * thin**power for modulus, power in zip(law.moduli, law.exponents, strict=True))
    if isinstance(law, PiecewiseLaw):
        inside, outside = (normal_response(part, major, minor) for part in (law.inside, law.outside))
        return IfPos(law.indicator, CF(inside), CF(outside))
    raise ValueError("only an incompressible law has a pressure of its own")
