"""How the scene is modelled, discretised and solved. Every "auto" and None is decided by the plan."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal, NoReturn

from pydantic import AfterValidator, BeforeValidator

from embedding.scene.messages import refusal
from embedding.scene.part import Part
from embedding.scene.units import Length, Number


class Model(Part):
    """Choices of the model: ``theory`` is that of the shell, ``symmetry`` uses mirror planes in 3d, ``interface`` the
    faces' true places, ``coupling`` how much field and shell know of each other.

    ``far_field`` is how open space ends: in a mapped region that reaches to infinity, or in a Robin condition.
    ``surroundings`` "none" leaves only the field inside the shell, between its electrodes.
    """

    theory: Literal["auto", "membrane", "bending"] = "auto"
    reduction: Literal["auto", "3d", "axisymmetric", "plane-strain"] = "auto"
    symmetry: Literal["auto", "none"] = "auto"
    interface: Literal["auto", "opened", "closed"] = "auto"
    far_field: Literal["auto", "infinite", "robin"] = "auto"
    surroundings: Literal["auto", "meshed", "none"] = "auto"
    coupling: Literal["auto", "joint", "staggered", "once", "unperturbed"] = "auto"


class Fixed(dict[str, Any]):
    """A table of numbers or vectors that cannot be changed, and so can stand in a scene."""

    def __hash__(self) -> int:  # type: ignore[override]
        return hash(frozenset(self.items()))

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("a scene cannot be changed")

    __setitem__ = __delitem__ = update = setdefault = pop = popitem = clear = __ior__ = _refuse


def _table(value: Any) -> Any:
    if not isinstance(value, Mapping) or not all(isinstance(edge, str) for edge in value):
        raise refusal('must be a table of edges and sizes, such as { rim = "0.2 mm" }')
    return value


class Discretisation(Part):
    """Polynomial order, cure of membrane locking under bending, mesh sizes in m on the shell and far away, and how fast
    sizes may change.

    ``edge_size`` holds smaller sizes along edges of the shape, by their names; ``sharp`` stands for all edges of a file
    at which faces meet at more than 30 degrees.
    """

    order: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=4))] = 3
    locking: Literal["auto", "cured", "as it is"] = "auto"
    shell_size: Length | None = None
    edge_size: Annotated[dict[str, Length], BeforeValidator(_table), AfterValidator(Fixed)] = Fixed()
    ambient_size: Length | None = None
    grading: Annotated[float, BeforeValidator(Number(at_least=0.05, at_most=1.0))] = 0.3


class Solver(Part):
    """Newton's method: tolerance, iterations per step, smallest fraction of a planned step, threads.

    ``acceleration`` is that of field and shell solved in turn (model.coupling = "staggered"), ``linear`` how the space
    around the shell is solved: its matrix factored, or by iteration ("auto": where it is large).

    A stage that follows a path is given up after ``max_steps`` steps, or when it has gone ``max_arc`` times the size of
    the shape (root-mean-square displacement, added up).
    """

    tolerance: Annotated[float, BeforeValidator(Number(at_least=1e-13, at_most=1e-3))] = 1e-9
    max_iterations: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=10_000))] = 25
    min_step: Annotated[float, BeforeValidator(Number(above=0.0, at_most=1.0))] = 1e-4
    max_steps: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=100_000))] = 500
    max_arc: Annotated[float, BeforeValidator(Number(above=0.0, at_most=1e6))] = 10.0
    acceleration: Literal["iqn-ils", "aitken", "none"] = "iqn-ils"
    linear: Literal["auto", "direct", "iterative"] = "auto"
    threads: Annotated[int, BeforeValidator(Number(whole=True, at_least=1, at_most=1024))] = 1
