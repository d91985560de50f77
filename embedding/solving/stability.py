"""Stability of an equilibrium: how many independent small motions would lower the potential energy.

By Sylvester's law the pivots of a symmetric elimination have as many negative ones among them as the matrix has
negative eigenvalues. Some of those belong to every stable state and do not count (Haynsworth, Linear Algebra Appl. 1
(1968) 73, on the inertia of a matrix and of its Schur complement):

* one for each multiplier: of rigid motions, of an enclosed volume, and of the places of the faces;
* one for each bending moment that is not eliminated before;
* one for each free potential, whose energy has the other sign: eliminated, the field follows the shell's motion.

What is left is the number of unstable modes among the motions that the multipliers allow, voltages and charges being
held where they are given. Theory page, "Stability".
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from embedding.coupling.system import System
from embedding.geometry.spaces import Mask

SHIFT = 1e-13
"""Stiffness of free rigid motions, whose pivots would otherwise be rounding, relative to the largest one."""

SMALL = 1000
"""Rows of a matrix whose eigenvalues may be computed."""

MOST = 20_000
"""Unknowns of a coupled problem up to which modes are counted: in three dimensions one count costs two or three
steps of Newton's method, and beyond this direct elimination is too expensive altogether."""


def countable(system: System) -> bool:
    """Is stability a matter of energy: have all loads a potential?"""
    return system.symmetric


def unstable_modes(system: System) -> int | None:
    """Number of unstable modes at the last linearisation of ``system``.

    None where it cannot be counted, a pivot cannot be told from rounding, or the field has too many unknowns for it.
    A shell that is held cannot be unstable.
    """
    if not system.unknowns.trace.free.any() and "axial" not in system.unknowns:
        return 0
    if not countable(system) or (system.physics.field is not None and system.free_count > MOST):
        return None
    matrix, multipliers = system.tangent()
    shift = SHIFT if system.unknowns.rigid else 0.0
    count = negative_eigenvalues(matrix, multipliers, shift=shift, less=system.saddle_count)
    return None if count is None else count + system.more_negative


def negative_eigenvalues(matrix: sparse.csc_array, border: Mask, *, shift: float = 0.0, less: int = 0) -> int | None:
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
    count = int((factors.U.diagonal() < 0).sum())
    if len(outer):
        sides = matrix[inner][:, outer].toarray()
        rest = matrix[outer][:, outer].toarray() - sides.T @ factors.solve(sides)
        count += int((np.linalg.eigvalsh((rest + rest.T) / 2) < 0).sum())
    return count - less


def _factors(core: sparse.csc_array) -> Any:
    """Factors of ``core`` by symmetric elimination, the signs of whose pivots are those of D in L D L^T; or None.

    SuperLU works on blocks of columns, which for large matrices outweighs that it also computes U = D L^T.
    """
    try:
        factors = splu(
            sparse.csc_matrix(core),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError:
        return None
    on_diagonal = np.array_equal(factors.perm_r, factors.perm_c)
    return factors if on_diagonal and np.all(np.isfinite(factors.U.diagonal())) else None
