"""Threads, and what must not be shared among them: the same scene with as many threads gives the same bytes.

Assembly and products come out the same with any order of the threads' work. NGSolve's sparse Cholesky does not: it adds
up in the order in which its parts happen to be done, in the factorisation and in each solve; nor do integrals, energies
and the colouring of elements. These are done by one thread here.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ngsolve import BaseMatrix, SetNumThreads, TaskManager

_asked, _count = 1, 1
_manager: Any = None


@contextmanager
def parallel(count: int) -> Iterator[None]:
    """Within, NGSolve works with ``count`` threads."""
    global _asked, _count, _manager
    before = _asked, _count, _manager
    SetNumThreads(count)
    manager = TaskManager()
    with manager:
        _asked, _count, _manager = count, count, manager
        try:
            yield
        finally:
            _asked, _count, _manager = before


@contextmanager
def alone() -> Iterator[None]:
    """Within, one thread does all."""
    global _count
    if _count == 1:
        yield
        return
    count, _count = _count, 1
    _manager.__exit__(None, None, None)
    SetNumThreads(1)
    try:
        yield
    finally:
        SetNumThreads(count)
        _manager.__enter__()
        _count = count


def factored(matrix: Any, free: Any, method: str = "sparsecholesky") -> Any:
    """The inverse of a sparse ``matrix`` on its ``free`` unknowns (bits), by a direct method.

    Raises:
        Exception: NGSolve's own untyped ones, for matrices that are singular.
    """
    with alone():
        inverse = matrix.Inverse(free, inverse=method)
    return inverse if _asked == 1 else _Alone(inverse)


def energy_of(form: Any, vector: Any) -> float:
    """The energy of a variational ``form`` at ``vector``."""
    with alone():
        return float(form.Energy(vector))


class _Alone(BaseMatrix):  # type: ignore[misc]
    """An ``inverse`` that is applied by one thread."""

    def __init__(self, inverse: Any) -> None:
        super().__init__()
        self._inverse = inverse

    def Height(self) -> int:
        return int(self._inverse.height)

    def Width(self) -> int:
        return int(self._inverse.width)

    def Shape(self) -> tuple[int, int]:
        return self.Height(), self.Width()

    def IsComplex(self) -> bool:
        return False

    def CreateVector(self, colvector: bool = True) -> Any:
        return self._inverse.CreateColVector() if colvector else self._inverse.CreateRowVector()

    def Mult(self, vector: Any, out: Any) -> None:
        with alone():
            out.data = self._inverse * vector

    def MultAdd(self, factor: float, vector: Any, out: Any) -> None:
        with alone():
            out.data += factor * self._inverse * vector
