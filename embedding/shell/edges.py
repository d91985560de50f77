"""The frame of a shell's edge, and forces that are given in it, dead or following the edge.

On an edge with the outward conormal nu, the top normal N and the tangent tau = N x nu (counter-clockwise seen from the
top) the deformed frame is

    tau' = F tau / |F tau|,      n' = n,      nu' = tau' x n,

so that nu' lies in the deformed mid-surface, square to the deformed edge. In two dimensions the edge is a point and
nu' = F nu / |F nu|. Source: theory page, "Dead and follower loads".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ngsolve import CF, Cross, IfPos, InnerProduct, Integrate, Parameter, ds, specialcf, sqrt, x

from embedding.geometry.domain import Domain
from embedding.shell.kinematics import Kinematics

Frame = tuple[Any, Any, Any]
"""Outward conormal, edge tangent, top normal; the tangent is None in two dimensions."""


@dataclass(frozen=True)
class EdgeForce:
    """Force per reference length along an edge's outward conormal, the edge and the top normal.

    ``follows`` says whether the frame is that of the deformed edge.
    """

    edge: str
    components: tuple[float, float, float]
    follows: bool


def edge_residual(
    domain: Domain, forces: tuple[EdgeForce, ...], kinematics: Kinematics, v: Any, factor: Parameter
) -> list[Any]:
    """Residual of the forces that follow their edge, as integrals of trial and test functions; not symmetric.

    ``v`` is the test function's trace source (a test function of the displacement space).
    """
    measure = factor * domain.reduction.measure
    terms = []
    for force in forces:
        if force.follows:
            direction = edge_direction(force.components, *deformed_frame(domain, kinematics))
            terms.append(edge_integral(domain, force.edge, -1 * measure * InnerProduct(direction, v.Trace())))
    return terms


def edge_direction(components: tuple[float, float, float], outward: Any, along: Any, normal: Any) -> Any:
    """The vector with ``components`` in the frame of an edge."""
    vector = components[0] * outward + components[2] * normal
    return vector if along is None else vector + components[1] * along


def reference_frame(domain: Domain) -> Frame:
    """Frame of the reference edge, on element edges."""
    outward = conormal(domain)
    return outward, Cross(domain.normal, outward) if domain.mesh.dim == 3 else None, domain.normal


def deformed_frame(domain: Domain, kinematics: Kinematics) -> Frame:
    """Frame of the deformed edge, on element edges."""
    moved = off_axis(domain, kinematics)
    outward, along, _ = reference_frame(domain)
    if along is None:
        return _unit(moved.deformation_gradient * outward), None, moved.normal
    tangent = _unit(moved.deformation_gradient * along)
    return Cross(tangent, moved.normal), tangent, moved.normal


def edge_integral(domain: Domain, edge: str, integrand: Any) -> Any:
    """The integral over ``edge`` as one over element edges, where surface gradients exist."""
    return domain.rim_indicator((edge,)) * integrand * ds(definedon=domain.shell, element_boundary=True)


def edge_mean(domain: Domain, edge: str, values: Any) -> float:
    """Mean over the reference ``edge`` of the meshed part."""
    ones, total = (Integrate(edge_integral(domain, edge, CF(v)), domain.mesh) for v in (1.0, values))
    return float(total / ones)


def off_axis(domain: Domain, kinematics: Kinematics) -> Kinematics:
    """The kinematics with a hoop stretch of 1 on the axis, which element edges touch but no rim does."""
    if domain.reduction.name != "axisymmetric":
        return kinematics
    on_axis = IfPos(x - 1e-9, 0.0, 1.0)
    hoop = 1 + kinematics.u[0] / (x + on_axis)
    return Kinematics(domain.reduction, kinematics.reference_normal, kinematics.u, hoop=hoop)


def conormal(domain: Domain) -> Any:
    """In-plane unit normal of an element's edge, pointing out of the element (from the mesh's own normal)."""
    if domain.mesh.dim == 2:
        return specialcf.tangential(2)
    return Cross(specialcf.normal(3), specialcf.tangential(3))


def _unit(vector: Any) -> Any:
    return vector / sqrt(InnerProduct(vector, vector))
