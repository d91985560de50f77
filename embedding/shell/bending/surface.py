"""Bending of a surface in space: moments inside the elements, rotations on their edges.

The moment tensor m lives element by element and is eliminated there; its normal-normal component is made continuous
by one rotation per edge, which is what remains beside the displacement. With d = lambda n, N the reference normal,
t and nu the tangent and the outward conormal of an element's edge,

    sum over elements of  int m : [Hess(u) . d - (N . d) Grad N + sym(Grad N C)]
                          + oint (angle / |F t| + rotation) m_nu_nu

is m : K with the distributional K = lambda b - sym(B C), B = -Grad N: the edge terms carry the angle between
neighbouring elements. It is measured on each side from a common direction, the averaged normal of the present state;
the sum of the two sides does not depend on it, so it may be renewed at any time. Kinks and branches of the reference
keep their angle. On an edge with a given moment there is one side alone, and how the angle changes as the edge turns
within the surface does depend on it: a moment about an edge that turns has no potential (J. H. Argyris, Comput. Methods
Appl. Mech. Eng. 32 (1982) 85), and its tangent is not symmetric.

Source: M. Neunteufel and J. Schoeberl, The Hellan-Herrmann-Johnson method for nonlinear shells, Comput. Struct. 225
(2019) 106109; the weight 1 / |F t| is the push-forward of the pairing, see the theory page, "Bending".
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import (
    BND,
    CF,
    ET,
    Cof,
    Cross,
    Grad,
    GridFunction,
    HDivDivSurface,
    IfPos,
    InnerProduct,
    IntegrationRule,
    NormalFacetSurface,
    Trace,
    VectorFacetSurface,
    atan2,
    ds,
    specialcf,
    sqrt,
)

from embedding.geometry.domain import Domain
from embedding.geometry.ends import directions, facets_named, facets_on_plane, unknowns_on
from embedding.geometry.spaces import ON_PLANE, Mask, TraceSpace, as_mask
from embedding.shell.bending.stiffness import EdgeMoments, Stiffness
from embedding.shell.kinematics import Kinematics, surface_gradient

LEANING = 0.7
"""Largest cosine between a normal and the plane's axis for a shell that counts as crossing that plane."""


class SurfaceBending:
    """Spaces and energy of bending on the triangles of ``domain``'s shell.

    ``held`` names the edges whose rotation is held; edges on mirror planes hold it by themselves. ``moments`` are given
    on edges, per reference length. ``reference`` is the averaged normal of the reference, ``degree`` that of the rules.
    """

    condensed = "moment"

    def __init__(self, domain: Domain, stiffness: Stiffness, held: tuple[str, ...], moments: EdgeMoments = ()) -> None:
        self.domain, self.stiffness, self._moments = domain, stiffness, moments
        mesh, order = domain.mesh, domain.sizes.order - 1
        self._moment = HDivDivSurface(mesh, order=order, discontinuous=True, definedon=domain.shell)
        self._rotation = NormalFacetSurface(mesh, order=order, definedon=domain.shell)
        self._held = facets_named(domain.facets, held)
        axis = self._square_axes(self._held)
        self._fixed = self._held[axis < 0]
        self._mirrored = [(i, self._held[axis == i]) for i in range(3)]
        planes = [i for i, name in enumerate("xyz") if name in domain.reduction.planes]
        self._mirrored += [(i, facets_on_plane(domain.facets, i)) for i in planes]
        frame = VectorFacetSurface(mesh, order=order, definedon=domain.shell)
        self.reference, self._average = GridFunction(frame), GridFunction(frame)
        self._sign = domain.sign
        self._average_of(domain.normal, self.reference)
        self._average.vec.data = self.reference.vec
        self.degree = 2 * order + 1
        rules = {element: IntegrationRule(element, self.degree) for element in (ET.TRIG, ET.SEGM)}
        self._surface = ds("shell", intrules=rules)
        self._edges = ds(definedon=domain.shell, element_boundary=True, intrules=rules)

    def _square_axes(self, edges: Any) -> Any:
        """For each edge the coordinate axis square to it and most nearly square to the normal, -1 without one.

        Where an edge lies in a plane and may move in it, the normal stays in that plane; the frame follows it there.
        """
        facets = self.domain.facets
        normals = np.zeros((facets.count, 3))
        normals[facets.of_element] = facets.at_facets(self.domain.normal)
        leaning = np.abs(normals[edges]) + 2.0 * (np.abs(directions(facets, edges)) > ON_PLANE)
        return np.where(leaning.min(axis=1, initial=2.0) < LEANING, leaning.argmin(axis=1), -1)

    def parts(self) -> dict[str, tuple[Any, Mask]]:
        """The spaces by name, with their free unknowns."""
        free = as_mask(self._rotation.FreeDofs())
        for edges in [self._held, *(edges for _, edges in self._mirrored)]:
            free[unknowns_on(self._rotation, edges)] = False
        return {"moment": (self._moment, as_mask(self._moment.FreeDofs())), "rotation": (self._rotation, free)}

    def energies(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> list[Any]:
        """Integrals whose stationary point in moment and rotation is the bending energy less the work of the moments
        on edges, times ``factor``.

        They are kept apart because each compiles to its own product of few unknowns, which is the faster assembly.
        """
        copies = self.domain.reduction.measure
        moment, rotation = values["moment"].Trace(), values["rotation"].Trace()
        F, d, N = kinematics.deformation_gradient, kinematics.director, kinematics.reference_normal
        slope = self._sign * Grad(specialcf.normal(3))  # Grad N = -B
        bent = InnerProduct((values["u"].Operator("hesseboundary").trans * d).Reshape((3, 3)), moment)
        rest = InnerProduct(F * slope, F * moment) - InnerProduct(N, d) * InnerProduct(slope, moment)
        rest = rest - self.stiffness.dual(kinematics, moment)
        return [
            copies * bent * self._surface,
            copies * rest * self._surface,
            copies * self._edge_density(kinematics, moment, rotation) * self._edges,
            *(copies * factor * self._work(*given, kinematics, rotation) * self._edges for given in self._moments),
        ]

    def _work(self, edge: str, given: float, kinematics: Kinematics, rotation: Any) -> Any:
        """Minus the given moment times the angle that the edge turns by, rotation |F t|."""
        nu, _, length = self._edge_frame(kinematics)
        angle = self._sign * InnerProduct(rotation, nu) * length
        return -given * self.domain.rim_indicator((edge,)) * angle

    def residuals(self, values: dict[str, Any], test: Any, kinematics: Kinematics) -> list[Any]:
        """On edges with given moments: the work of m_nu_nu on the turn of the surface about the edge, less what the
        energies have for it. It vanishes where the averaged normal is the normal, but its derivative does not.

        ``test`` is the test function of the displacement.
        """
        if not self._moments:
            return []
        gradient, m = surface_gradient(test), kinematics.area_vector
        nu, stretched, length = self._edge_frame(kinematics)
        moved = gradient * specialcf.tangential(3)
        F = kinematics.deformation_gradient
        turned = (Cof(F + gradient) - Cof(F) - Cof(gradient)) * kinematics.reference_normal  # the change of m
        across, along = self._leaning(kinematics)
        across_change = self._sign * InnerProduct(Cross(turned, stretched) + Cross(m, moved), self._average)
        along_change = InnerProduct(InnerProduct(stretched, moved) / length * m + length * turned, self._average)
        seen = (along * across_change - across * along_change) / (across**2 + along**2)
        turn = self._sign * InnerProduct(turned, Cross(stretched, m)) / (length * InnerProduct(m, m))
        work = values["moment"].Trace()[nu, nu] / length * (seen - turn)
        edges = self.domain.rim_indicator(tuple(edge for edge, _ in self._moments))
        return [self.domain.reduction.measure * edges * work * self._edges]

    def _leaning(self, kinematics: Kinematics) -> tuple[Any, Any]:
        """Sine and cosine of the angle from the averaged normal to the normal about the edge, times J_s |F t|."""
        m, (_, stretched, length) = kinematics.area_vector, self._edge_frame(kinematics)
        across = self._sign * InnerProduct(Cross(m, stretched), self._average)
        return across, length * InnerProduct(m, self._average)

    def _edge_frame(self, kinematics: Kinematics) -> tuple[Any, Any, Any]:
        """Outward conormal nu, the deformed tangent F t and its length, on element edges."""
        t = specialcf.tangential(3)
        stretched = kinematics.deformation_gradient * t
        return Cross(specialcf.normal(3), t), stretched, sqrt(InnerProduct(stretched, stretched))

    def _edge_density(self, kinematics: Kinematics, moment: Any, rotation: Any) -> Any:
        nu, _, length = self._edge_frame(kinematics)
        angle = atan2(*self._leaning(kinematics))
        N = kinematics.reference_normal
        angle_0 = atan2(InnerProduct(nu, self.reference), InnerProduct(N, self.reference))
        turn = (angle_0 - angle) / length + self._sign * InnerProduct(rotation, nu)
        return turn * moment[nu, nu]

    def rotation_work(self, moment: Any, rotation: Any) -> Any:
        """The term of the energy that is bilinear in ``moment`` and ``rotation``, as an integral."""
        nu = Cross(specialcf.normal(3), specialcf.tangential(3))
        across = self._sign * InnerProduct(rotation, nu) * moment[nu, nu]
        return self.domain.reduction.measure * across * self._edges

    def stored(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> Any:
        """Bending energy per reference area of converged moments, as a coefficient function: W_b = W_b* there.

        The moments given on edges, ``factor`` times them, are in the unknown.
        """
        return self.stiffness.dual(kinematics, values["moment"])

    def shear_force_squared(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> Any:
        """Square of the shear force per reference length that the moments are in balance with, their divergence, of a
        shell that is hardly stretched; moments are made continuous before."""
        space = TraceSpace(self.domain.mesh, self.domain.sizes.order, vector=False, reach="shell").scalar
        normal, moment = self.domain.normal, values["moment"]
        divergence = []
        for i in range(3):
            rows = []
            for j in range(3):
                entry = GridFunction(space)
                entry.Set(moment[i, j], BND, definedon=self.domain.shell)
                rows.append(surface_gradient(entry)[j])
            divergence.append(rows[0] + rows[1] + rows[2])
        force = CF(tuple(divergence))
        across = InnerProduct(force, normal)
        return InnerProduct(force, force) - across * across

    def principal_moments(self, values: dict[str, Any], kinematics: Kinematics, factor: Any) -> tuple[Any, Any]:
        """Larger and smaller principal bending moment per deformed length, of lambda F m F^T / J_s."""
        F = kinematics.deformation_gradient
        pushed = (F * values["moment"]) * F.trans / kinematics.surface_stretch_squared
        half = Trace(pushed) / 2
        inside = InnerProduct(pushed, pushed) / 2 - half * half
        root = sqrt(IfPos(inside, inside, CF(0.0)))
        return half + root, half - root

    def refresh(self, kinematics: Kinematics) -> None:
        """Take the averaged normal from the present state, given by its ``kinematics`` on grid functions."""
        self._average_of(kinematics.area_vector, self._average)

    def continue_from(self, other: SurfaceBending) -> None:
        """Measure rotations from where ``other``, of another order on the same mesh, does: where more than two sheets
        meet, they depend on it."""
        mine, others = (bending._average for bending in (self, other))
        mine.vec[:] = 0.0
        for edge in np.flatnonzero(self.domain.facets.neighbours > 0):
            for component in range(3):  # the polynomials on an edge are hierarchical
                new, old = (unknowns_on(field.space, np.array([edge]), (component,)) for field in (mine, others))
                mine.vec.FV().NumPy()[new[: len(old)]] = others.vec.FV().NumPy()[old]

    def _average_of(self, normal: Any, target: GridFunction) -> None:
        target.Set(normal, dual=True, definedon=self.domain.shell)
        values = target.vec.FV().NumPy()
        if target is not self.reference:
            fixed = unknowns_on(target.space, self._fixed, range(3))
            values[fixed] = self.reference.vec.FV().NumPy()[fixed]
        for component, edges in self._mirrored:
            values[unknowns_on(target.space, edges, (component,))] = 0.0

    @property
    def memory(self) -> npt.NDArray[np.float64]:
        """What rotations are measured from, for a state that may be gone back to."""
        return np.array(self._average.vec.FV().NumPy())

    @memory.setter
    def memory(self, values: npt.NDArray[np.float64]) -> None:
        self._average.vec.FV().NumPy()[:] = values
