"""How the scene is modelled, discretised and solved. Every "auto" and None is decided by the plan."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator

from embedding.scene.part import Part
from embedding.scene.units import Length, Number


class Model(Part):
    """Choices of the model: ``symmetry`` uses mirror planes in 3d, ``interface`` the faces' true places."""

    reduction: Literal["auto", "3d", "axisymmetric", "plane-strain"] = "auto"
    symmetry: Literal["auto", "none"] = "auto"
    interface: Literal["auto", "opened", "closed"] = "auto"
    far_field: Literal["auto", "robin"] = "auto"


class Discretisation(Part):
    """Polynomial order, mesh sizes in m on the shell and far away, and how fast sizes may change."""

    order: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=4))] = 3
    shell_size: Length | None = None
    ambient_size: Length | None = None
    grading: Annotated[float, BeforeValidator(Number(at_least=0.05, at_most=1.0))] = 0.3


class Solver(Part):
    """Newton's method: tolerance, iterations per step, smallest fraction of a planned step, threads."""

    tolerance: Annotated[float, BeforeValidator(Number(at_least=1e-13, at_most=1e-3))] = 1e-9
    max_iterations: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=10_000))] = 25
    min_step: Annotated[float, BeforeValidator(Number(above=0.0, at_most=1.0))] = 1e-4
    threads: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=1024))] = 1
