"""The work of the field on the ambient's interior, as forces on the faces that the interior follows."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BilinearForm, Grad, Variation

from embedding.ambient.extension import Extension
from embedding.ambient.krylov import gmres
from embedding.ambient.motion import AmbientMotion
from embedding.coupling.field import FieldEnergies, Moved
from embedding.coupling.linear import LinearSolver
from embedding.coupling.unknowns import SIDES, Unknowns
from embedding.geometry.domain import Domain

Array = npt.NDArray[np.float64]
PROBE = 1e-5
"""Largest change of an unknown in a difference quotient."""
TOLERANCE, MOST = 1e-4, 20
"""What is left of an update's error by the part of the tangent that is in no matrix, and iterations for it."""
DIRECTIONS, FIRST, HARMLESS = 12, 4, 0.5
"""Directions in which eigenvalues are looked for; no more than the first few where all found in those are small."""
REAL, ROUNDING = 1e-3, 1e-10
"""Largest imaginary part of an eigenvalue that counts as real; what of a new direction is no direction."""


class Following:
    """What the field does on an interior that follows the faces of an open shell: forces, and their derivative.

    The forces are part of the residual. Their derivative N is of low rank but has entries everywhere; it is not in
    Newton's matrix K. Updates are solved with K + N by GMRES, preconditioned by the factors of K. Eigenvalues of
    K^-1 N are few, 0.3 for a strong magnet with 0.006 next to it, and a few iterations do.
    """

    def __init__(self, domain: Domain, field: FieldEnergies, unknowns: Unknowns, motion: AmbientMotion) -> None:
        self._unknowns, self._motion, self._extension = unknowns, motion, Extension(domain, motion)
        trial = motion.w.space.TrialFunction()
        values = {name: unknowns.field(name) for name in unknowns.names}
        self._form = BilinearForm(motion.w.space)
        for term in field.moved_energies(values, lambda _: Moved(trial, Grad(trial)), given=False):
            self._form += Variation(-1 * term).Compile()
        self._rows = {
            SIDES[face]: [unknowns.range(name) for name in field.movers(face)] for face in unknowns.faces
        }
        self._felt = np.zeros(unknowns.space.ndof, bool)
        for name in set(unknowns.names) & {"u", "o_t", "o_b", "phi", "jump"}:
            self._felt[unknowns.range(name)] = True
        self.linearise()

    def add_to(self, residual: Any, scale: float = 1.0) -> None:
        """Add the rows of the faces' motions to a ``residual`` of the joint system; ``scale`` -1 gives forces."""
        forces = self._motion.w.vec.CreateVector()
        self._form.Apply(self._motion.w.vec, forces)
        self._add_rows(forces, residual.FV().NumPy(), scale)

    def _add_rows(self, forces: Any, rows: Array, scale: float) -> None:
        for side, forces_on_face in self._extension.transposed(forces).items():
            for where in self._rows[side]:
                rows[where] += scale * forces_on_face

    def linearise(self) -> None:
        """Let :meth:`derivative` be that at the present state."""
        self._at = np.array(self._unknowns.state.vec.FV().NumPy())
        self._interior = self._motion.w.vec.CreateVector()
        self._interior.data = self._motion.w.vec

    def derivative(self, direction: Array) -> Array:
        """N times ``direction``: how the forces answer to the unknowns, the present place of the interior held; by a
        central difference quotient, exact in the potential, of which the forces are a quadratic function."""
        out, largest = np.zeros_like(direction), float(np.abs(direction[self._felt]).max(initial=0.0))
        if largest == 0.0:
            return out
        state, step = self._unknowns.state.vec.FV().NumPy(), PROBE / largest
        present = state.copy()
        ahead, behind = (self._interior.CreateVector() for _ in range(2))
        for forces, side in ((ahead, step), (behind, -step)):
            state[:] = self._at + side * direction
            self._form.Apply(self._interior, forces)
        state[:] = present
        ahead.data -= behind
        self._add_rows(ahead, out, 0.5 / step)
        return out

    def complete(self, solver: LinearSolver, update: Any) -> Any:
        """Turn an ``update`` solved with K, which ``solver`` has factored, into that of K + N."""
        found, _ = gmres(
            lambda x: x + self._by_matrix(solver, x), lambda x: x, update.FV().NumPy().copy(), TOLERANCE, MOST
        )
        update.FV().NumPy()[:] = found
        return update

    def _by_matrix(self, solver: LinearSolver, direction: Array) -> Array:
        """K^-1 N times ``direction``."""
        rows = self._unknowns.state.vec.CreateVector()
        rows.FV().NumPy()[:] = np.where(solver.mask, self.derivative(direction), 0.0)
        return np.array(solver.solve(rows).FV().NumPy())

    def more_negative(self, solver: LinearSolver) -> int:
        """How many more negative eigenvalues K + N has than K.

        On the way from K to K + N, adding t N, an eigenvalue passes through zero where -1 / t is an eigenvalue of
        K^-1 N: one for each of those below -1, upwards where v . N v > 0 and downwards where it is negative. The few
        that can be as large are found in the Krylov space of an arbitrary vector (Arnoldi, Q. Appl. Math. 9 (1951) 17).
        """
        start = self._by_matrix(solver, np.random.default_rng(0).standard_normal(len(self._at)) * solver.mask)
        length = float(np.linalg.norm(start))
        if length == 0.0:
            return 0
        basis, square = [start / length], np.zeros((DIRECTIONS + 1, DIRECTIONS))
        values = vectors = np.zeros((0, 0))
        for column in range(DIRECTIONS):
            vector = self._by_matrix(solver, basis[column])
            for _ in range(2):  # once more, lest rounding spoils the basis
                for row, known in enumerate(basis):
                    part = float(known @ vector)
                    square[row, column] += part
                    vector -= part * known
            size = column + 1
            square[size, column] = float(np.linalg.norm(vector))
            values, vectors = np.linalg.eig(square[:size, :size])
            if size >= FIRST and np.abs(values).max() < HARMLESS:
                return 0
            if square[size, column] <= ROUNDING * np.abs(square).max():
                break
            basis.append(vector / square[size, column])
        modes = [
            np.real(weights) @ np.array(basis[: len(weights)])
            for value, weights in zip(values, vectors.T, strict=True)
            if value.real < -1.0 and abs(value.imag) < REAL * abs(value)
        ]
        return -sum(int(np.sign(mode @ self.derivative(mode))) for mode in modes)
