"""The meshed scene: the shell's mid-surface, alone or as an interface inside the ambient, with its sides settled.

"Top" is the side the shell's normal points to, see ``sides``. NGSolve's own normals follow the order of materials or
the direction of an OCC edge, so the sign is measured on every boundary element and owned here; a mesh on which it
cannot be settled is refused.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from ngsolve import (
    BND,
    CF,
    EDGE,
    ET,
    H1,
    VERTEX,
    VOL,
    BitArray,
    Det,
    ElementId,
    FacetSurface,
    Grad,
    GridFunction,
    Integrate,
    IntegrationRule,
    Mesh,
    NodeId,
    Region,
    SurfaceL2,
    ds,
    dx,
    specialcf,
)

from embedding.errors import Problem, SceneError
from embedding.geometry import curvature, kept
from embedding.geometry.counting import TooLargeError
from embedding.geometry.cut import CloseSheetsError, JunctionError
from embedding.geometry.facets import Facets, Integers, Mask, OneSidedError
from embedding.geometry.matching import Matching
from embedding.geometry.outline import NoMeshError
from embedding.geometry.reduction import Reduction
from embedding.geometry.sides import UnclearSidesError, signs
from embedding.geometry.sizes import MeshSizes as MeshSizes
from embedding.geometry.surroundings import BodyError
from embedding.scene import Shape as Shape
from embedding.scene import SurfaceFile

FINER = ((1.0, 1.0), (1.0, 0.8), (0.9, 0.6))
"""Size on the shell and grading of the mesh that is taken, over what is asked for: now and then an element on the
hollow side of a coarse shell, with two faces on it, folds when it is curved with the shell. Smaller elements help, and
so do elements that grow less."""
FLATTEST = 1e-6
"""Curvature of a surface of size 1 that cannot be told from none."""


@dataclass(frozen=True)
class Base:
    """What a mesh made around a deformed shell starts from: its deformation to the ``reference`` shell, that to the
    curved ``ambient`` around the shell where it was made, and the ``displacement`` of the shell there; and how the
    shell's elements are those of the ``first`` mesh. See :mod:`embedding.geometry.remeshing`."""

    reference: GridFunction
    ambient: GridFunction
    displacement: GridFunction
    first: Matching


@dataclass(frozen=True)
class Domain:
    """A mesh of dimensionless coordinates with everything the physics asks of its geometry."""

    mesh: Mesh
    reduction: Reduction
    shape: Shape
    sizes: MeshSizes
    face_numbers: tuple[int, ...] = ()
    rim_vertices: Integers = field(default_factory=lambda: np.zeros(0, np.int64))
    rim_edges: Integers = field(default_factory=lambda: np.zeros((0, 2), np.int64))
    base: Base | None = None

    @property
    def has_ambient(self) -> bool:
        """Is the space around the shell meshed?"""
        return self.sizes.radius > 0

    @property
    def closed(self) -> bool:
        """Does the shell enclose a volume?"""
        return self.shape.closed

    @property
    def is_flat(self) -> bool:
        """Does the reference mid-surface lie in one plane?"""
        return isinstance(self.shape, curvature.FLAT) and self.shape.kind != "t-section"

    @property
    def curvature_radius(self) -> float:
        """Smallest radius of curvature of the reference mid-surface, dimensionless; infinite without any curvature.

        Of a surface from a file, as the mesh has it at the centres of its elements.
        """
        if isinstance(self.shape, SurfaceFile):
            slopes = self.facets.at_centres(Grad(self.reduction.normal)).reshape(-1, 3, 3)
            largest = float(np.linalg.norm(slopes, ord=2, axis=(1, 2)).max())
            return 1 / largest if largest > FLATTEST else float("inf")
        radius = self.shape.curvature_radius
        return float("inf") if radius is None else radius / self.shape.size

    @property
    def mean_curvature(self) -> Any:
        """H of the reference mid-surface, with H = -1/R on a sphere whose normal points outwards."""
        return curvature.mean_curvature(self.shape, self.reduction, self.sign)

    @cached_property
    def facets(self) -> Facets:
        """How the elements of the mid-surface hang together."""
        return Facets(self.mesh, self.shell)

    @cached_property
    def rims(self) -> tuple[str, ...]:
        """Names of the shell's true edges, of one element each (mirror planes and the axis are not edges)."""
        single = self.facets.neighbours == 1
        names = [name for name in dict.fromkeys(self.mesh.GetBBoundaries()) if name in self.shape.edges]
        return tuple(name for name in names if np.any(single & self.facets.named(name)))

    @cached_property
    def junctions(self) -> Mask:
        """Facets of the mesh (edges in 3D, vertices in two dimensions) in which three or more elements meet."""
        return self.facets.neighbours > 2

    @cached_property
    def kinks(self) -> Mask:
        """Facets of the mesh across which the reference normal jumps; junctions are not among them."""
        return self.facets.kinks(self.normal)

    def materials(self, side: str) -> str:
        """Pattern of the materials on ``side`` ("outside" or "inside")."""
        return f"{side}.*"

    def near(self, side: str) -> str:
        """Pattern of the materials on ``side`` whose elements touch the shell."""
        name = f"{side}_near"
        return name if name in self.mesh.GetMaterials() else self.materials(side)

    def far(self, side: str) -> str | None:
        """The material on ``side`` beyond the elements that touch the shell; None where all of it does."""
        return side if side in self._filled and self.near(side) != self.materials(side) else None

    @cached_property
    def _filled(self) -> set[str]:
        """Materials that have elements."""
        return {element.mat for element in self.mesh.Elements(VOL)} if self.has_ambient else set()

    @property
    def unfolded(self) -> bool:
        """Have the curved elements of the ambient a positive volume everywhere?"""
        dimension = self.mesh.dim
        rule = IntegrationRule(ET.TET if dimension == 3 else ET.TRIG, 2 * self.sizes.order)
        points = self.mesh.MapToAllElements(rule, VOL)
        with self.in_ambient():
            return bool(np.min(Det(specialcf.JacobianMatrix(dimension))(points)) > 0.0)

    @contextmanager
    def in_ambient(self) -> Iterator[None]:
        """Coefficient functions are evaluated in the configuration that the ambient's mesh starts from."""
        if self.base is None:
            yield
            return
        self.mesh.SetDeformation(self.base.ambient)
        try:
            yield
        finally:
            self.mesh.SetDeformation(self.base.reference)

    @property
    def open(self) -> bool:
        """Has the shell a rim inside the ambient?"""
        return len(self.rim_vertices) > 0

    def rim_dofs(self, space: Any) -> Mask:
        """Unknowns of a scalar H1 ``space`` on the rims that the shell has inside the ambient."""
        mask = np.zeros(space.ndof, bool)
        ends = {frozenset(edge) for edge in self.rim_edges.tolist()}
        nodes = [NodeId(VERTEX, int(vertex)) for vertex in self.rim_vertices]
        if ends:
            edges = (edge for edge in self.mesh.edges if frozenset(v.nr for v in edge.vertices) in ends)
            nodes += [NodeId(EDGE, edge.nr) for edge in edges]
        for node in nodes:
            mask[[dof for dof in space.GetDofNrs(node) if dof >= 0]] = True
        return mask

    @property
    def shell(self) -> Any:
        """The boundary region of the mid-surface."""
        return self.mesh.Boundaries("shell")

    def face(self, name: str) -> Any:
        """The boundary region of the face or faces of a file with this name."""
        names = self.shape.faces if isinstance(self.shape, SurfaceFile) else ()
        bits = BitArray(len(self.mesh.GetBoundaries()))
        bits.Clear()
        for boundary, number in enumerate(self.face_numbers):
            if 0 <= number < len(names) and names[number] == name:
                bits.Set(boundary)
        return Region(self.mesh, BND, bits)

    def patch(self, names: tuple[str, ...]) -> Any:
        """The boundary region of the faces of a file with these names; without names, the whole shell."""
        regions = [self.face(name) for name in names] or [self.shell]
        return sum(regions[1:], regions[0])

    def covered(self, names: tuple[str, ...]) -> GridFunction:
        """1 on the faces of a file with these names, 0 on the others."""
        cover = GridFunction(SurfaceL2(self.mesh, order=0, definedon=self.shell))
        for name in names:
            for element in self.face(name).Elements():
                cover.vec[cover.space.GetDofNrs(ElementId(BND, element.nr))[0]] = 1.0
        return cover

    @cached_property
    def sign(self) -> Any:
        """+1 or -1, one number or one for each element: times it, the mesh's own normal points to the top side."""
        sign = signs(self.facets, self.shape, self.reduction)
        if np.all(sign == sign[0]):
            return float(sign[0])
        field = GridFunction(SurfaceL2(self.mesh, order=0, definedon=self.shell))
        for number, value in zip(self.facets.numbers, sign, strict=True):
            field.vec[field.space.GetDofNrs(ElementId(BND, int(number)))[0]] = float(value)
        return field

    @cached_property
    def normal(self) -> Any:
        """Reference unit normal N of the mid-surface, towards the top side."""
        return self.sign * self.reduction.normal

    def volume(self, materials: str, rules: Any = None) -> Any:
        """The volume integral over ``materials``, with the quadrature every form of the field shares.

        NGSolve picks the order of a rule from the operators in a form, so that two forms of one energy would be
        integrated differently, and the potential solved alone would not solve the joint system. ``rules`` by element
        type take its place.
        """
        rules = rules or _rule(ET.TET if self.mesh.dim == 3 else ET.TRIG, self.sizes.order)
        if self.base is None:
            return dx(materials, intrules=rules)
        return dx(materials, intrules=rules, deformation=self.base.ambient)

    def surface(self, where: Any = "shell") -> Any:
        """The integral over a boundary, by name or region, with the same quadrature in every form."""
        return ds(where, intrules=_rule(ET.TRIG if self.mesh.dim == 3 else ET.SEGM, self.sizes.order))

    def potential_surface(self, where: Any = "shell") -> Any:
        """The integral over a part of the shell of what has products of the potential itself, not of its gradient.

        Of the square of a jump, :meth:`surface` would miss the polynomial of highest degree that is zero at all its
        points. In a shell of high permeability that jump would cost nothing where all others cost very much.
        """
        return ds(where, intrules=_rule(ET.TRIG if self.mesh.dim == 3 else ET.SEGM, self.sizes.potential_order))

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

    @property
    def area(self) -> float:
        """Area of the reference mid-surface of the whole body, in squares of its size (plane strain: per length).

        Anew every time: what the error of the geometry is, a mesh that is curved again tells.
        """
        return self.shell_integral(1.0)


def _rule(element: Any, degree: int) -> dict[Any, Any]:
    """Exact for products of two polynomials of ``degree`` on a straight element."""
    return {element: IntegrationRule(element, 2 * degree)}


def build(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Domain:
    """Mesh ``shape`` in ``reduction`` at the requested ``sizes`` and curve the mesh to the order of the fields.

    Lengths are divided by the size of the shape.

    Raises:
        SceneError: the surface has no two sides, because it is one-sided or has junctions inside an ambient; there is
            no room for a body; or there is no sound mesh of these sizes.
    """
    if not sizes.radius:
        return _built(shape, reduction, sizes)
    for size, growth in FINER:
        finer = replace(sizes, shell=size * sizes.shell, grading=growth * sizes.grading)
        domain = _built(shape, reduction, finer)
        if domain.unfolded:
            return domain
    raise _unfit("elements around the curved shell are folded: make the mesh on the shell finer")


def _built(shape: Shape, reduction: Reduction, sizes: MeshSizes) -> Domain:
    try:
        meshed = kept.mesh(shape, reduction, sizes)
        meshed.mesh.Curve(sizes.order)
        domain = Domain(meshed.mesh, reduction, shape, sizes, meshed.faces, meshed.rim_vertices, meshed.rim_edges)
        _ = domain.normal
    except (OneSidedError, JunctionError) as error:
        reason = f"not allowed: {error}, so it has no top" if isinstance(error, OneSidedError) else (
            f"not allowed with an ambient: {error}, and the space between them has no top and bottom")  # fmt: skip
        raise SceneError([Problem("shell.shape", reason)]) from error
    except BodyError as error:
        raise SceneError([Problem(f"ambient.bodies.{error.number}", f"not allowed here: {error}")]) from error
    except (CloseSheetsError, UnclearSidesError) as error:
        raise _unfit(f"{error}: make the mesh on the shell finer") from error
    except TooLargeError as error:
        raise SceneError([Problem(error.field, f"{error}: make elements larger")]) from error
    except NoMeshError as error:
        raise _unfit(f"{error}: choose another size") from error
    if np.any((domain.facets.neighbours == 1) & ~domain.facets.on_edges):
        raise _unfit("the mesh of the shell has holes: choose another size")
    return domain


def _unfit(reason: str) -> SceneError:
    return SceneError([Problem("discretisation.shell_size", reason)])
