"""The meshed scene: the shell's mid-surface, alone or as an interface inside the ambient, with its sides settled.

"Top" is the side the shell's normal points to: the outside of a closed shell, +z of a plate or disc. NGSolve's own
normals follow the order of materials or the direction of an OCC edge, so the sign is measured on every boundary
element and owned here; a mesh on which it cannot be settled is refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from ngsolve import (
    BND,
    CF,
    ET,
    H1,
    ElementId,
    FacetSurface,
    GridFunction,
    Integrate,
    IntegrationRule,
    Mesh,
    SurfaceL2,
    ds,
    dx,
)

from embedding.geometry import surface, surroundings
from embedding.geometry.reduction import Reduction
from embedding.scene import Disc, InfiniteCylinder, Plate, Sphere

Shape = Plate | Disc | Sphere | InfiniteCylinder


@dataclass(frozen=True)
class MeshSizes:
    """Dimensionless mesh request: sizes on the shell and far away, the ambient's radius (0: no ambient), grading."""

    shell: float
    far: float
    radius: float
    grading: float
    order: int

    @property
    def potential_order(self) -> int:
        """Order of the potential: one above the shell's.

        The field's energy enters the Lagrangian with a minus sign. At equal order a distorted mesh overestimates it by
        more than a soft membrane can afford, and creases that do not exist gain energy.
        """
        return self.order + 1


@dataclass(frozen=True)
class Domain:
    """A mesh of dimensionless coordinates with everything the physics asks of its geometry."""

    mesh: Mesh
    reduction: Reduction
    shape: Shape
    sizes: MeshSizes

    @property
    def has_ambient(self) -> bool:
        """Is the space around the shell meshed?"""
        return self.sizes.radius > 0

    @property
    def closed(self) -> bool:
        """Does the shell enclose a volume?"""
        return isinstance(self.shape, Sphere | InfiniteCylinder)

    @property
    def mean_curvature(self) -> float:
        """H of the reference mid-surface, with H = -1/R on a sphere whose normal points outwards."""
        return {"sphere": -1.0, "infinite-cylinder": -0.5}.get(self.shape.kind, 0.0)

    @property
    def rims(self) -> tuple[str, ...]:
        """Names of the shell's true edges (mirror planes and the axis are not edges)."""
        return {"plate": ("x0", "x1", "y0", "y1"), "disc": ("rim",)}.get(self.shape.kind, ())

    def materials(self, side: str) -> str:
        """Pattern of the materials on ``side`` ("outside" or "inside")."""
        return f"{side}.*"

    def near(self, side: str) -> str:
        """Pattern of the materials on ``side`` whose elements touch the shell."""
        name = f"{side}_near"
        return name if name in self.mesh.GetMaterials() else self.materials(side)

    @property
    def shell(self) -> Any:
        """The boundary region of the mid-surface."""
        return self.mesh.Boundaries("shell")

    @cached_property
    def normal(self) -> Any:
        """Reference unit normal N of the mid-surface, towards the top side."""
        centre = IntegrationRule([(1 / 3, 1 / 3)], [0.5]) if self.mesh.dim == 3 else IntegrationRule([(0.5,)], [1.0])
        points = self.mesh.MapToAllElements(centre, self.shell)
        up = self._up(np.asarray(self.reduction.position(points)))
        alignment = np.einsum("ij,ij->i", np.asarray(self.reduction.normal(points)), up)
        if np.abs(alignment).min() < 0.1:
            raise RuntimeError("the shell's sides cannot be told apart on this mesh: make it finer on the shell")
        signs = np.sign(alignment)
        if np.all(signs == signs[0]):
            return float(signs[0]) * self.reduction.normal
        field = GridFunction(SurfaceL2(self.mesh, order=0, definedon=self.shell))
        for sign, point in zip(signs, points, strict=True):
            field.vec[field.space.GetDofNrs(ElementId(BND, int(point["nr"])))[0]] = float(sign)
        return field * self.reduction.normal

    def _up(self, positions: Any) -> Any:
        """A vector field that points to the top side, at mesh ``positions`` of shape (n, d)."""
        if self.closed:
            return positions
        up = np.zeros_like(positions)
        up[:, -1] = 1.0
        return up

    def volume(self, materials: str) -> Any:
        """The volume integral over ``materials``, with the quadrature every form of the field shares.

        NGSolve picks the order of a rule from the operators in a form, so that two forms of one energy would be
        integrated differently, and the potential solved alone would not solve the joint system.
        """
        return dx(materials, intrules=self._rules(ET.TET if self.mesh.dim == 3 else ET.TRIG))

    def surface(self, name: str = "shell") -> Any:
        """The integral over the boundary ``name`` with the same quadrature in every form."""
        return ds(name, intrules=self._rules(ET.TRIG if self.mesh.dim == 3 else ET.SEGM))

    def _rules(self, element: Any) -> dict[Any, Any]:
        return {element: IntegrationRule(element, 2 * self.sizes.order)}

    def rim_indicator(self, names: tuple[str, ...]) -> Any:
        """1 on the edges ``names`` of the shell, 0 on every other element edge, for element-boundary integrals."""
        pattern = "|".join(names)
        if self.mesh.dim == 2:
            hats = GridFunction(H1(self.mesh, order=1))
            for dof in np.flatnonzero(
                [hats.space.GetDofs(self.mesh.BBoundaries(pattern))[i] for i in range(self.mesh.nv)]
            ):
                hats.vec[int(dof)] = 1.0
            return hats
        facets = GridFunction(FacetSurface(self.mesh, order=0, definedon=self.shell))
        facets.Set(1, definedon=self.mesh.BBoundaries(pattern))
        return facets

    def shell_integral(self, values: Any) -> float:
        """Integral of ``values`` over the reference mid-surface of the whole body (plane strain: per length)."""
        return float(Integrate(CF(values) * self.reduction.measure * self.surface(), self.mesh))


def build(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Domain:
    """Mesh ``shape`` in ``reduction`` at the requested ``sizes`` and curve the mesh to the order of the fields.

    A plate is scaled to a larger side of 1, every other shape to radius 1.
    """
    mesh = _mesh(shape, reduction, sizes)
    mesh.Curve(sizes.order)
    domain = Domain(mesh, reduction, shape, sizes)
    _ = domain.normal
    return domain


def _mesh(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Mesh:
    if sizes.radius:
        make = surroundings.sphere_in_ball if isinstance(shape, Sphere) else surroundings.ring_in_disc
        return make(reduction, sizes.radius, sizes.shell, sizes.far, sizes.grading)
    if isinstance(shape, Plate):
        scale = max(shape.length, shape.width)
        return surface.plate(shape.length / scale, shape.width / scale, sizes.shell)
    if isinstance(shape, Disc):
        return surface.disc(reduction, sizes.shell)
    return surface.sphere(reduction, sizes.shell) if isinstance(shape, Sphere) else surface.ring(reduction, sizes.shell)
