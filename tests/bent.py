"""Shells that bend, made and solved from tables, and where their points go."""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding import Scene, explain
from embedding.scene.path import Until
from embedding.solving.driver import Run
from embedding.solving.places import displacement_row
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from tests.forms import Array

Table = dict[str, Any]
ONE_STEP = ({"control": "load", "steps": 1},)
FOLLOWED: tuple[Table, ...] = ({},)
RUBBER: Table = {"law": "neo-hookean", "shear_modulus": 1.0}
DISC: Table = {"kind": "disc", "radius": 1.0}


def metal(poisson_ratio: float = 0.0, youngs_modulus: float = 1.0) -> Table:
    """A material of small strains."""
    return {"law": "st-venant-kirchhoff", "youngs_modulus": youngs_modulus, "poisson_ratio": poisson_ratio}


def young(material: Table) -> tuple[float, float]:
    """E and nu of small strains, of ``metal`` or of a neo-Hookean rubber."""
    if "poisson_ratio" in material:
        return material["youngs_modulus"], material["poisson_ratio"]
    return 3 * material["shear_modulus"], 0.5


def rigidity(material: Table, thickness: float) -> float:
    """D = E T^3 / (12 (1 - nu^2)) per width."""
    E, nu = young(material)
    return float(E * thickness**3 / (12 * (1 - nu**2)))


def clamped(*edges: str, kind: str = "clamped") -> list[Table]:
    """Supports of one kind on edges."""
    return [{"where": edge, "kind": kind} for edge in edges]


def mesh(order: int, size: float, **more: Any) -> Table:
    """A discretisation."""
    return {"order": order, "shell_size": size, **more}


def scene_of(shape: Table, thickness: Any, material: Table = RUBBER, **parts: Any) -> Scene:
    """A scene of a shell that bends; loaded in one step unless ``parts`` say otherwise."""
    shell = {"shape": shape, "thickness": thickness, "material": material} | parts.pop("shell", {})
    model = {"theory": "bending"} | parts.pop("model", {})
    return Scene(shell=shell, model=model, **({"path": ONE_STEP} | parts))


def problem_of(shape: Table, thickness: Any, material: Table = RUBBER, **parts: Any) -> Problem:
    """The same, meshed and not yet solved."""
    scene = scene_of(shape, thickness, material, **parts)
    return Problem(scene, explain(scene))


class Bent(Run):
    """A solved ``scene_of``, without the estimate of its error, which costs more than the solve."""

    def __init__(self, shape: Table, thickness: Any, material: Table = RUBBER, **parts: Any) -> None:
        super().__init__(scene_of(shape, thickness, material, **parts), ())
        self.outcome = Result.CONVERGED
        for number in range(len(self.scene.path)):
            self.outcome = self._stage(number)
            if not self.outcome.ok:
                break

    def converged(self) -> Bent:
        """Itself, if it is solved to the end."""
        assert self.outcome.ok, self.told(self.outcome)
        return self

    @property
    def scalars(self) -> dict[str, float]:
        """Of the last step."""
        return self.converged().steps[-1].scalars

    def moved(self, *where: float) -> Array:
        """Displacement (3,) in m of the point ``where`` of the mid-surface; x is its radial part in axisymmetry."""
        self.converged()
        hidden = {"axisymmetric": "y", "plane-strain": "z"}.get(self.problem.reduction.name)
        return np.array([0.0 if axis == hidden else self._moved(where, axis) for axis in "xyz"])

    def _moved(self, where: tuple[float, ...], axis: str) -> float:
        until = Until.model_validate({"where": where, "axis": axis, "value": 0.0})
        row = displacement_row(self.problem, until, 0)
        u = self.problem.system.unknowns.field("u").vec.FV().NumPy()
        return float(row @ u) * self.problem.scales.length
