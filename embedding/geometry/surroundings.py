"""Meshes of a closed shell's mid-surface as an interface inside the free space around it.

Both sides are meshed: ``inside`` and ``outside`` are materials, ``shell`` the interface between them and ``outer`` the
ambient's outer boundary. Lengths are dimensionless (shell radius 1). Elements that touch the shell get a material of
their own (``outside_near``, ``inside_near``): only there does the shell's motion enter the coupled assembly.
"""

from __future__ import annotations

from typing import Any

import netgen.meshing as netgen
import numpy as np
from netgen.occ import Edge, Glue, MoveTo, OCCGeometry, Pnt, WorkPlane
from netgen.occ import Sphere as SphereSolid
from ngsolve import Mesh

from embedding.geometry.reduction import Reduction
from embedding.geometry.surface import positive_box


def sphere_in_ball(reduction: Reduction, radius: float, shell_size: float, far_size: float, grading: float) -> Mesh:
    """Unit sphere inside a concentric ball of ``radius``: 3D (between mirror planes) or a meridian half plane."""
    if reduction.name == "axisymmetric":
        return _planar(
            radius,
            MoveTo(0, -2 * radius).Rectangle(2 * radius, 4 * radius).Face(),
            shell_size,
            far_size,
            grading,
        )
    box = positive_box(reduction.planes, 2 * radius)
    ball = SphereSolid(Pnt(0, 0, 0), 1.0) * box
    air = (SphereSolid(Pnt(0, 0, 0), radius) * box) - ball
    ball.mat("inside")
    air.mat("outside")
    _name_spheres([*ball.faces, *air.faces], radius, shell_size)
    mesh = OCCGeometry(Glue([air, ball])).GenerateMesh(maxh=far_size, grading=grading)
    return _with_near_layer(mesh)


def ring_in_disc(reduction: Reduction, radius: float, shell_size: float, far_size: float, grading: float) -> Mesh:
    """Unit circle inside a concentric disc of ``radius`` (or the quarter between mirror planes x and y)."""
    low = [0.0 if axis in reduction.planes else -2 * radius for axis in "xy"]
    part = MoveTo(low[0], low[1]).Rectangle(2 * radius - low[0], 2 * radius - low[1]).Face()
    return _planar(radius, part, shell_size, far_size, grading)


def _planar(radius: float, part: Any, shell_size: float, far_size: float, grading: float) -> Mesh:
    inner = WorkPlane().Circle(0, 0, 1.0).Face() * part
    air = (WorkPlane().Circle(0, 0, radius).Face() * part) - inner
    inner.faces.name = "inside"
    air.faces.name = "outside"
    glued = Glue([air, inner])
    for edge in glued.edges:
        edge.name = _name(edge, radius)
        if edge.name == "shell":
            edge.maxh = shell_size
    return Mesh(OCCGeometry(glued, dim=2).GenerateMesh(maxh=far_size, grading=grading))


def _name_spheres(faces: list[Any], radius: float, shell_size: float) -> None:
    for face in faces:
        face.name = _name(face, radius)
        if face.name == "shell":
            face.maxh = shell_size


def _name(shape: Any, radius: float) -> str:
    """``plane`` if the face or edge is flat on a coordinate plane, else ``shell`` or ``outer`` by its size."""
    low, high = shape.bounding_box
    extents = [high.x - low.x, high.y - low.y, high.z - low.z]
    if sum(extent < 1e-6 * radius for extent in extents) > (1 if isinstance(shape, Edge) else 0):
        return "plane"
    reach = max(abs(getattr(corner, axis)) for corner in (low, high) for axis in "xyz")
    return "outer" if reach > 0.5 * (1 + radius) else "shell"


def _with_near_layer(mesh: netgen.Mesh) -> Mesh:
    """Give the tetrahedra that share a vertex with the shell the materials ``outside_near`` and ``inside_near``."""
    names = {i + 1: mesh.GetMaterial(i + 1) for i in range(len(mesh.GetRegionNames(dim=3)))}
    near = {i: len(names) + i for i in names}
    for i, name in names.items():
        mesh.SetMaterial(near[i], f"{name}_near")
    shell_faces = [k + 1 for k, face in enumerate(mesh.FaceDescriptors()) if face.bcname == "shell"]
    triangles = mesh.Elements2D().NumPy()
    on_shell = np.zeros(len(mesh.Points()) + 1, bool)
    on_shell[triangles["nodes"][np.isin(triangles["index"], shell_faces), :3]] = True
    elements = mesh.Elements3D()
    touching = on_shell[elements.NumPy()["nodes"][:, :4]].any(axis=1)
    for number in np.flatnonzero(touching):
        element = elements[int(number)]
        element.index = near[element.index]
    return Mesh(mesh)
