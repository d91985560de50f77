"""Stability of an equilibrium: how many independent small motions would lower the potential energy.

By Sylvester's law the factors L D L^T of the tangent have as many negative pivots as it has negative eigenvalues. The
pivots are those of the tangent whose bending moments are eliminated, so they count displacements and turns. Multipliers
(of rigid motions, of an enclosed volume) bring one negative eigenvalue each, which does not count: what is left is the
number of unstable modes among the motions they allow (Haynsworth, Linear Algebra Appl. 1 (1968) 73).
"""

from __future__ import annotations

import numpy as np
import qdldl
import scipy.sparse as sparse

from embedding.coupling.system import System
from embedding.geometry.spaces import Mask

SHIFT = 1e-13
"""Stiffness of free rigid motions, whose pivots would otherwise be rounding, relative to the largest one."""


def unstable_modes(system: System) -> int | None:
    """Number of unstable modes at the last linearisation of ``system``.

    None where stability is not a matter of energy (loads without a potential), with a field, whose energy has no
    definite sign, and where a pivot cannot be told from rounding.
    """
    if not system.symmetric or system.physics.field is not None:
        return None
    matrix, multipliers = system.tangent()
    shift = SHIFT if system.unknowns.rigid else 0.0
    return negative_eigenvalues(matrix, multipliers, shift=shift, less=system.saddle_count)


def negative_eigenvalues(
    matrix: sparse.csc_array, border: Mask, *, shift: float = 0.0, less: int = 0
) -> int | None:
    """Negative eigenvalues of the symmetric ``matrix`` (n, n), ``less`` of which are not counted.

    Rows in ``border``, few and dense, are eliminated last. None if a pivot vanishes.
    """
    inner, outer = np.flatnonzero(~border), np.flatnonzero(border)
    core = matrix[inner][:, inner]
    if shift:
        core = core + shift * float(np.abs(core.diagonal()).max(initial=0.0)) * sparse.eye_array(len(inner))
    try:
        factors = qdldl.Solver(sparse.csc_matrix(sparse.triu(core)), upper=True)
    except RuntimeError:
        return None
    pivots = np.asarray(factors.factors()[1])
    if not np.all(np.isfinite(pivots)):
        return None
    count = int((pivots < 0).sum())
    if len(outer):
        sides = matrix[inner][:, outer].toarray()
        solved = np.column_stack([factors.solve(side) for side in sides.T])
        rest = matrix[outer][:, outer].toarray() - sides.T @ solved
        count += int((np.linalg.eigvalsh((rest + rest.T) / 2) < 0).sum())
    return count - less
