"""The inverse of the ambient's own stiffness, applied to vectors: a factorisation, or conjugate gradients where the
ambient is large."""

from __future__ import annotations

import math
from typing import Any, Literal

from ngsolve import BaseMatrix, InnerProduct

from embedding.ambient.krylov import conjugate_gradients
from embedding.ambient.patches import Cycle, VertexPatches
from embedding.geometry.spaces import as_mask
from embedding.threads import factored

Linear = Literal["auto", "direct", "iterative"]
LARGE = {2: 1_000_000, 3: 25_000}
"""Free unknowns from where on "auto" iterates, by dimension, from the measurements on the docs page "Large ambients":
in 3D where motion, potential and joint step together take as long either way, in 2D beyond all that was measured."""
TOLERANCE, MOST_ITERATIONS = 1e-10, 200


def iterates(linear: Linear, unknowns: int, dimension: int) -> bool:
    """Is a definite system with so many free ``unknowns`` on a mesh of the ``dimension`` solved by iteration?"""
    return linear == "iterative" or (linear == "auto" and unknowns > LARGE[dimension])


class Inverter:
    """Makes inverses on the ``free`` unknowns (bits) of a ``space`` for definite matrices, one after the other."""

    def __init__(self, space: Any, free: Any, linear: Linear = "auto", tolerance: float = TOLERANCE) -> None:
        self._free, self._tolerance = free, tolerance
        large = iterates(linear, int(free.NumSet()), space.mesh.dim)
        self._patches = VertexPatches(space, as_mask(free)) if large else None

    def __call__(self, matrix: Any) -> Any:
        """The inverse of ``matrix``, zero on the unknowns that are not free."""
        if self._patches is None:
            return factored(matrix, self._free)
        return _Iteration(self._patches.cycle(matrix), self._tolerance)


def norm(inverse: Any, residual: Any) -> float:
    """The size of a ``residual``, the root of r . K^-1 r, from an ``inverse`` of K; where that iterates, from its
    preconditioner."""
    step = residual.CreateVector()
    if isinstance(inverse, _Iteration):
        free_part = residual.CreateVector()
        free_part.data = inverse.cycle.free * residual
        inverse.cycle.apply(free_part, step)
        return math.sqrt(abs(InnerProduct(step, free_part)))
    step.data = inverse * residual
    return math.sqrt(abs(InnerProduct(step, residual)))


class _Iteration(BaseMatrix):  # type: ignore[misc]
    """Conjugate gradients as an operator.

    What does not converge in ``MOST_ITERATIONS`` is returned as it is: the ambient's motion judges its steps itself.
    """

    def __init__(self, cycle: Cycle, tolerance: float) -> None:
        super().__init__()
        self.cycle, self._tolerance = cycle, tolerance

    def Height(self) -> int:
        return int(self.cycle.matrix.height)

    def Width(self) -> int:
        return int(self.cycle.matrix.width)

    def Shape(self) -> tuple[int, int]:
        return self.Height(), self.Width()

    def IsComplex(self) -> bool:
        return False

    def CreateVector(self, _colvector: bool = True) -> Any:
        return self.cycle.matrix.CreateColVector()

    def Mult(self, vector: Any, out: Any) -> None:
        conjugate_gradients(self.cycle, vector, out, self._tolerance, MOST_ITERATIONS)

    def MultAdd(self, factor: float, vector: Any, out: Any) -> None:
        update = out.CreateVector()
        self.Mult(vector, update)
        out.data += factor * update
