"""Iterative solvers for large ambients: conjugate gradients for the potential, GMRES for the joint system.

In the joint system the ambient's unknowns are many and mutually definite, the others few and indefinite, and the two
meet only in the elements that touch the shell. So the shell's unknowns, the faces', the jump and what of the potential
feels them are eliminated directly: a factorisation along a surface. What remains is a system for the rest of the
potential, whose inverse without coupling is a part of the inverse of the potential's own matrix, and the cycle of that
matrix preconditions it. Source: theory page, "Large ambients".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.ambient.krylov import Ending, conjugate_gradients, gmres
from embedding.ambient.patches import Cycle, VertexPatches
from embedding.coupling.linear import ACCURATE, DirectSolver, LinearSolver, LinearSolverError
from embedding.coupling.unknowns import FACES, SIDES, Unknowns
from embedding.geometry.spaces import Mask, as_bits, scalar_mask
from embedding.timing import part

Array = npt.NDArray[np.float64]
POTENTIAL_TOLERANCE = 1e-10
JOINT_TOLERANCE, LEAST_GAIN = 1e-9, 0.1
"""What GMRES leaves of the load of the joint system, of which ``ACCURATE`` may be left; and what it gains at least."""
MOST_ITERATIONS, MOST_JOINT = 200, 150
FELT = 0.1
"""How strongly an unknown of the potential must be coupled to what is no potential to be eliminated with it: in a
charged balloon a third of the factors' cost at the same count of iterations, of which 0.3 takes some more."""
WORN = 60
"""Iterations of the joint system after which a preconditioner from an earlier state is replaced."""


def far_unknowns(unknowns: Unknowns) -> Mask:
    """The unknowns of the potential that meet no other: those in elements that do not touch the shell."""
    domain, phi = unknowns.domain, unknowns.field("phi").space
    touching = "|".join(domain.near(SIDES[face]) for face in FACES)
    far = np.zeros(unknowns.space.ndof, bool)
    far[unknowns.range("phi")] = ~scalar_mask(phi, domain.mesh.Materials(touching))
    return far


class PotentialSolver(LinearSolver):
    """Conjugate gradients for the matrix of a potential on its ``space``; ``iterations`` counts them, by solve."""

    def __init__(self, space: Any, free: Mask) -> None:
        super().__init__(as_bits(free))
        self._space = space
        self._patches: VertexPatches | None = None
        self._cycle: Cycle | None = None
        self.iterations: list[int] = []

    def factor(self, form: Any) -> None:
        """Take the assembled matrix of ``form``."""
        super().factor(form)
        self._cycle = None

    @property
    def ready(self) -> bool:
        """Is there a matrix?"""
        return self._form is not None

    @property
    def cycle(self) -> Cycle:
        """The preconditioner of the last :meth:`factor`."""
        if self._patches is None:
            mesh = self._space.mesh
            stiff = scalar_mask(self._space, mesh.Boundaries("shell")) | scalar_mask(
                self._space, mesh.Materials("beyond")
            )
            self._patches = VertexPatches(self._space, self.mask, stiff)
        if self._cycle is None:
            try:
                with part("preconditioner"):
                    self._cycle = self._patches.cycle(self._form.mat)
            except Exception as error:  # NGSolve raises its own untyped exceptions for singular blocks
                raise LinearSolverError(f"the linear system could not be solved (singular: {error})") from error
        return self._cycle

    def _kept_part(self, load: Any, enough: float) -> Any:
        update = load.CreateVector()
        ending = conjugate_gradients(self.cycle, load, update, max(enough, POTENTIAL_TOLERANCE), MOST_ITERATIONS)
        self.iterations.append(ending.iterations)
        # Rounding may end it before: what cannot be told from the solution in the energy is one.
        if not ending.remainder < max(2 * enough, ACCURATE):
            raise LinearSolverError(_failure("conjugate gradients", ending))
        return update


class JointSolver(LinearSolver):
    """Direct for all that is no potential and what of the potential feels it, GMRES for the rest of the potential;
    ``iterations`` counts those of every solve.

    ``potential`` is where phi is in the joint system, of which what is ``far`` meets no other unknowns, and ``cycle``
    returns the preconditioner of the potential's own matrix: as it is at hand, or renewed for the present state.
    """

    def __init__(
        self,
        free: Any,
        *,
        symmetric: bool,
        far: Mask,
        potential: slice,
        cycle: Callable[..., Cycle],
        condensed: Mask | None = None,
    ) -> None:
        super().__init__(free, condensed=condensed)
        self._symmetric, self._start, self._cycle = symmetric, potential.start, cycle
        there = np.zeros(len(self.mask), bool)
        there[potential] = True
        self._others, self._beyond = self.kept & ~there, far & self.mask
        self._touching = np.flatnonzero(there & self.mask & ~far)
        self.iterations: list[int] = []

    def factor(self, form: Any) -> None:
        """Take the assembled matrix of ``form``."""
        super().factor(form)
        far = self._beyond.copy()
        far[self._touching] = self._strength() <= FELT
        self._far = np.flatnonzero(far)
        self._in_potential = self._far - self._start
        self._near = DirectSolver(as_bits(self.kept & ~far), symmetric=self._symmetric)
        self._near.factor(form)

    def _strength(self) -> Array:
        """How strongly the unknowns of the potential in elements that touch the shell are coupled to what is no
        potential: the root of the sum of K_ij^2 / |K_ii K_jj|."""
        values, columns, starts = (np.asarray(array) for array in self._form.mat.CSR())
        sizes = np.abs(values[_diagonal(columns, starts)])
        weights = np.divide(1.0, sizes, out=np.zeros_like(sizes), where=self._others & (sizes > 0.0))
        above, below = self._touching[0], self._touching[-1] + 1
        first, last = int(starts[above]), int(starts[below])
        squares = weights[columns[first:last]]
        squares *= values[first:last]
        squares *= values[first:last]
        sums = np.add.reduceat(np.append(squares, 0.0), starts[above:below].astype(np.int64) - first)
        return np.asarray(np.sqrt(sums[self._touching - above] / sizes[self._touching]))

    def _kept_part(self, load: Any, enough: float) -> Any:
        update, rest = load.CreateVector(), load.CreateVector()
        update[:] = 0.0
        size = float(np.linalg.norm(load.FV().NumPy()[self.kept]))
        if size == 0.0:
            return update
        rest.data, accurate = load, max(2 * enough, ACCURATE)
        self.iterations.append(0)
        for _ in range(2):  # once more if rounding near the shell asks for it
            update.data += self._eliminated(rest, max(enough, JOINT_TOLERANCE) * size)
            rest.data = load - self._form.mat * update
            remainder = float(np.linalg.norm(rest.FV().NumPy()[self.kept])) / size
            if not remainder > accurate:
                break
        if not (remainder < accurate or self._backward_stable(load, update)):
            raise LinearSolverError(_failure("GMRES", Ending(self.iterations[-1], remainder)))
        return update

    def _eliminated(self, load: Any, remainder: float) -> Any:
        """The solution for ``load``, by elimination of what is near the shell; GMRES leaves a ``remainder`` of that
        norm."""
        near, image = self._near.solve(load), load.CreateVector()
        image.data = load - self._form.mat * near
        right_side = image.FV().NumPy()[self._far]
        far = load.CreateVector()
        far[:] = 0.0
        far.FV().NumPy()[self._far] = self._far_part(right_side, remainder)
        image.data = load - self._form.mat * far
        far.data += self._near.solve(image)
        return far

    def _far_part(self, right_side: Array, remainder: float) -> Array:
        size = float(np.linalg.norm(right_side))
        # what is near the shell may put far more on the right side than there is load
        tolerance = min(LEAST_GAIN, remainder / size) if size > 0.0 else LEAST_GAIN
        work, image = (self._form.mat.CreateColVector() for _ in range(2))

        def operator(values: Array) -> Array:
            work[:] = 0.0
            work.FV().NumPy()[self._far] = values
            image.data = self._form.mat * work
            work.data = self._near.roughly(image)
            rows = image.FV().NumPy()[self._far]
            image.data = self._form.mat * work
            return np.asarray(rows - image.FV().NumPy()[self._far])

        for renewed in (False, True):
            cycle = self._cycle(renewed=renewed)
            inner, outer = cycle.matrix.CreateColVector(), cycle.matrix.CreateColVector()

            def better(values: Array, cycle: Cycle = cycle, inner: Any = inner, outer: Any = outer) -> Array:
                inner[:] = 0.0
                inner.FV().NumPy()[self._in_potential] = values
                cycle.apply(inner, outer)
                return np.asarray(-outer.FV().NumPy()[self._in_potential])

            found, ending = gmres(operator, better, right_side, tolerance, MOST_JOINT if renewed else WORN)
            self.iterations[-1] += ending.iterations
            if ending.remainder <= tolerance:
                return found
        raise LinearSolverError(_failure("GMRES", ending))


def _diagonal(columns: Any, starts: Any) -> npt.NDArray[np.int64]:
    """Where the entries of the diagonal are among those of a matrix, sorted by rows; by bisection of all rows at once.
    For rows without one, any place."""
    low, high = starts[:-1].astype(np.int64), starts[1:].astype(np.int64)
    rows = np.arange(len(low))
    while np.any(high - low > 1):
        middle = (low + high) // 2
        left = columns[np.minimum(middle, len(columns) - 1)] <= rows
        low, high = np.where(left & (high - low > 1), middle, low), np.where(left | (high - low <= 1), high, middle)
    return np.asarray(np.minimum(low, len(columns) - 1), np.int64)


def _failure(method: str, ending: Ending) -> str:
    count, remainder = ending.iterations, ending.remainder
    return f"the linear system could not be solved ({method}: residual {remainder:.1e} after {count} iterations)"
