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
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from embedding.errors import EmbeddingError
from embedding.geometry.spaces import Mask, as_bits, as_mask
from embedding.threads import factored
from embedding.timing import part

if TYPE_CHECKING:
    from scipy import sparse

ACCURATE, REFINE = 1e-8, 1e-11
"""Relative residual of a solve that is accurate, and of one that is not refined."""
BACKWARD, SINGULAR = 1e-12, 5e-14
"""Where motions are soft, as in the bending of thin shells, rounding leaves more. A solve is accurate, too, if its
residual is that of entries of matrix and load changed by ``BACKWARD`` of themselves (Oettli and Prager, Numer. Math. 6
(1964) 405), unless the load is less than ``SINGULAR`` of what cancels in the product of matrix and update: up to 2e-14
for singular matrices, 1e-13 for a strip whose length is a million times its thickness."""
BLANK = 1e3 * float(np.finfo(float).eps)
"""Rows that hold less than this, times the number of unknowns, of what the matrix makes of the largest of them hold
rounding alone, as those along a straight strip that bends. They are measured by the latter (M. Arioli, J. Demmel,
I. Duff, SIAM J. Matrix Anal. Appl. 10 (1989) 165)."""


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


class LinearSolver:
    """Solves with the matrix of an assembled form on its free unknowns, again and again.

    ``mask`` marks the free unknowns, ``kept`` those of them that are in the matrix. Unknowns that a form has condensed
    out are eliminated element by element before and recovered after; they are always free.
    """

    def __init__(self, free: Any, *, condensed: Mask | None = None) -> None:
        self.mask = as_mask(free)
        self._condensed = condensed is not None
        self.kept = self.mask if condensed is None else self.mask & ~condensed
        self.free = free if condensed is None else as_bits(self.kept)
        self._form: Any = None

    def factor(self, form: Any) -> None:
        """Take the assembled matrix of ``form``; it is factored when the first right side comes."""
        self._form = form

    def matrix(self) -> sparse.csc_array:
        """The matrix of the last :meth:`factor` on the kept unknowns."""
        from scipy import sparse  # slow to load, and most solves do without

        rows, columns, entries = (np.asarray(part) for part in self._form.mat.COO())
        size = (len(self.kept), len(self.kept))
        whole = sparse.csc_array((entries, (rows, columns)), shape=size)
        numbers = np.flatnonzero(self.kept)
        return sparse.csc_array(whole[numbers][:, numbers])

    @part("solution")
    def solve(self, right_side: Any, enough: float = 0.0) -> Any:
        """The update vector for ``right_side`` (left as it is), zero on the unknowns that are not free.

        What iterates may leave the part ``enough`` of the load; otherwise a solve is as accurate as any.

        Raises:
            LinearSolverError: no solver was accurate; the message says by how much.
        """
        load = right_side.CreateVector()
        load.data = right_side
        if self._condensed:
            load.data += self._form.harmonic_extension_trans * load
        update = self._kept_part(load, enough)
        if self._condensed:
            update.data += self._form.harmonic_extension * update
            update.data += self._form.inner_solve * load
        return update

    def _kept_part(self, load: Any, enough: float) -> Any:
        raise NotImplementedError

    def _backward_stable(self, load: Any, update: Any) -> bool:
        """Is the residual what rounding of the entries explains?"""
        matrix, x, b = self.matrix(), update.FV().NumPy()[self.kept], load.FV().NumPy()[self.kept]
        sizes = abs(matrix) @ np.abs(x)
        if not np.all(np.isfinite(sizes)) or np.all(np.abs(b) <= SINGULAR * sizes):
            return False
        whole = abs(matrix).sum(axis=1) * np.abs(x).max()
        blank = sizes + np.abs(b) <= BLANK * len(x) * (whole + np.abs(b))
        return bool(np.all(np.abs(b - matrix @ x) <= BACKWARD * (np.where(blank, whole, sizes) + np.abs(b))))


class DirectSolver(LinearSolver):
    """Factors the matrix: the way to solve anything that is not too large."""

    def __init__(self, free: Any, *, symmetric: bool, condensed: Mask | None = None) -> None:
        super().__init__(free, condensed=condensed)
        self._methods = ["sparsecholesky", "umfpack"] if symmetric else ["umfpack"]
        self._inverse: Any = None
        self._method = ""

    def factor(self, form: Any) -> None:
        """Take the assembled matrix of ``form``; it is factored when the first right side comes."""
        super().factor(form)
        self._inverse, self._method = None, ""

    def roughly(self, right_side: Any) -> Any:
        """The update that the factors at hand give, neither checked nor refined: for iterations that check themselves.

        Raises:
            LinearSolverError: there are no factors yet, and no solver is accurate.
        """
        if self._inverse is None:
            return self.solve(right_side)
        update = right_side.CreateVector()
        update.data = self._inverse * right_side
        return update

    def block(self, numbers: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
        """The block (n, n) of the inverse at the kept unknowns ``numbers``; a solve for each, the first one checked.

        Raises:
            LinearSolverError: no solver is accurate.
        """
        load = self._form.mat.CreateColVector()
        update, values = load.CreateVector(), load.FV().NumPy()
        columns = np.empty((len(numbers), len(numbers)))
        for column, number in enumerate(numbers):
            load[:] = 0.0
            values[number] = 1.0
            update.data = self._inverse * load if column else self._kept_part(load, 0.0)
            columns[:, column] = update.FV().NumPy()[numbers]
        return columns

    def _kept_part(self, load: Any, _enough: float) -> Any:
        update = load.CreateVector()
        update[:] = 0.0
        scale = float(np.linalg.norm(load.FV().NumPy()[self.kept]))
        if scale == 0.0:
            return update
        worst = "no solver ran"
        for method in self._methods[self._methods.index(self._method) if self._method else 0 :]:
            # Only umfpack has words of its own about a singular matrix.
            with silent_stdout() if method == "umfpack" else contextlib.nullcontext():
                try:
                    if method != self._method:
                        with part("factorisation"):
                            self._inverse = factored(self._form.mat, self.free, method)
                        self._method = method
                except Exception as error:  # NGSolve raises its own untyped exceptions for singular matrices
                    worst = f"{method}: {error}"
                    continue
            remainder = self._refined(load, update) / scale
            if np.isfinite(remainder) and (remainder < ACCURATE or self._backward_stable(load, update)):
                return update
            worst = f"{method}: relative residual {remainder:.1e}"
        self._method = ""
        raise LinearSolverError(f"the linear system could not be solved ({worst})")

    def _refined(self, load: Any, update: Any) -> float:
        """Solve, with one step of iterative refinement if the residual asks for it; returns the residual's norm."""
        residual = load.CreateVector()
        update.data = self._inverse * load
        goal, norm = REFINE * float(np.linalg.norm(load.FV().NumPy()[self.kept])), float("inf")
        for attempt in range(2):
            residual.data = load - self._form.mat * update
            norm = float(np.linalg.norm(residual.FV().NumPy()[self.kept]))
            if attempt or norm < goal:
                break
            update.data += self._inverse * residual
        return norm
