"""Stability of an equilibrium: how many independent small motions would lower the potential energy.

By Sylvester's law the factors L D L^T of the tangent have as many negative pivots as it has negative eigenvalues. The
pivots are those of the tangent whose bending moments are eliminated, so they count displacements and turns. Multipliers
(of rigid motions, of an enclosed volume) bring one negative eigenvalue each, which does not count: what is left is the
number of unstable modes among the motions they allow (Haynsworth, Linear Algebra Appl. 1 (1968) 73).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import qdldl
import scipy.sparse as sparse

from embedding.coupling.system import System
from embedding.geometry.spaces import Mask

SHIFT = 1e-13
"""Stiffness of free rigid motions, whose pivots would otherwise be rounding, relative to the largest one."""


SMALL = 1000
"""Rows of a matrix whose eigenvalues may be computed."""


def countable(system: System) -> bool:
    """Is stability a matter of energy (loads with a potential), and that of the shell alone (no field, whose energy has
    the other sign)?"""
    return system.symmetric and system.physics.field is None


def unstable_modes(system: System) -> int | None:
    """Number of unstable modes at the last linearisation of ``system``.

    None where it cannot be counted, or a pivot cannot be told from rounding.
    """
    if not countable(system):
        return None
    matrix, multipliers = system.tangent()
    shift = SHIFT if system.unknowns.rigid else 0.0
    return negative_eigenvalues(matrix, multipliers, shift=shift, less=system.saddle_count)


def negative_eigenvalues(
    matrix: sparse.csc_array, border: Mask, *, shift: float = 0.0, less: int = 0
) -> int | None:
    """Negative eigenvalues of the symmetric ``matrix`` (n, n), ``less`` of which are not counted.

    Rows in ``border``, few and dense, are eliminated last. A pivot that vanishes is no eigenvalue that does: then those
    of a small matrix are computed, and for a large one the answer is None.
    """
    inner, outer = np.flatnonzero(~border), np.flatnonzero(border)
    core = sparse.csc_array(matrix[inner][:, inner])
    if shift:
        core = core + shift * float(np.abs(core.diagonal()).max(initial=0.0)) * sparse.eye_array(len(inner))
    factors = _factors(core)
    if factors is None:
        return int((np.linalg.eigvalsh(matrix.toarray()) < 0).sum()) - less if matrix.shape[0] <= SMALL else None
    count = int((np.asarray(factors.factors()[1]) < 0).sum())
    if len(outer):
        sides = matrix[inner][:, outer].toarray()
        solved = np.column_stack([factors.solve(side) for side in sides.T])
        rest = matrix[outer][:, outer].toarray() - sides.T @ solved
        count += int((np.linalg.eigvalsh((rest + rest.T) / 2) < 0).sum())
    return count - less


def _factors(core: sparse.csc_array) -> Any:
    """The factors L D L^T of ``core``, or None."""
    try:
        factors = qdldl.Solver(sparse.csc_matrix(sparse.triu(core)), upper=True)
    except RuntimeError:
        return None
    return factors if np.all(np.isfinite(factors.factors()[1])) else None
