"""What the worked problems share: the law of a scene, where the shell is and its points go, printed comparisons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt
from ngsolve import ET, IntegrationRule
from scipy.interpolate import CubicSpline

from embedding import Gent, Listener, MooneyRivlin, NeoHookean, Ogden, Scene, Solution, Yeoh, solve
from embedding.scene.path import Until
from embedding.solving.events import StepRecord
from embedding.solving.places import displacement_row
from embedding.solving.problem import Problem
from embedding.solving.state import State
from problems.exact import material as exact

Array = npt.NDArray[np.float64]


def law_of(scene: Scene) -> exact.Law:
    """The incompressible material of ``scene`` as the exact solutions state it, in Pa."""
    material = scene.shell.material
    match material:
        case NeoHookean():
            return exact.neo_hookean(material.shear_modulus)
        case MooneyRivlin():
            return exact.MooneyRivlin(material.c1, material.c2)
        case Yeoh():
            return exact.Yeoh(material.c1, material.c2, material.c3)
        case Gent():
            return exact.Gent(material.shear_modulus, material.limit)
        case Ogden():
            return exact.Ogden(material.moduli, material.exponents)
    raise ValueError(f"{type(material).__name__} is not incompressible")


def thickness_ratio(scene: Scene) -> float:
    """T/R: thickness over the size of the shape."""
    return float(scene.shell.thickest / scene.shell.shape.size)


class Positions(Listener):
    """Where material points of the shell, several in every element, were and are: (n, 3) in m, last accepted step."""

    def __init__(self) -> None:
        self.reference: Array = np.empty((0, 3))
        self.deformed: Array = np.empty((0, 3))

    def accepted(self, state: State, record: StepRecord) -> None:
        problem = state.problem
        rule = IntegrationRule(ET.TRIG if problem.reduction.dimension == 3 else ET.SEGM, 6)
        points = problem.mesh.MapToAllElements(rule, problem.blocks["shell"].region)
        u = next(field.values for field in state.fields() if (field.block, field.name) == ("shell", "u"))
        self.reference = problem.embed(np.asarray(problem.reduction.position(points)))
        self.deformed = self.reference + problem.embed_vector(np.asarray(u(points)))


class Reading(NamedTuple):
    """A displacement to follow: along ``axis``, of the material point ``where`` in m, times ``sign``."""

    where: tuple[float, float, float]
    axis: Literal["x", "y", "z"]
    sign: float = 1.0


class Probe(Listener):
    """Named displacements in m at every accepted step."""

    def __init__(self, readings: Mapping[str, Reading]) -> None:
        self.readings = readings
        self.values: dict[str, list[float]] = {name: [] for name in readings}
        self._rows: dict[str, Array] = {}

    def started(self, problem: Problem) -> None:
        for name, (where, axis, sign) in self.readings.items():
            row = displacement_row(problem, Until(where=where, axis=axis, value=0.0), 0)
            self._rows[name] = sign * problem.scales.length * row

    def accepted(self, state: State, record: StepRecord) -> None:
        u = state.problem.system.unknowns.field("u").vec.FV().NumPy()
        for name, row in self._rows.items():
            self.values[name].append(float(row @ u))


@dataclass(frozen=True)
class LoadPath:
    """A solved path: load factors and named displacements in m of every accepted step."""

    solution: Solution
    factors: Array
    values: Mapping[str, Array]

    def end(self, name: str) -> float:
        """The displacement ``name`` at the end of the path."""
        return float(self.values[name][-1])

    def distances(self, name: str, factors: Sequence[float], values: Sequence[float]) -> Array:
        """How far every step lies from a curve through the given points, in the plane of load factor and displacement.

        The curve is a spline from rest through the points, in their order; both axes are measured in its extent.
        """
        curve, extent = curve_through(factors, values)
        steps = np.column_stack([self.factors, self.values[name]]) / extent
        return np.array([np.linalg.norm(curve / extent - step, axis=1).min() for step in steps])


def curve_through(factors: Sequence[float] | Array, values: Sequence[float] | Array) -> tuple[Array, Array]:
    """Points (n, 2) of the spline from rest through load factors and displacements, and the extent (2,) of those."""
    points = np.array([(0.0, 0.0), *zip(factors, values, strict=True)])
    extent = np.ptp(points, axis=0)
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points / extent, axis=0), axis=1)))
    return CubicSpline(along, points)(np.linspace(0.0, along[-1], 200 * len(points))), extent


def follow(scene: Scene, readings: Mapping[str, Reading], archive: Path | None = None) -> LoadPath:
    """Solve ``scene`` and read displacements on the way."""
    probe = Probe(readings)
    solution = solve(scene, archive=archive, listeners=[probe])
    factors = np.array([step.factor_mechanical for step in solution.steps])
    return LoadPath(solution, factors, {name: np.array(values) for name, values in probe.values.items()})


def print_end(path: LoadPath, known: Mapping[str, float]) -> None:
    """The end of the path against known displacements, and what it cost."""
    for name, value in known.items():
        found, scale = path.end(name), path.solution.scene.shell.shape.size
        print(f"{name}: {found:.6g} m, known {value:.6g} m: {(found - value) / scale:+.1e} of the size")
    print(f"{len(path.solution.steps)} steps, {path.solution.iterations} Newton iterations")


def print_steps(columns: Mapping[str, Array], digits: int = 6) -> None:
    """One line a step, under the names of the columns."""
    print("  ".join(f"{name:>14}" for name in columns))
    for row in zip(*columns.values(), strict=True):
        print("  ".join(f"{value:14.{digits}f}" for value in row))


def print_files(solution: Solution) -> None:
    """Where the archive is, and how to look at it."""
    print(f"archive: {solution.archive}; a picture of it: embedding plot {solution.archive}")
