"""The direct solver behind every Newton step: fast first, checked always, pivoting where it must.

``sparsecholesky`` (LDL^T without pivoting) solves the symmetric indefinite systems of the opened interface in a
fraction of the time of ``umfpack``, but nothing guarantees its pivots. So the residual of every solve is measured, and
a solve that is not accurate is repeated with pivoting.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from embedding.errors import EmbeddingError

ACCURATE = 1e-8


class LinearSolverError(EmbeddingError):
    """The linear system could not be solved: singular, or not finite."""


def solve_linear(matrix: Any, right_side: Any, free: Any, *, symmetric: bool) -> Any:
    """Solve for the ``free`` unknowns and return the update vector.

    Raises:
        LinearSolverError: no solver reached a relative residual of 1e-8.
    """
    methods = ["sparsecholesky", "umfpack"] if symmetric else ["umfpack"]
    residual, update = right_side.CreateVector(), right_side.CreateVector()
    mask = np.fromiter((free[i] for i in range(len(free))), bool, len(free))
    scale = float(np.linalg.norm(right_side.FV().NumPy()[mask]))
    if scale == 0.0:
        update[:] = 0.0
        return update
    worst = "no solver ran"
    for method in methods:
        try:
            inverse = matrix.Inverse(free, inverse=method)
            update.data = inverse * right_side
            residual.data = right_side - matrix * update
            update.data += inverse * residual
            residual.data = right_side - matrix * update
        except Exception as error:  # NGSolve raises its own untyped exceptions for singular matrices
            worst = f"{method}: {error}"
            continue
        error_norm = float(np.linalg.norm(residual.FV().NumPy()[mask])) / scale
        if np.isfinite(error_norm) and error_norm < ACCURATE:
            return update
        worst = f"{method}: relative residual {error_norm:.1e}"
    raise LinearSolverError(f"the linear system could not be solved ({worst})")
