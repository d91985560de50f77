"""Threads, and what must not be shared among them: the same scene with as many threads gives the same bytes.

Assembly, products and smoothing come out the same with any order of the threads' work, and are ``shared``. NGSolve's
sparse Cholesky does not: it adds up in the order in which its parts happen to be done, in the factorisation and in each
solve; nor do integrals, energies and the colouring of elements. All that is done by one thread.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from typing import Any

from ngsolve import BaseMatrix, SetNumThreads, TaskManager

_count = 1
_manager: Any = None
"""The one at work, where work is shared."""


@contextmanager
def parallel(count: int) -> Iterator[None]:
    """Within, ``count`` threads share what can be shared."""
    global _count
    before, _count = _count, count
    SetNumThreads(1)
    with TaskManager() if count == 1 else nullcontext():
        try:
            yield
        finally:
            _count = before


@contextmanager
def shared() -> Iterator[None]:
    """Within, all threads work."""
    global _manager
    if _count == 1 or _manager is not None:
        yield
        return
    SetNumThreads(_count)
    _manager = TaskManager()
    try:
        with _manager:
            yield
    finally:
        _manager = None
        SetNumThreads(1)


@contextmanager
def alone() -> Iterator[None]:
    """Within, one thread works, though others share what is around it."""
    global _manager
    if _manager is None:
        yield
        return
    manager, _manager = _manager, None
    manager.__exit__(None, None, None)
    SetNumThreads(1)
    try:
        yield
    finally:
        SetNumThreads(_count)
        manager.__enter__()
        _manager = manager


def factored(matrix: Any, free: Any, method: str = "sparsecholesky") -> Any:
    """The inverse of a sparse ``matrix`` on its ``free`` unknowns (bits), by a direct method.

    Raises:
        Exception: NGSolve's own untyped ones, for matrices that are singular.
    """
    with alone():
        inverse = matrix.Inverse(free, inverse=method)
    return inverse if _count == 1 else _Alone(inverse)


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
