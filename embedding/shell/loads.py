"""Mechanical loads on a thin shell, as virtual work: three ways for face pressures to act, and dead loads.

With p~ = p_t - p_b, pbar = (p_t + p_b) / 2, m = J_s n the area vector and F-hat^{-T} Grad_S the deformed surface
gradient, the residual (internal minus external virtual work, per reference area) of the face pressures is

* ``net``              p~ m . v
* ``embedding-aware``  p~ m . v + T (F-hat^{-T} Grad_S pbar) . v,  and  - T pbar (F-hat^{-T} nu) . v  on a free rim
* ``as-published``     p~ m . v - 2 T H pbar n . v - T pbar F-hat^{-T} : Grad_S v

The second is consistent to first order in the thickness with pressures on the true faces; the third is the published
form (H is the reference mean curvature), kept for comparison. Source: theory page, "Face pressures" and "Errata".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ngsolve import BND, CF, H1, GridFunction, IfPos, InnerProduct, Parameter, ds, dx, x, y, z

from embedding.geometry.domain import Domain
from embedding.shell.edges import EdgeForce, conormal, edge_direction, edge_integral, off_axis, reference_frame
from embedding.shell.kinematics import Kinematics, surface_gradient

Variant = Literal["embedding-aware", "net", "as-published"]


@dataclass(frozen=True)
class MechanicalLoads:
    """Dimensionless loads at full strength; pressures are numbers or coefficient functions of the reference.

    ``edge_tractions`` and ``line_loads`` hold (name, force per reference length) in mesh components, ``edge_forces``
    loads in the frame of an edge, ``edge_moments`` (edge, moment per reference length) that turn the outward conormal
    towards the top, ``point_forces`` (place, force) of the whole body. ``body_force`` is per reference volume,
    numbers or coefficient functions, ``surface_force`` per reference area: components, or a function of shape (d,).
    """

    pressure_top: Any
    pressure_bottom: Any
    edge_tractions: tuple[tuple[str, tuple[float, ...]], ...]
    body_force: tuple[Any, ...]
    rim_is_free: bool
    variant: Variant
    edge_forces: tuple[EdgeForce, ...] = ()
    line_loads: tuple[tuple[str, tuple[float, ...]], ...] = ()
    edge_moments: tuple[tuple[str, float], ...] = ()
    point_forces: tuple[tuple[tuple[float, ...], tuple[float, ...]], ...] = ()
    surface_force: Any = None

    @property
    def uniform(self) -> bool:
        """Are both face pressures plain numbers?"""
        return isinstance(self.pressure_top, float) and isinstance(self.pressure_bottom, float)

    @property
    def difference(self) -> Any:
        """p~ = p_t - p_b."""
        return self.pressure_top - self.pressure_bottom

    @property
    def mean(self) -> Any:
        """pbar = (p_t + p_b) / 2."""
        return (self.pressure_top + self.pressure_bottom) / 2

    @property
    def pressed(self) -> bool:
        """Does any face carry a pressure?"""
        return not (self.uniform and self.pressure_top == 0.0 and self.pressure_bottom == 0.0)

    @property
    def heavy(self) -> bool:
        """Is there a force per volume?"""
        return any(not isinstance(component, float) or component != 0.0 for component in self.body_force)

    @property
    def turning(self) -> bool:
        """Does any force follow its edge?"""
        return any(force.follows for force in self.edge_forces)


def dead_load_energy(domain: Domain, loads: MechanicalLoads, thickness: Any, u: Any, factor: Parameter) -> list[Any]:
    """Potentials of the dead loads as integrals: - (T b + q) . u over the surface, - t . u over edges and lines.

    Forces at points are not among them: they are nodal vectors (:func:`embedding.shell.point_loads`).
    """
    measure = factor * domain.reduction.measure
    terms = []
    if loads.heavy:
        terms.append(-1 * measure * thickness * InnerProduct(CF(loads.body_force), u) * domain.surface())
    if loads.surface_force is not None:
        terms.append(-1 * measure * InnerProduct(CF(loads.surface_force), u) * domain.surface())
    for name, force in (*loads.edge_tractions, *loads.line_loads):
        line = dx(definedon=domain.mesh.BBoundaries(name))
        terms.append(-1 * measure * _share(domain) * InnerProduct(CF(force), u) * line)
    for framed in loads.edge_forces:
        if not framed.follows:
            direction = edge_direction(framed.components, *reference_frame(domain))
            terms.append(edge_integral(domain, framed.edge, -1 * measure * InnerProduct(direction, u)))
    return terms


def _share(domain: Domain) -> Any:
    """The part of a line that belongs to one mirror copy: a line in a mirror plane is shared by two."""
    share: Any = 1.0
    for axis in domain.reduction.planes:
        share = share * IfPos({"x": x, "y": y, "z": z}[axis] - 1e-9, 1.0, 0.5)
    return share


def enclosed_volume(domain: Domain, kinematics: Kinematics, u: Any) -> Any:
    """Density of the volume enclosed by a closed mid-surface per reference area (plane strain: per length)."""
    share = 2 if domain.reduction.name == "plane-strain" else 3
    return InnerProduct(domain.reduction.position + u, kinematics.area_vector) / share


def follower_residual(
    domain: Domain,
    loads: MechanicalLoads,
    thickness: Any,
    kinematics: Kinematics,
    v: Any,
    factor: Parameter,
) -> list[Any]:
    """Residual of the face pressures as integrals of trial and test functions; not symmetric in general.

    ``v`` is the test function's trace source (a test function of the displacement space).
    """
    measure = factor * domain.reduction.measure
    trace = v.Trace()
    surface = measure * loads.difference * InnerProduct(kinematics.area_vector, trace)
    terms = [surface * domain.surface()]
    if loads.variant == "as-published":
        bend = 2 * domain.mean_curvature * InnerProduct(kinematics.normal, trace)
        spread = InnerProduct(kinematics.inverse_transpose, surface_gradient(v)) + _hoop_rate(domain, kinematics, trace)
        terms.append(-thickness * measure * loads.mean * (bend + spread) * domain.surface())
    elif loads.variant == "embedding-aware" and not loads.uniform:
        slope = kinematics.inverse_transpose * _surface_slope(domain, loads.mean)
        terms.append(thickness * measure * InnerProduct(slope, trace) * domain.surface())
    rim_sign = _rim_sign(loads)
    if rim_sign and domain.rims:
        line = ds(definedon=domain.shell, element_boundary=True)
        outward = off_axis(domain, kinematics).inverse_transpose * conormal(domain)
        on_rim = domain.rim_indicator(domain.rims)
        terms.append(rim_sign * thickness * measure * on_rim * loads.mean * InnerProduct(outward, trace) * line)
    return terms


def _rim_sign(loads: MechanicalLoads) -> float:
    """Weight of the rim term: a free rim lacks the pressure that the closed formula would put on it."""
    if loads.variant == "embedding-aware":
        return -1.0 if loads.rim_is_free else 0.0
    return 1.0 if loads.variant == "as-published" and not loads.rim_is_free else 0.0


def _hoop_rate(domain: Domain, kinematics: Kinematics, v: Any) -> Any:
    """The part of the surface divergence of v that the axisymmetric mesh does not show: v_r / r."""
    return v[0] / (x * kinematics.hoop) if domain.reduction.name == "axisymmetric" else 0.0


def _surface_slope(domain: Domain, pressure: Any) -> Any:
    """Reference surface gradient of a pressure, projected to a continuous field first."""
    field = GridFunction(H1(domain.mesh, order=domain.sizes.order))
    field.Set(pressure, BND, definedon=domain.shell)
    return surface_gradient(field)
