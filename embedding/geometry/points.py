"""Functions on a curve that are known at the points of an integration rule alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, ElementId, GridFunction, SurfaceL2

from embedding.geometry.domain import Domain

Array = npt.NDArray[np.float64]


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
