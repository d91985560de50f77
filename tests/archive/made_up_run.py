"""Solves that only pretend: real meshes and coefficient functions with known fields, told to a listener
step by step.

A sphere of radius 1 in a ball of radius 3 (3D: the octant between the mirror planes x, y, z; axisymmetric:
the half disc), a circle in a disc (plane strain), and a bare shell without ambient. The shell stretches
along z as the load grows; outside is a uniform field with a dipole, inside a uniform field, as around a
permeable sphere.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
from netgen.occ import Box, Glue, OCCGeometry, Pnt, Rectangle, WorkPlane
from netgen.occ import Sphere as SphereSolid
from ngsolve import CF, H1, GridFunction, IfPos, Mesh, specialcf, sqrt, x, y, z

from embedding.plan import Decision
from embedding.scene import Scales, Scene
from embedding.solving.events import Field, Iteration, Listener, StepRecord

RADIUS, FAR, LENGTH, VOLTAGE = 1.0, 3.0, 0.02, 6e3


@dataclass(frozen=True)
class Estimate:
    """The face of an error estimate."""

    value: float = 2e-4
    quantity: str = "stretch"
    method: str = "one order lower"
    parts: dict[str, float] = field(default_factory=lambda: {"mesh": 2e-4})


@dataclass(frozen=True)
class Cost:
    """The face of a cost."""

    wall_seconds: float = 75.0
    cpu_seconds: float = 70.0
    peak_memory_bytes: int = 310_000_000
    unknowns: dict[str, int] = field(default_factory=lambda: {"displacement": 120, "potential": 1000})
    parts: dict[str, float] = field(default_factory=lambda: {"assembly": 50.0})


def scene(reduction: str = "axisymmetric", order: int = 2) -> Scene:
    """A charged balloon, or a charged cylinder in a grounded one."""
    shape = '{ kind = "sphere", radius = 0.02 }'
    outer = ""
    if reduction == "plane-strain":
        shape, outer = '{ kind = "infinite-cylinder", radius = 0.02 }', 'outer = "grounded"'
    return Scene.from_toml(
        f"""
name = "made-up"
[shell]
thickness = 2e-4
shape = {shape}
material = {{ law = "neo-hookean", shear_modulus = 1e5 }}
[ambient]
field = "electric"
radius = 0.06
{outer}
[faces]
top = {{ voltage = 6000.0 }}
bottom = {{ voltage = 6000.0 }}
[discretisation]
order = {order}
"""
    )


def half_disc(size: float, order: int) -> Mesh:
    """Meridian half plane of the sphere in the ball, coordinates r, z."""
    right = Rectangle(FAR, 2 * FAR).Face().Move((0, -FAR, 0))
    return _disc(size, order, right)


def disc(size: float, order: int) -> Mesh:
    """Cross-section of a cylinder in a cylinder."""
    return _disc(size, order, None)


def _disc(size: float, order: int, part: Any) -> Mesh:
    inner, whole = (WorkPlane().Circle(0, 0, radius).Face() for radius in (RADIUS, FAR))
    if part is not None:
        inner, whole = inner * part, whole * part
    air = whole - inner
    inner.faces.name, air.faces.name = "inside", "outside"
    glued = Glue([air, inner])
    for edge in glued.edges:
        points = [edge.start, edge.end]
        reach = max(math.hypot(point.x, point.y) for point in points)
        straight = all(abs(point.x) < 1e-9 for point in points) and part is not None
        edge.name = "axis" if straight else ("shell" if reach < 2 else "outer")
    return Mesh(OCCGeometry(glued, dim=2).GenerateMesh(maxh=size)).Curve(order)


def octant(size: float, order: int) -> Mesh:
    """One eighth of the sphere in the ball."""
    box = Box(Pnt(0, 0, 0), Pnt(2 * FAR, 2 * FAR, 2 * FAR))
    ball = SphereSolid(Pnt(0, 0, 0), RADIUS) * box
    air = SphereSolid(Pnt(0, 0, 0), FAR) * box - ball
    ball.mat("inside")
    air.mat("outside")
    for face in [*ball.faces, *air.faces]:
        low, high = face.bounding_box
        flat = min(high.x - low.x, high.y - low.y, high.z - low.z) < 1e-6
        face.name = "plane" if flat else ("shell" if max(high.x, high.y, high.z) < 2 else "outer")
    return Mesh(OCCGeometry(Glue([air, ball])).GenerateMesh(maxh=size)).Curve(order)


class Problem:
    """The face of a problem: a mesh with its blocks, scene, plan, scales and embedding."""

    def __init__(self, reduction: str = "axisymmetric", size: float = 0.7, order: int = 2) -> None:
        make: dict[str, Callable[[float, int], Mesh]] = {
            "axisymmetric": half_disc, "plane-strain": disc, "3d": octant,
        }
        self.mesh = make[reduction](size, order)
        self.scene = scene(reduction, order)
        self.scales = Scales.of(self.scene)
        planes = ("x", "y", "z") if reduction == "3d" else ()
        self.reduction = SimpleNamespace(name=reduction, planes=planes)
        decision = Decision("reduction", reduction, "the test wants it")
        self.plan = SimpleNamespace(
            decisions=(decision,), text=lambda: f"reduction: {reduction}", odd_planes=planes[2:]
        )
        regions = {"shell": self.mesh.Boundaries("shell")}
        regions |= {side: self.mesh.Materials(side) for side in ("outside", "inside")}
        self.blocks = {
            name: SimpleNamespace(name=name, region=region, codim=int(name == "shell"), within=nullcontext)
            for name, region in regions.items()
        }

    def embed(self, points: Any) -> Any:
        """Points of the mesh in space, in metre."""
        return LENGTH * self.embed_vector(points)

    def embed_vector(self, values: Any) -> Any:
        """Vectors of the mesh's dimension in space."""
        if values.shape[1] == 3:
            return values
        out = np.zeros((len(values), 3))
        out[:, 0], out[:, 2 if self.reduction.name == "axisymmetric" else 1] = values.T
        return out


class State:
    """The face of a state at load ``factor``."""

    def __init__(self, problem: Problem, factor: float) -> None:
        self.problem, self.factor = problem, factor
        self.space = H1(problem.mesh, order=2)
        self.potential = GridFunction(self.space)
        self.potential.Set(factor * x)

    def fields(self) -> list[Field]:
        """Fields of all blocks."""
        mesh, t = self.problem.mesh, self.factor
        flat = mesh.dim == 2
        radius = sqrt(x * x + y * y) if flat else sqrt(x * x + y * y + z * z)
        axial = y if flat else z
        safe = IfPos(radius - 0.5, radius, 1.0)
        fade = IfPos(radius - RADIUS, safe ** (-3), 1.0)
        long, wide = 0.35 * t * fade, -0.15 * t * fade
        motion = CF((wide * x, long * y)) if flat else CF((wide * x, wide * y, long * z))
        near, far = 1.8 * VOLTAGE * t, VOLTAGE * t
        along = CF((0, 1)) if flat else CF((0, 0, 1))
        towards = CF((x, y)) if flat else CF((x, y, z))
        dipole = (3 * axial * towards / safe**2 - along) * safe ** (-3)
        tilt = axial / RADIUS
        out = [
            Field("shell", "u", "m", LENGTH * motion),
            Field("shell", "p_t", "Pa", CF(40.0 * t)),
            Field("shell", "p_b", "Pa", 40.0 * t + 300.0 * t * tilt**2),
            Field("shell", "stretch", "1", (x + wide * x) / x + 0.4 * t * (1 - tilt**2)),
            Field("shell", "thickness_stretch", "1", CF(1 / (1 + t))),
            Field("shell", "normal", "1", specialcf.normal(mesh.dim)),
        ]
        outside = (far / LENGTH) * (along + 0.7 * dipole)
        inside = (0.4 * near / LENGTH) * along
        for block, strength in (("outside", outside), ("inside", inside)):
            out += [
                Field(block, "u", "m", LENGTH * motion),
                Field(block, "phi", "V", -far * axial),
                Field(block, "E", "V/m", strength),
            ]
        return [one for one in out if one.block in self.problem.blocks]

    def memory(self) -> dict[str, Any]:
        """What a run goes on from."""
        return {"phi": self.potential.vec.FV().NumPy().copy(), "mean": np.array([self.factor])}


def record(number: int, of: int) -> StepRecord:
    """An accepted step with as many iterations as its number, but at least two."""
    t = number / of
    iterations = tuple(
        Iteration(k, 10.0**-k, 10.0 ** (-2 * k), 40.0 * t + k, 140.0 * t + k)
        for k in range(1, max(3, number + 1))
    )
    scalars = {
        "stretch": 1 + 0.2 * t,
        "stretch_max": 1 + 0.3 * t,
        "pressure_top": 40.0 * t,
        "pressure_bottom": 140.0 * t,
        "pressure_difference": 100.0 * t,
        "voltage": VOLTAGE * t,
        "charge": 1e-8 * t,
    }
    return StepRecord(number, "lade auf", t, t, iterations, scalars, 0.25)


def solution(steps: Sequence[StepRecord], result: str = "CONVERGED") -> Any:
    """The face of a Solution."""
    return SimpleNamespace(
        result=SimpleNamespace(name=result, advice="nothing to do"),
        message="the whole path is solved",
        steps=tuple(steps),
        assumptions=(),
        errors={},
        health=(),
        attempts=(),
        error=Estimate(),
        cost=Cost(),
        critical_points=(),
        start="rest",
        archive=None,
    )


def tell(listener: Listener, problem: Any, steps: int = 3, result: str = "CONVERGED") -> list[StepRecord]:
    """Tell ``listener`` the story of a solve of so many steps, with one cut in between."""
    listener.started(problem)
    records = [record(number, max(steps, 1)) for number in range(1, steps + 1)]
    for one in records:
        if one.number == 2:
            listener.cut(2, 0.5, "update too large")
        listener.accepted(State(problem, one.factor_field), one)  # type: ignore[arg-type]
    listener.finished(solution(records, result))
    return records
