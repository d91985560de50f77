"""Plain NGSolve: the charged balloon in 3D as a script that solves membrane and field in turn; prints one line of JSON.

``python ngsolve_balloon.py ORDER SHELL_SIZE GRADING STEPS PART``: polynomial ORDER of the displacement, SHELL_SIZE in
radii, voltage in STEPS; PART is "whole", or "octant" for one between three mirror planes, as one draws it who sees
that the answer has them. The membrane is an energy on the boundary of the space; the potential, of one order more,
lives in the space outside, whose mesh is deformed by an extension of the outer face's displacement. The pull on the
outer face acts on the present mid-surface; its force is kept as it is while the membrane moves. Past the limit of a
given pressure, where this balloon ends, only that converges; without relaxation in a few turns. Lengths in radii,
stresses in shear moduli, the permittivity is 1.
"""

from __future__ import annotations

import json
import sys
import time

import numpy as np
from netgen.occ import Box, OCCGeometry, Pnt, Sphere
from ngsolve import (
    BND,
    H1,
    BilinearForm,
    BitArray,
    BoundaryFromVolumeCF,
    Cof,
    GridFunction,
    Id,
    InnerProduct,
    Integrate,
    LinearForm,
    Mesh,
    Norm,
    OuterProduct,
    SurfaceL2,
    Variation,
    VectorH1,
    ds,
    dx,
    grad,
    specialcf,
)

OUTER, THICKNESS = 4.0, 0.05
VOLTAGE = 600e3 / 0.02 * np.sqrt(8.8541878128e-12 / 30e3)
"""600 kV on 20 mm and 30 kPa."""
TURNS, NEWTON, SETTLED = 60, 30, 1e-6
MOVED, ON_THE_WAY = 1e-4, 1e-2
"""Turns end when the membrane has moved by less; before the last voltage sooner."""


def meshed(order: int, size: float, grading: float, octant: bool) -> Mesh:
    """The space between the balloon and the ball in which it is computed, or an octant of it."""
    balloon = Sphere(Pnt(0, 0, 0), 1.0)
    balloon.faces.name, balloon.faces.maxh = "shell", size
    outer = Sphere(Pnt(0, 0, 0), OUTER)
    outer.faces.name = "outer"
    space = outer - balloon
    if octant:
        space *= Box(Pnt(0, 0, 0), Pnt(2 * OUTER, 2 * OUTER, 2 * OUTER))
        for face in space.faces:
            for axis, name in enumerate("xyz"):
                if abs(face.center[axis]) < 1e-6:
                    face.name = name
    mesh = Mesh(OCCGeometry(space).GenerateMesh(maxh=OUTER / 2, grading=grading))
    mesh.Curve(order)
    return mesh


def bits(mask: np.ndarray) -> BitArray:
    """A mask as NGSolve has them."""
    out = BitArray(len(mask))
    for i, bit in enumerate(mask):
        out[i] = bool(bit)
    return out


def held(mesh: Mesh, moved: VectorH1) -> np.ndarray:
    """Six components that keep the whole balloon from rigid motions: the poles stay on their axis, a point of the
    equator in its plane and meridian."""
    points, out = mesh.ngmesh.Coordinates(), np.zeros(moved.ndof, dtype=bool)
    for place, axes in (((0, 0, 1), (0, 1)), ((0, 0, -1), (0, 1)), ((1, 0, 0), (1, 2))):
        nearest = int(np.argmin(np.linalg.norm(points - place, axis=1)))
        for axis in axes:
            out[moved.Range(axis).start + nearest] = True
    return out


class Balloon:
    """Membrane, moving space and field, each with its own solve."""

    def __init__(self, order: int, size: float, grading: float, octant: bool) -> None:
        self.mesh = mesh = meshed(order, size, grading, octant)
        self.moved = VectorH1(mesh, order=order, dirichletx="x", dirichlety="y", dirichletz="z")
        self.potential = H1(mesh, order=order + 1, dirichlet="shell")
        self.u, self.phi, self.place = GridFunction(self.moved), GridFunction(self.potential), GridFunction(self.moved)
        self.normal = -specialcf.normal(3)
        unmoved = np.fromiter(self.moved.FreeDofs(), bool)
        if not octant:
            unmoved &= ~held(mesh, self.moved)
        shell = np.fromiter(self.moved.GetDofs(mesh.Boundaries("shell")), bool)
        outer = np.fromiter(self.moved.GetDofs(mesh.Boundaries("outer")), bool)
        self.on_shell, self.inside = bits(unmoved & shell), bits(unmoved & ~shell & ~outer)
        trial = self.moved.TrialFunction()
        stretched = Cof(Id(3) + grad(trial).Trace()) * self.normal
        gradient = Id(3) - OuterProduct(self.normal, self.normal) + grad(trial).Trace()
        area = InnerProduct(stretched, stretched)
        energy = 0.5 * THICKNESS * (InnerProduct(gradient, gradient) + 1 / area - 3)
        self.membrane = BilinearForm(self.moved, symmetric=True)
        self.membrane += Variation(energy * ds("shell")).Compile()
        self.extension = BilinearForm(self.moved, symmetric=True)
        v, w = self.moved.TnT()
        self.extension += (InnerProduct(grad(v), grad(w)) / specialcf.mesh_size**2) * dx
        self.extension.Assemble()
        self.extend = self.extension.mat.Inverse(self.inside, inverse="sparsecholesky")
        self.field = BilinearForm(self.potential, symmetric=True)
        p, q = self.potential.TnT()
        self.field += grad(p) * grad(q) * dx + p * q / OUTER * ds("outer")
        self.deformed = Cof(Id(3) + grad(self.u).Trace()) * self.normal
        self.pull = GridFunction(SurfaceL2(mesh, order=order, definedon=mesh.Boundaries("shell")))
        strength = BoundaryFromVolumeCF(grad(self.phi))
        self.traction = 0.5 * InnerProduct(strength, strength)
        self.force = LinearForm(self.moved)
        self.force += self.pull * InnerProduct(self.deformed, w.Trace()) * ds("shell")
        self.iterations = 0

    def solve_field(self, voltage: float) -> None:
        """Move the space with the outer face, solve for the potential there and assemble its force."""
        face = self.u + 0.5 * THICKNESS * self.deformed / InnerProduct(self.deformed, self.deformed)
        start = GridFunction(self.moved)
        start.Set(face, BND, definedon=self.mesh.Boundaries("shell"))
        self.place.vec.data = start.vec
        self.place.vec.data -= self.extend * (self.extension.mat * start.vec).Evaluate()
        self.mesh.SetDeformation(self.place)
        self.field.Assemble()
        self.phi.vec[:] = 0.0
        self.phi.Set(voltage, BND, definedon=self.mesh.Boundaries("shell"))
        inverse = self.field.mat.Inverse(self.potential.FreeDofs(), inverse="sparsecholesky")
        self.phi.vec.data -= inverse * (self.field.mat * self.phi.vec).Evaluate()
        self.pull.Set(self.traction, definedon=self.mesh.Boundaries("shell"))
        self.mesh.UnsetDeformation()
        self.force.Assemble()

    def solve_membrane(self) -> float:
        """Newton's method under the force at hand; returns by how much the membrane has moved."""
        before, residual = self.u.vec.CreateVector(), self.u.vec.CreateVector()
        before.data = self.u.vec
        for _ in range(NEWTON):
            self.iterations += 1
            self.membrane.Apply(self.u.vec, residual)
            residual.data -= self.force.vec
            self.membrane.AssembleLinearization(self.u.vec)
            step = self.membrane.mat.Inverse(self.on_shell, inverse="sparsecholesky") * residual
            self.u.vec.data -= step
            if np.abs(step.Evaluate().FV().NumPy()).max() < SETTLED:
                break
        before.data -= self.u.vec
        return float(np.abs(before.FV().NumPy()).max())

    @property
    def stretch(self) -> float:
        """Of the mid-surface: root of the mean area ratio."""
        shell = self.mesh.Boundaries("shell")
        area = Integrate(1.0, self.mesh, BND, definedon=shell)
        return float(np.sqrt(Integrate(Norm(self.deformed), self.mesh, BND, definedon=shell) / area))


def main(order: int, size: float, grading: float, steps: int, part: str) -> None:
    """Solve and print."""
    start, wall = time.process_time(), time.perf_counter()
    balloon, turns, moved = Balloon(order, size, grading, part == "octant"), 0, np.inf
    for step in range(1, steps + 1):
        for _ in range(TURNS):
            turns += 1
            balloon.solve_field(step / steps * VOLTAGE)
            moved = balloon.solve_membrane()
            if moved < (MOVED if step == steps else ON_THE_WAY) or not np.isfinite(moved):
                break
    answer = {
        "stretch": balloon.stretch,
        "unknowns": balloon.potential.ndof + balloon.moved.ndof,
        "turns": turns,
        "iterations": balloon.iterations,
        "converged": bool(moved < MOVED),
        "cpu": time.process_time() - start,
        "wall": time.perf_counter() - wall,
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4]), sys.argv[5])
