"""The inverse of the ambient's own stiffness, applied to vectors: a factorisation, or conjugate gradients where the
ambient is large."""

from __future__ import annotations

from typing import Any, Literal

from ngsolve import BaseMatrix

from embedding.ambient.krylov import conjugate_gradients
from embedding.ambient.patches import Cycle, VertexPatches
from embedding.geometry.spaces import as_mask

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

    def __init__(self, space: Any, free: Any, linear: Linear = "auto") -> None:
        self._free = free
        large = iterates(linear, int(free.NumSet()), space.mesh.dim)
        self._patches = VertexPatches(space, as_mask(free)) if large else None

    def __call__(self, matrix: Any) -> Any:
        """The inverse of ``matrix``, zero on the unknowns that are not free."""
        if self._patches is None:
            return matrix.Inverse(self._free, inverse="sparsecholesky")
        return _Iteration(self._patches.cycle(matrix))


class _Iteration(BaseMatrix):  # type: ignore[misc]
    """Conjugate gradients as an operator.

    What does not converge in ``MOST_ITERATIONS`` is returned as it is: the ambient's motion judges its steps itself.
    """

    def __init__(self, cycle: Cycle) -> None:
        super().__init__()
        self._cycle = cycle

    def Height(self) -> int:
        return int(self._cycle.matrix.height)

    def Width(self) -> int:
        return int(self._cycle.matrix.width)

    def Shape(self) -> tuple[int, int]:
        return self.Height(), self.Width()

    def IsComplex(self) -> bool:
        return False

    def CreateVector(self, _colvector: bool = True) -> Any:
        return self._cycle.matrix.CreateColVector()

    def Mult(self, vector: Any, out: Any) -> None:
        conjugate_gradients(self._cycle, vector, out, TOLERANCE, MOST_ITERATIONS)

    def MultAdd(self, factor: float, vector: Any, out: Any) -> None:
        update = out.CreateVector()
        self.Mult(vector, update)
        out.data += factor * update
