"""The joint form of a bent surface, with its elastic energies assembled many elements at once.

It stands in for the symbolic form with its moments condensed out: what NGSolve's form of that kind offers to the direct
solver is offered here, under the same names.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BaseMatrix, BilinearForm, CreateVVector
from ngsolve.la import SparseMatrixd

from embedding.coupling.lagrangian import Extent, Lagrangian
from embedding.coupling.linear import LinearSolverError
from embedding.coupling.unknowns import assembled_in_batches
from embedding.shell.batched import ShellElements, Spaces
from embedding.shell.batched.pattern import Pattern, Sum
from embedding.shell.bending import SurfaceBending
from embedding.shell.membrane import Membrane

Array = npt.NDArray[np.float64]


def form_of(lagrangian: Lagrangian, field: Extent = "all") -> Any:
    """The joint form of ``lagrangian``: an :class:`ElementwiseForm` where that is possible, else NGSolve's; with the
    extent of the ``field`` as in :meth:`Lagrangian.joint_form`."""
    bending, membrane = lagrangian.unknowns.bending, lagrangian.membrane
    possible = assembled_in_batches(lagrangian.domain, lagrangian.physics)
    if possible and isinstance(bending, SurfaceBending) and membrane is not None:
        return ElementwiseForm(lagrangian, bending, membrane, field)
    return lagrangian.joint_form(field=field)


class ElementwiseForm:
    """Residual and condensed matrix of ``lagrangian``, and the operators that eliminate and recover the moments."""

    def __init__(
        self, lagrangian: Lagrangian, bending: SurfaceBending, membrane: Membrane, field: Extent
    ) -> None:
        unknowns, physics = lagrangian.unknowns, lagrangian.physics
        self._count, self._membrane, self._range = unknowns.space.ndof, membrane, unknowns.range("u")
        self.shell = ShellElements(
            lagrangian.domain,
            physics.law,
            physics.thickness,
            bending,
            Spaces(*((unknowns.field(name).space, unknowns.range(name).start) for name in ("u", "moment", "rotation"))),
            cured=physics.locking_cured,
        )
        self._proximal = lagrangian.factors.proximal
        self._free, self._tied = (
            lagrangian.joint_form(elastic=False, proximal=tied, field=field) for tied in (False, True)
        )
        self._store = _Store(self._free, self.shell, unknowns.condensed, unknowns.state.vec)
        self.harmonic_extension_trans = _Operator(self._count, self.shell.load)
        self.harmonic_extension = _Operator(self._count, self.shell.follow)
        self.inner_solve = _Operator(self._count, self.shell.own)

    @property
    def mat(self) -> Any:
        """The matrix of the last linearisation, with empty rows for the moments."""
        return self._store.matrix

    @property
    def _rest(self) -> BilinearForm:
        """All that is not elastic; the proximal stiffness, seldom there, costs more than the loads."""
        return self._tied if self._proximal.Get() else self._free

    def Apply(self, vector: Any, out: Any) -> None:
        """Write the residual at ``vector`` to ``out``."""
        self._rest.Apply(vector, out)
        with np.errstate(all="ignore"):  # a state that is not a number is found out by the norm of the residual
            self.shell.residual(vector.FV().NumPy(), out.FV().NumPy())

    def AssembleLinearization(self, vector: Any) -> None:
        """Linearise at ``vector``.

        Raises:
            LinearSolverError: the moments of an element cannot be eliminated.
        """
        self._rest.AssembleLinearization(vector)
        update = np.zeros(self._count)
        update[self._range] = self._membrane.update.vec.FV().NumPy()
        try:
            with np.errstate(all="ignore"):
                matrices = self.shell.condensed(np.array(vector.FV().NumPy()), update, self._membrane.led)
                self._store.fill(self._rest, matrices)
        except np.linalg.LinAlgError as error:
            raise LinearSolverError(f"the moments of an element could not be eliminated ({error})") from error


class _Store:
    """The sparse matrix: entries of the elements and of the ``rest``, in one pattern that is found once."""

    def __init__(self, rest: BilinearForm, shell: ShellElements, condensed: Any, state: Any) -> None:
        rest.AssembleLinearization(state)
        rows, columns = (np.asarray(part, np.int64) for part in rest.mat.COO()[:2])
        self._used = ~(condensed[rows] | condensed[columns])
        rows, columns = rows[self._used], columns[self._used]
        pairs = [np.broadcast_arrays(kept[:, :, None], kept[:, None, :]) for kept in shell.kept]
        size = len(condensed)
        pattern = Pattern(
            np.concatenate([rows, *(row.ravel() for row, _ in pairs)]),
            np.concatenate([columns, *(column.ravel() for _, column in pairs)]),
            size,
        )
        self._elements = [Sum(pattern.find(row, column)) for row, column in pairs]
        self._others = pattern.find(rows, columns)
        self.matrix = SparseMatrixd.CreateFromCOO(
            pattern.rows, pattern.columns, np.zeros(len(pattern.rows)), size, size
        )

    def fill(self, rest: BilinearForm, blocks: Iterable[Array]) -> None:
        """Add up the matrices of the ``blocks`` and the ``rest``, which is assembled already."""
        entries = self.matrix.AsVector().FV().NumPy()
        entries[:] = 0.0
        entries[self._others] = rest.mat.AsVector().FV().NumPy()[self._used]
        for where, block in zip(self._elements, blocks, strict=True):
            where.add(block, entries)


class _Operator(BaseMatrix):  # type: ignore[misc]
    """What ``add(vector, out)`` adds, as an operator on vectors of ``count`` numbers."""

    def __init__(self, count: int, add: Callable[[Array, Array], None]) -> None:
        super().__init__()
        self._count, self._add = count, add

    def Height(self) -> int:
        return self._count

    def Width(self) -> int:
        return self._count

    def Shape(self) -> tuple[int, int]:
        return self._count, self._count

    def IsComplex(self) -> bool:
        return False

    def CreateVector(self, _colvector: bool = True) -> Any:
        return CreateVVector(self._count)

    def Mult(self, vector: Any, out: Any) -> None:
        values = np.array(vector.FV().NumPy())
        out[:] = 0.0
        self._add(values, out.FV().NumPy())

    def MultAdd(self, factor: float, vector: Any, out: Any) -> None:
        self._add(factor * vector.FV().NumPy(), out.FV().NumPy())
