"""What the worked problems share: the law of a scene, where the shell is, and a printed comparison."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from ngsolve import ET, IntegrationRule

from embedding import Gent, Listener, MooneyRivlin, NeoHookean, Ogden, Scene, Solution, Yeoh
from embedding.solving.events import StepRecord
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


def print_steps(columns: Mapping[str, Array], digits: int = 6) -> None:
    """One line a step, under the names of the columns."""
    print("  ".join(f"{name:>14}" for name in columns))
    for row in zip(*columns.values(), strict=True):
        print("  ".join(f"{value:14.{digits}f}" for value in row))


def print_files(solution: Solution) -> None:
    """Where the archive is, and how to look at it."""
    print(f"archive: {solution.archive}; a picture of it: embedding plot {solution.archive}")
