"""A conductor, held at 0 or 1, in space that is open: meshes and solver for far fields alone, without a shell.

The conductor is a unit sphere (plane strain: circle) off the centre, or in axisymmetry a thin unit disc. Around it lies
the ball of a given radius, boundary `outer`, and if wanted the mapped region `beyond`, or Kelvin's ball, which shares
the vertices of the outer boundary. The mesh is curved to the order of the potential, one more than the product's: what
is measured is the far field.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import netgen.meshing as netgen
from netgen.occ import Glue, MoveTo, OCCGeometry, Pnt, Segment, Sphere, WorkPlane
from ngsolve import BND, CF, H1, BilinearForm, Grad, GridFunction, InnerProduct, Mesh, Variation, dx

from embedding.geometry.domain import Domain, MeshSizes
from embedding.geometry.reduction import Name, Reduction
from embedding.geometry.surroundings import REACH
from embedding.scene import Disc as DiscShape
from embedding.scene import Sphere as SphereShape

OFFSET = 0.36
"""Of the centre of the sphere along the axis of symmetry (plane strain: along x)."""
Region = Literal["none", "beyond", "kelvin"]


@dataclass(frozen=True)
class Request:
    """What is meshed: element sizes on the conductor and far away; with a size at the ``rim``, a disc."""

    name: Name
    radius: float
    order: int
    region: Region = "none"
    shell: float = 0.6
    far: float = 0.8
    rim: float | None = None


def open_space(request: Request) -> Domain:
    """The domain of a request."""
    reduction = Reduction(request.name)
    flat = reduction.dimension == 2
    geometry = OCCGeometry(_planar(request), dim=2) if flat else OCCGeometry(_spatial(request))
    mesh = geometry.GenerateMesh(maxh=request.far, grading=0.5)
    if request.region == "kelvin":
        _add_kelvin_ball(mesh, request.far)
    curved = Mesh(mesh)
    curved.Curve(request.order)
    sizes = MeshSizes(request.shell, request.far, request.radius, 0.5, request.order - 1)
    return Domain(curved, reduction, DiscShape(radius=1.0) if request.rim else SphereShape(radius=1.0), sizes)


def _spatial(request: Request) -> Any:
    ball = Sphere(Pnt(0, 0, 0), request.radius)
    ball.faces.name = "outer"
    conductor = Sphere(Pnt(0, 0, OFFSET), 1.0)
    conductor.faces.name = "shell"
    conductor.faces.maxh = request.shell
    inner = ball - conductor
    inner.mat("outside")
    if request.region != "beyond":
        return inner
    end = Sphere(Pnt(0, 0, 0), REACH * request.radius)
    end.faces.name = "infinity"
    mapped = end - Sphere(Pnt(0, 0, 0), request.radius)
    mapped.mat("beyond")
    return Glue([inner, mapped])


def _planar(request: Request) -> Any:
    axial = request.name == "axisymmetric"
    wide = 4 * request.radius
    part = MoveTo(0.0 if axial else -wide, -wide).Rectangle(wide if axial else 2 * wide, 2 * wide).Face()
    disc = WorkPlane().Circle(0, 0, request.radius).Face()
    centre = (0.0, OFFSET) if axial else (OFFSET, 0.0)
    inner = disc * part if request.rim else (disc - WorkPlane().Circle(*centre, 1.0).Face()) * part
    inner.faces.name = "outside"
    faces = [inner] if request.rim is None else [inner, _disc_edge(request.rim)]
    if request.region == "beyond":
        mapped = (WorkPlane().Circle(0, 0, REACH * request.radius).Face() - disc) * part
        mapped.faces.name = "beyond"
        faces.append(mapped)
    glued = Glue(faces)
    for edge in glued.edges:
        low, high = edge.bounding_box
        reach = max(abs(value) for corner in (low, high) for value in (corner.x, corner.y))
        if axial and high.x < 1e-6:
            edge.name = "axis"
        elif reach < 1.01 + OFFSET:
            edge.name = "shell"
            edge.maxh = request.shell
        else:
            edge.name = "outer" if reach < 1.01 * request.radius else "infinity"
    return glued


def _disc_edge(rim: float) -> Any:
    edge = Segment(Pnt(0, 0, 0), Pnt(1, 0, 0))
    edge.vertices.Max((1, 0, 0)).maxh = rim
    return edge


def _add_kelvin_ball(mesh: netgen.Mesh, size: float) -> None:
    """Fill the surface `outer` with tetrahedra of their own, in the material `kelvin`."""
    outer = {number + 1 for number, face in enumerate(mesh.FaceDescriptors()) if face.bcname == "outer"}
    ball = netgen.Mesh(dim=3)
    surface = ball.Add(netgen.FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
    points, inside, shared = mesh.Points(), {}, {}
    for element in mesh.Elements2D():
        if element.index in outer:
            for vertex in element.vertices:
                if vertex.nr not in inside:
                    inside[vertex.nr] = ball.Add(netgen.MeshPoint(netgen.Pnt(*points[vertex].p)))
                    shared[inside[vertex.nr].nr] = vertex
            ball.Add(netgen.Element2D(surface, [inside[vertex.nr] for vertex in element.vertices]))
    ball.GenerateVolumeMesh(maxh=size)
    for number in range(1, len(ball.Points()) + 1):
        if number not in shared:
            place = ball.Points()[netgen.PointId(number)].p
            shared[number] = mesh.Add(netgen.MeshPoint(netgen.Pnt(*place)))
    mesh.SetMaterial(2, "kelvin")
    for element in ball.Elements3D():
        mesh.Add(netgen.Element3D(2, [shared[vertex.nr] for vertex in element.vertices]))


@dataclass(frozen=True)
class Answer:
    """The conductor's charge and dipole moment about the origin (mesh axes), unknowns, time, potential."""

    charge: float
    dipole: tuple[float, ...]
    unknowns: int
    seconds: float
    potential: GridFunction


def answer(domain: Domain, far: Callable[[Any], list[Any]], voltage: Any, held: str = "") -> Answer:
    """Solve with the conductor at ``voltage``; ``far`` gives the energies of the potential beyond the ball.

    ``held`` are further boundaries, at 0. Charge and dipole come from the rows of the conductor's unknowns: as accurate
    as the energy.
    """
    reduction, mesh = domain.reduction, domain.mesh
    space = H1(mesh, order=domain.sizes.potential_order, dirichlet="|".join(filter(None, ("shell", held))))
    potential, step = GridFunction(space), GridFunction(space)
    start = time.process_time()
    trial = space.TrialFunction()
    form = BilinearForm(space, symmetric=True)
    energy = 0.5 * reduction.measure * InnerProduct(Grad(trial), Grad(trial))
    form += Variation(energy * dx("outside.*|inside.*", bonus_intorder=1)).Compile()
    for term in far(trial):
        form += Variation(term).Compile()
    potential.Set(voltage, BND, definedon=mesh.Boundaries("shell"))
    form.AssembleLinearization(potential.vec)
    residual = potential.vec.CreateVector()
    form.Apply(potential.vec, residual)
    step.vec.data = form.mat.Inverse(space.FreeDofs(), inverse="sparsecholesky") * residual
    potential.vec.data -= step.vec
    form.Apply(potential.vec, residual)
    seconds = time.process_time() - start

    def moment(weight: Any) -> float:
        step.vec[:] = 0.0
        step.Set(weight, BND, definedon=mesh.Boundaries("shell"))
        return float(InnerProduct(residual, step.vec))

    components = tuple(moment(reduction.position[i]) for i in range(mesh.dim))
    return Answer(moment(CF(1.0)), components, space.ndof, seconds, potential)


def sphere_answer(voltage: float, field: float) -> tuple[float, float]:
    """Exact charge, and dipole moment about the origin along the axis, of the unit sphere at ``OFFSET`` on the axis.

    A uniform ``field`` along the axis has the potential -field OFFSET at the centre; what is left makes the charge,
    and the field the moment 4 pi field about the centre.
    """
    charge = 4 * math.pi * (voltage + field * OFFSET)
    return charge, 4 * math.pi * field + OFFSET * charge


def circle_answer(field: float) -> tuple[float, float]:
    """The same of the unit circle at 0 per length: no charge, 2 pi field, across the line of the centres."""
    return 0.0, 2 * math.pi * field
