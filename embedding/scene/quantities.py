"""Names of the fields that a scene may ask for besides those every run gives; docs/fields.md says what they are.

Most exist in two configurations, ``<name>_reference`` and ``<name>_deformed``. Those of a layer depend on the place in
the thickness, stated as ``<name>@<place>`` with place = eta/T from -0.5 (bottom face) to 0.5 (top face).
"""

from __future__ import annotations

from dataclasses import dataclass

CONFIGURATIONS = ("reference", "deformed")


@dataclass(frozen=True)
class Quantity:
    """What a name needs: its SI ``unit``, a ``place`` in the thickness, second derivatives (``bends``)."""

    unit: str = "1"
    place: bool = False
    bends: bool = False


FLAT, BENT, SLOPE = Quantity(), Quantity(bends=True), Quantity("1/m", bends=True)
LAYER, STRESS = Quantity(place=True, bends=True), Quantity("Pa", place=True, bends=True)

IN_BOTH: dict[str, Quantity] = {
    "basis_1": FLAT,
    "basis_2": FLAT,
    "dual_basis_1": FLAT,
    "dual_basis_2": FLAT,
    "normal": FLAT,
    "projector": FLAT,
    "metric": FLAT,
    "metric_components": FLAT,
    "metric_determinant": FLAT,
    "contravariant_metric": FLAT,
    "contravariant_metric_components": FLAT,
    "contravariant_metric_determinant": FLAT,
    "metric_determinant_slope_1": SLOPE,
    "metric_determinant_slope_2": SLOPE,
    "christoffel": SLOPE,
    "curvature": SLOPE,
    "curvature_components": SLOPE,
    "mixed_curvature_components": SLOPE,
    "mean_curvature": SLOPE,
    "gauss_curvature": Quantity("1/m^2", bends=True),
    "edge_tangent_1": FLAT,
    "edge_tangent_2": FLAT,
    "edge_normal_1": FLAT,
    "edge_normal_2": FLAT,
    "shifter": LAYER,
    "shifter_inverse": LAYER,
    "shifter_determinant": LAYER,
    "layer_basis_1": LAYER,
    "layer_basis_2": LAYER,
    "layer_dual_basis_1": LAYER,
    "layer_dual_basis_2": LAYER,
    "layer_metric_components": LAYER,
    "layer_contravariant_metric_components": LAYER,
    "area_ratio": LAYER,
    "top_area_ratio": BENT,
    "bottom_area_ratio": BENT,
    "face_area_ratio": LAYER,
    "face_normal": LAYER,
    "lateral_area_ratio_1": LAYER,
    "lateral_area_ratio_2": LAYER,
    "lateral_tangent_1": LAYER,
    "lateral_tangent_2": LAYER,
    "lateral_normal_1": LAYER,
    "lateral_normal_2": LAYER,
}
ALONE: dict[str, Quantity] = {
    "metric_determinant_ratio": FLAT,
    "surface_stretch": FLAT,
    "thickness_stretch_gradient": SLOPE,
    "layer_stretch": LAYER,
    "top_stretch": BENT,
    "bottom_stretch": BENT,
    "volume_ratio": LAYER,
    "deformation_gradient": LAYER,
    "inverse_deformation_gradient": LAYER,
    "cauchy_green": LAYER,
    "stress": STRESS,
    "stress_nn": Quantity("Pa", place=True),
    "pressure_3d": STRESS,
    "hydrostatic_pressure": STRESS,
}
QUANTITIES: dict[str, Quantity] = {
    f"{name}_{configuration}": quantity for name, quantity in IN_BOTH.items() for configuration in CONFIGURATIONS
} | ALONE
