"""Stability of an equilibrium: how many independent small motions would lower the potential energy.

By Sylvester's law the pivots of a symmetric elimination have as many negative ones among them as the matrix has
negative eigenvalues. Some of those belong to every stable state and do not count (Haynsworth, Linear Algebra Appl. 1
(1968) 73, on the inertia of a matrix and of its Schur complement):

* one for each multiplier: of rigid motions, of an enclosed volume, and of the places of the faces;
* one for each bending moment that is not eliminated before;
* one for each free potential, whose energy has the other sign: eliminated, the field follows the shell's motion.

Of a shell with few unknowns the inverse serves instead, whose factors are at hand: its block of the displacements
is the inverse of the stiffness that is left when all else is eliminated, on the motions that the multipliers allow.

What is left is the number of unstable modes among the motions that the multipliers allow, voltages and charges being
held where they are given. Theory page, "Stability".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from embedding.blas import scipy_ready
from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import System
from embedding.geometry.spaces import Mask
from embedding.timing import part

if TYPE_CHECKING:
    from scipy import sparse

SHIFT = 1e-13
"""Stiffness of free rigid motions, whose pivots would otherwise be rounding, relative to the largest one."""

SMALL = 1000
"""Rows of a matrix whose eigenvalues may be computed."""

PLAIN = frozenset({"y_t", "y_b", "tau_t", "tau_b", "phi", "jump", "moment"})
"""Unknowns that may be beside the displacement there: eliminated, they bring the eigenvalues of every stable state."""

APART, CLEAR = 1e3, 1e-9
"""Eigenvalues of the inverse that vanish are smaller than all others by more than the first; those, over the largest,
are above the second, or their signs might be rounding, as they might below what the inverse lacks in symmetry."""

MOST = 20_000
"""Unknowns of a coupled problem up to which modes are counted: in three dimensions one count costs two or three
steps of Newton's method, and beyond this direct elimination is too expensive altogether."""


def countable(system: System) -> bool:
    """Is stability a matter of energy: have all loads a potential?"""
    return system.symmetric


@part("stability")
def unstable_modes(system: System) -> int | None:
    """Number of unstable modes at the last linearisation of ``system``.

    None where it cannot be counted, a pivot cannot be told from rounding, or the field has too many unknowns for it.
    A shell that is held cannot be unstable.
    """
    if not system.unknowns.trace.free.any() and "axial" not in system.unknowns:
        return 0
    if not countable(system) or (system.physics.field is not None and system.free_count > MOST):
        return None
    few = _unstable_by_inverse(system)
    if few is not None:
        return few
    matrix, multipliers = system.tangent()
    shift = SHIFT if system.unknowns.rigid else 0.0
    count = negative_eigenvalues(matrix, multipliers, shift=shift, less=system.saddle_count)
    return None if count is None else count + system.more_negative


def _unstable_by_inverse(system: System) -> int | None:
    """Negative eigenvalues of the displacements' block of the inverse, but for those that multipliers, of rigid motions
    and of the volume, make vanish; None where that is dearer than the other way, or not safe."""
    unknowns = system.unknowns
    if not set(unknowns.names) <= PLAIN | {"u", *unknowns.numbers}:
        return None
    try:
        inverse = system.inverse_at("u", "axial")
    except LinearSolverError:  # the factors were good enough for one direction, and are not for all
        return None
    if inverse is None:
        return None
    values = np.linalg.eigvalsh((inverse + inverse.T) / 2)
    values = values[np.argsort(np.abs(values))]
    vanishing, rest = np.split(values, [len(unknowns.rigid) + system.free_in("pressure")])
    if not len(rest):
        return None
    rounding = len(values) * float(np.abs(inverse - inverse.T).max())
    unclear = max(APART * np.abs(vanishing).max(initial=0.0), CLEAR * abs(rest[-1]), rounding)
    return int((rest < 0).sum()) if abs(rest[0]) > unclear else None


def negative_eigenvalues(matrix: sparse.csc_array, border: Mask, *, shift: float = 0.0, less: int = 0) -> int | None:
    """Negative eigenvalues of the symmetric ``matrix`` (n, n), ``less`` of which are not counted.

    Rows in ``border``, few and dense, are eliminated last. A pivot that vanishes is no eigenvalue that does: then those
    of a small matrix are computed, and for a large one the answer is None.
    """
    from scipy import sparse  # slow to load, and a shell with few unknowns does without

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
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    scipy_ready()
    try:
        factors = splu(
            csc_matrix(core),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError:
        return None
    on_diagonal = np.array_equal(factors.perm_r, factors.perm_c)
    return factors if on_diagonal and np.all(np.isfinite(factors.U.diagonal())) else None
