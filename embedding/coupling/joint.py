"""The joint form put together: what is symbolic, the tets that touch the shell, and what the potential's forms know."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from ngsolve import BilinearForm, GridFunction, Variation

from embedding.coupling.distant import Distant
from embedding.coupling.elementwise import form_of
from embedding.coupling.lagrangian import Lagrangian
from embedding.coupling.potential_form import PotentialForm
from embedding.coupling.touching import TouchingTets, possible
from embedding.geometry.spaces import Mask


def joint_form_of(lagrangian: Lagrangian, distant: Distant, potential: PotentialForm) -> Any:
    """The joint form of ``lagrangian`` with a potential around its shell."""
    if possible(lagrangian):
        return JointForm(form_of(lagrangian, "shell"), distant, Near(lagrangian, potential))
    return JointForm(form_of(lagrangian, "touching"), distant)


class Near:
    """The field in the tets that touch the shell: its residual, and with the matrix of the potential all of its own."""

    def __init__(self, lagrangian: Lagrangian, potential: PotentialForm) -> None:
        if lagrangian.field is None:
            raise RuntimeError("this scene has no field")
        self.potential, self.tets = potential, TouchingTets(lagrangian)
        self._state = lagrangian.unknowns.state.vec
        self.form = BilinearForm(lagrangian.unknowns.space, symmetric=True)
        for term in lagrangian.field.near_energies(lagrangian.unknowns.trial):
            self.form += Variation(-1 * term).Compile()
        self.rows = self._state.CreateVector()

    @contextmanager
    def at(self, vector: Any) -> Iterator[None]:
        """With ``vector`` for the state, on which the matrix of the potential depends."""
        state, values = self._state.FV().NumPy(), np.array(vector.FV().NumPy())
        saved = state.copy()
        state[:] = values
        try:
            yield
        finally:
            state[:] = saved


class JointForm:
    """The joint form: ``rest`` is all but what is ``distant`` from the shell, and but what is ``near`` it, if given.

    What NGSolve's form offers to the linear solvers is offered here, under the same names.
    """

    def __init__(self, rest: Any, distant: Distant, near: Near | None = None) -> None:
        self._rest, self._distant, self._near = rest, distant, near
        self._potential, self._block = GridFunction(distant.space).vec, _PotentialBlock(distant.range)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._rest, name)

    def Apply(self, vector: Any, out: Any) -> None:
        """Write the residual at ``vector`` to ``out``."""
        self._rest.Apply(vector, out)
        if self._near is not None:
            self._near.form.Apply(vector, self._near.rows)
            out.data += self._near.rows
        where = self._distant.range
        self._potential.FV().NumPy()[:] = vector.FV().NumPy()[where]
        out.FV().NumPy()[where] -= self._distant.gradient(self._potential).FV().NumPy()

    def AssembleLinearization(self, vector: Any) -> None:
        """Linearise at ``vector``."""
        self._rest.AssembleLinearization(vector)
        matrix = self._rest.mat
        if self._near is None:
            self._block.subtract(self._distant.matrix(), matrix)
            return
        self._near.tets.add(vector, matrix)
        with self._near.at(vector):
            self._near.potential.assemble()
        self._block.put(self._near.potential.mat, matrix)


class _PotentialBlock:
    """The entries of a matrix of the potential in the joint one, whose rows and columns of it are ``where``."""

    def __init__(self, where: slice) -> None:
        self._where = where
        self._inside: Mask | None = None

    def subtract(self, part: Any, joint: Any) -> None:
        """Subtract ``part`` from its block of ``joint``."""
        values, inside = self._entries(part, joint)
        values[inside] -= part.AsVector().FV().NumPy()

    def put(self, part: Any, joint: Any) -> None:
        """Let the block of ``joint`` be minus ``part``."""
        values, inside = self._entries(part, joint)
        values[inside] = -part.AsVector().FV().NumPy()

    def _entries(self, part: Any, joint: Any) -> tuple[Any, Mask]:
        values, columns, starts = (np.asarray(array) for array in joint.CSR())
        rows = slice(int(starts[self._where.start]), int(starts[self._where.stop]))
        if self._inside is None:
            inside = (columns[rows] >= self._where.start) & (columns[rows] < self._where.stop)
            if not np.array_equal(columns[rows][inside] - self._where.start, np.asarray(part.CSR()[1])):
                raise RuntimeError("the potential's own matrix has other entries than its block of the joint one")
            self._inside = inside
        return values[rows], self._inside
