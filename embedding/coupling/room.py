"""A form whose matrix has room for entries that others assemble."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ngsolve import ET, BilinearForm, BitArray, IntegrationRule, Mesh, dx


class RoomyForm:
    """A ``form`` on some elements of a ``mesh`` whose matrix has the pattern of all of them.

    NGSolve finds the pattern from the elements that have an integral, once. So there is one of nothing at first, over
    the products of ``pairs`` of trial and test functions, and after the first assembly it has no elements any more.
    """

    def __init__(self, form: BilinearForm, mesh: Mesh, pairs: Iterable[tuple[Any, Any]]) -> None:
        self._form, self._elements = form, BitArray([True] * mesh.ne)
        rules = {element: IntegrationRule(element, 0) for element in (ET.TET, ET.TRIG)}
        nothing = sum(0.0 * trial * test for trial, test in pairs)
        form += (nothing * dx(definedonelements=self._elements, intrules=rules)).Compile()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._form, name)

    def AssembleLinearization(self, vector: Any) -> None:
        """Linearise at ``vector``."""
        self._form.AssembleLinearization(vector)
        self._elements.Clear()
