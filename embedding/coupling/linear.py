"""The direct solver behind every Newton step: fast first, checked always, pivoting where it must.

``sparsecholesky`` (LDL^T without pivoting) solves the symmetric indefinite systems of the opened interface in a
fraction of the time of ``umfpack``, but nothing guarantees its pivots. So the residual of every solve is measured, and
a solve that is not accurate is repeated with pivoting.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

from embedding.errors import EmbeddingError
from embedding.geometry.spaces import as_mask

ACCURATE = 1e-8
REFINE = 1e-11


@contextlib.contextmanager
def silent_stdout() -> Iterator[None]:
    """Keep the C libraries' own words about singular matrices off standard output; errors are reported as errors."""
    try:
        kept = os.dup(1)
    except OSError:  # a process without standard output has nothing to keep clean
        yield
        return
    if sys.stdout is not None:
        sys.stdout.flush()
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


class LinearSolverError(EmbeddingError):
    """The linear system could not be solved: singular, or not finite."""


class DirectSolver:
    """Solves for the free unknowns of one system again and again."""

    def __init__(self, free: Any, *, symmetric: bool) -> None:
        self.free = free
        self.mask = as_mask(free)
        self._methods = ["sparsecholesky", "umfpack"] if symmetric else ["umfpack"]

    def solve(self, matrix: Any, right_side: Any) -> Any:
        """The update vector, zero on the unknowns that are not free.

        Raises:
            LinearSolverError: no solver reached a relative residual of 1e-8.
        """
        update = right_side.CreateVector()
        update[:] = 0.0
        scale = float(np.linalg.norm(right_side.FV().NumPy()[self.mask]))
        if scale == 0.0:
            return update
        worst = "no solver ran"
        for method in self._methods:
            # Only umfpack has words of its own about a singular matrix.
            with silent_stdout() if method == "umfpack" else contextlib.nullcontext():
                try:
                    inverse = matrix.Inverse(self.free, inverse=method)
                except Exception as error:  # NGSolve raises its own untyped exceptions for singular matrices
                    worst = f"{method}: {error}"
                    continue
            remainder = self._refined(matrix, inverse, right_side, update) / scale
            if np.isfinite(remainder) and remainder < ACCURATE:
                return update
            worst = f"{method}: relative residual {remainder:.1e}"
        raise LinearSolverError(f"the linear system could not be solved ({worst})")

    def _refined(self, matrix: Any, inverse: Any, right_side: Any, update: Any) -> float:
        """Solve, with one step of iterative refinement if the residual asks for it; returns the residual's norm."""
        residual = right_side.CreateVector()
        update.data = inverse * right_side
        norm = float("inf")
        for attempt in range(2):
            residual.data = right_side - matrix * update
            norm = float(np.linalg.norm(residual.FV().NumPy()[self.mask]))
            if attempt or norm < REFINE * float(np.linalg.norm(right_side.FV().NumPy()[self.mask])):
                break
            update.data += inverse * residual
        return norm
