"""Fields that a scene asks for by name, in SI units on the shell; docs/fields.md lists them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ngsolve import CF, Det, Norm

from embedding.geometry.domain import Domain
from embedding.scene import Scales
from embedding.scene.output import Output, parsed
from embedding.scene.quantities import CONFIGURATIONS, QUANTITIES
from embedding.shell.charts import Coordinates, chart, normal_chart
from embedding.shell.derivatives import Derivatives
from embedding.shell.kinematics import Kinematics
from embedding.shell.laws import Law
from embedding.shell.stresses import Stresses
from embedding.shell.tables import Layer, MidSurface, Tables, dyads, raised, unit
from embedding.solving.events import Field

Shell = tuple[Domain, Kinematics, Any]
"""The domain, the kinematics of its displacement (a grid function) and the dimensionless thickness."""


def output_fields(output: Output, shell: Shell, law: Law, pressures: tuple[Any, Any], scales: Scales) -> list[Field]:
    """The fields that ``output`` names, on the block "shell"; ``pressures`` are p_t and p_b, dimensionless.

    3 x 3 tensors have 9 components and 2 x 2 matrices 4, by rows; Christoffel symbols have 6.
    """
    if not output.fields:
        return []
    domain, kinematics, thickness = shell
    derivatives = Derivatives(domain, kinematics, output.direction)
    shown = Shown.of(derivatives, output.coordinates, thickness, law, pressures)
    return [_field(name, shown, scales) for name in output.fields]


@dataclass(frozen=True)
class Shown:
    """What fields are made of: tensors and scalars in the orthonormal frame, regular everywhere, and components."""

    tables: Tables
    components: Tables
    stresses: Stresses

    @staticmethod
    def of(
        derivatives: Derivatives, coordinates: Coordinates, thickness: Any, law: Law, pressures: tuple[Any, Any]
    ) -> Shown:
        """From the motion, the names of the coordinates of the components, and p_t and p_b."""
        tables = Tables(derivatives, normal_chart(derivatives), thickness, law)
        components = Tables(derivatives, chart(derivatives, coordinates), thickness, law)
        return Shown(tables, components, Stresses(tables, law, *pressures))


def _field(name: str, shown: Shown, scales: Scales) -> Field:
    si = QUANTITIES[parsed(name)[0]].unit
    factor = {"1": 1.0, "1/m": 1 / scales.length, "1/m^2": scales.length**-2, "Pa": scales.stress}[si]
    values = CF(quantity(name, shown))
    return Field("shell", name, si, (values if factor == 1.0 else factor * values).Compile())


def quantity(name: str, shown: Shown) -> Any:
    """The dimensionless quantity ``name`` of ``QUANTITIES`` (with its place): lengths over the size of the shape.

    Raises:
        ValueError: no such name, or its place is missing or outside the shell.
    """
    base, place = parsed(name)
    if base in ALONE:
        return ALONE[base](shown, place or 0.0)
    stem, _, configuration = base.rpartition("_")
    tables = shown.components if stem in OF_COORDINATES else shown.tables
    return IN_BOTH[stem](View(tables, configuration, place or 0.0))


@dataclass(frozen=True)
class View:
    """One configuration of the shell, at one place in its thickness."""

    tables: Tables
    configuration: str
    place: float

    @property
    def is_reference(self) -> bool:
        """Is this the reference configuration?"""
        return self.configuration == CONFIGURATIONS[0]

    @property
    def surface(self) -> MidSurface:
        """The mid-surface."""
        return self.tables.reference if self.is_reference else self.tables.deformed

    @property
    def layer(self) -> Layer:
        """The layer at the place."""
        tables, place = self.tables, self.place
        return tables.reference_layer(place) if self.is_reference else tables.deformed_layer(place)

    def at(self, place: float) -> View:
        """The same configuration at another place."""
        return View(self.tables, self.configuration, place)

    @property
    def per_area(self) -> Any:
        """Area of the mid-surface per reference area."""
        return 1.0 if self.is_reference else self.tables.surface_stretch

    @property
    def area_ratio(self) -> Any:
        """Area of the layer per reference area of the mid-surface, as the paper has it."""
        return self.per_area * self.layer.determinant

    def pulled_back(self, contravariant: bool) -> Any:
        """The metric as a tensor in the reference bases: a_ab A^a (x) A^b, or a^ab A_a (x) A_b."""
        reference = self.tables.reference
        basis, surface = (reference.tangents if contravariant else reference.duals), self.surface
        return dyads(basis, raised(surface.contravariant_metric if contravariant else surface.metric, basis))

    def edge_normal(self, along: int) -> Any:
        """nu, or nu-bar = nu_a a^a."""
        reference = self.tables.reference.edge_normal(along)
        return reference if self.is_reference else self.tables.deformed_edge_normal(along)

    def lateral(self, along: int) -> tuple[Any, Any, Any]:
        """Of a lateral face along a coordinate line: its area per reference length and thickness, tangent, normal."""
        edge = self.surface.tangents[along] / Norm(self.tables.reference.tangents[along])
        length, tangent, normal = self.layer.lateral(edge)
        return (length if self.is_reference else length * self.tables.thickness_stretch), tangent, normal


def _stretch(tables: Tables, place: float) -> Any:
    """Deformed over reference area of a layer."""
    return View(tables, "deformed", place).area_ratio / View(tables, "reference", place).area_ratio


IN_BOTH: dict[str, Callable[[View], Any]] = {
    "basis_1": lambda v: v.surface.tangents[0],
    "basis_2": lambda v: v.surface.tangents[1],
    "dual_basis_1": lambda v: v.surface.duals[0],
    "dual_basis_2": lambda v: v.surface.duals[1],
    "normal": lambda v: v.surface.normal,
    "projector": lambda v: v.surface.projector,
    "metric": lambda v: v.pulled_back(contravariant=False),
    "metric_components": lambda v: v.surface.metric,
    "metric_determinant": lambda v: v.surface.determinant,
    "contravariant_metric": lambda v: v.pulled_back(contravariant=True),
    "contravariant_metric_components": lambda v: v.surface.contravariant_metric,
    "contravariant_metric_determinant": lambda v: Det(v.surface.contravariant_metric),
    "metric_determinant_slope_1": lambda v: v.surface.determinant_slopes[0],
    "metric_determinant_slope_2": lambda v: v.surface.determinant_slopes[1],
    "christoffel": lambda v: CF(v.surface.christoffel[0] + v.surface.christoffel[1]),
    "curvature": lambda v: v.surface.curvature,
    "curvature_components": lambda v: v.surface.second_form,
    "mixed_curvature_components": lambda v: v.surface.mixed_curvature,
    "mean_curvature": lambda v: v.surface.mean_curvature,
    "gauss_curvature": lambda v: v.surface.gauss_curvature,
    "edge_tangent_1": lambda v: unit(v.surface.tangents[0]),
    "edge_tangent_2": lambda v: unit(v.surface.tangents[1]),
    "edge_normal_1": lambda v: v.edge_normal(0),
    "edge_normal_2": lambda v: v.edge_normal(1),
    "shifter": lambda v: v.layer.shifter,
    "shifter_inverse": lambda v: v.layer.inverse,
    "shifter_determinant": lambda v: v.layer.determinant,
    "layer_basis_1": lambda v: v.layer.tangents[0],
    "layer_basis_2": lambda v: v.layer.tangents[1],
    "layer_dual_basis_1": lambda v: v.layer.duals[0],
    "layer_dual_basis_2": lambda v: v.layer.duals[1],
    "layer_metric_components": lambda v: v.layer.metric,
    "layer_contravariant_metric_components": lambda v: v.layer.contravariant_metric,
    "area_ratio": lambda v: v.area_ratio,
    "top_area_ratio": lambda v: v.at(0.5).area_ratio,
    "bottom_area_ratio": lambda v: v.at(-0.5).area_ratio,
    "face_area_ratio": lambda v: v.per_area * Norm(v.layer.area_vector),
    "face_normal": lambda v: unit(v.layer.area_vector),
    "lateral_area_ratio_1": lambda v: v.lateral(0)[0],
    "lateral_area_ratio_2": lambda v: v.lateral(1)[0],
    "lateral_tangent_1": lambda v: v.lateral(0)[1],
    "lateral_tangent_2": lambda v: v.lateral(1)[1],
    "lateral_normal_1": lambda v: v.lateral(0)[2],
    "lateral_normal_2": lambda v: v.lateral(1)[2],
}
OF_COORDINATES = {
    name for name in IN_BOTH if name.endswith(("_1", "_2", "_components", "_determinant")) or name == "christoffel"
} - {"shifter_determinant"}
"""Quantities that the choice of coordinates changes."""
ALONE: dict[str, Callable[[Shown, float], Any]] = {
    "metric_determinant_ratio": lambda s, e: s.tables.determinant_ratio,
    "surface_stretch": lambda s, e: s.tables.surface_stretch,
    "thickness_stretch_gradient": lambda s, e: s.tables.thickness_gradient,
    "layer_stretch": lambda s, e: _stretch(s.tables, e),
    "top_stretch": lambda s, e: _stretch(s.tables, 0.5),
    "bottom_stretch": lambda s, e: _stretch(s.tables, -0.5),
    "volume_ratio": lambda s, e: _stretch(s.tables, e) * s.tables.thickness_stretch,
    "deformation_gradient": lambda s, e: s.tables.deformation_gradient(e),
    "inverse_deformation_gradient": lambda s, e: s.tables.inverse_deformation_gradient(e),
    "cauchy_green": lambda s, e: s.tables.cauchy_green(e),
    "stress": lambda s, e: s.stresses.cauchy(e),
    "stress_nn": lambda s, e: s.stresses.normal(e),
    "pressure_3d": lambda s, e: s.stresses.pressure(e),
    "hydrostatic_pressure": lambda s, e: s.stresses.hydrostatic(e),
}
