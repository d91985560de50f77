"""Points inside the elements of the shell, and functions on a curve that are known at such points alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, ET, ElementId, GridFunction, IntegrationRule, SurfaceL2

from embedding.geometry.domain import Domain

Array = npt.NDArray[np.float64]


def sampling_rule(dimension: int, order: int, *, to_edges: bool = False) -> Any:
    """An integration rule for the elements of a shell in space (``dimension`` 3) or of a curve (2), whose points are
    where functions of elements of that ``order`` are looked at; ``to_edges`` adds points on edges and corners."""
    rule = IntegrationRule(ET.TRIG if dimension == 3 else ET.SEGM, 2 * order)
    if not to_edges:
        return rule
    along = [0.0, *(x for (x, *_) in IntegrationRule(ET.SEGM, 2 * order).points)]
    more: list[Any] = [(0.0,), (1.0,)]
    if dimension == 3:
        more = [place for x in along for place in ((x, 0.0), (1.0 - x, x), (0.0, 1.0 - x))]
    points = [tuple(point) for point in rule.points]
    return IntegrationRule(points=points + more, weights=[*rule.weights, *([0.0] * len(more))])


class PointFields:
    """Scalar fields on the shell of ``domain``, a curve, that take given values at the points of ``rule``: polynomials
    through them, element by element."""

    def __init__(self, domain: Domain, rule: Any) -> None:
        mesh, numbers = domain.mesh, domain.facets.numbers
        self._points = mesh.MapToAllElements(rule, domain.shell)
        self._shape = (len(numbers), len(rule))
        self._space = SurfaceL2(mesh, order=len(rule) - 1, definedon=domain.shell)
        elements = [ElementId(BND, int(number)) for number in numbers]
        self._unknowns = np.array([list(self._space.GetDofNrs(element)) for element in elements])
        shapes = [
            [np.array(self._space.GetFE(element).CalcShape(*point)).ravel() for point in rule.points]
            for element in elements
        ]
        self._inverse = np.linalg.inv(np.array(shapes))

    def field(self) -> GridFunction:
        """A field that is zero."""
        return GridFunction(self._space)

    def values(self, function: Any) -> Array:
        """A ``function`` with some components at the points, shape (components, elements, points)."""
        found = np.asarray(CF(function)(self._points))
        return np.ascontiguousarray(found.reshape(*self._shape, -1).transpose(2, 0, 1))

    def put(self, field: GridFunction, values: Array) -> None:
        """Let a ``field`` take ``values`` (elements, points)."""
        field.vec.FV().NumPy()[self._unknowns] = np.einsum("eij,ej->ei", self._inverse, values)
