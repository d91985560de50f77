"""All elements of a bent surface: residual, condensed matrices, and what a solve has to do for the moments.

Vectors are those of all unknowns of a problem, in which the shell's unknowns have their numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import BND, BilinearForm, ElementId, FESpace, GridFunction, Variation

from embedding.geometry.domain import Domain
from embedding.shell.batched.bending import Bending
from embedding.shell.batched.condensation import Condensation
from embedding.shell.batched.edges import Edges
from embedding.shell.batched.laws import Hooke, Rubber, law_at
from embedding.shell.batched.membrane import Membrane
from embedding.shell.batched.pattern import Integers, Pattern
from embedding.shell.batched.places import Block, blocks
from embedding.shell.batched.polynomials import Array, triangle_rule
from embedding.shell.batched.reference import moment_basis
from embedding.shell.bending import SurfaceBending
from embedding.shell.laws import GentLaw, KoiterLaw, Law, MooneyRivlinLaw, YeohLaw


def supported(domain: Domain, law: Law) -> bool:
    """Is the shell's elastic energy among what is done here?"""
    return domain.mesh.dim == 3 and isinstance(law, KoiterLaw | MooneyRivlinLaw | YeohLaw | GentLaw)


@dataclass(frozen=True)
class Spaces:
    """Space and number of the first unknown of displacement, moment and rotation."""

    u: tuple[Any, int]
    moment: tuple[Any, int]
    rotation: tuple[Any, int]


class ShellElements:
    """Membrane and bending of the shell on ``domain``, with the unknowns of ``spaces``.

    ``bending`` knows the frames that angles are measured from; ``cured`` says whether membrane strains are
    interpolated.
    """

    def __init__(
        self, domain: Domain, law: Law, thickness: Any, bending: SurfaceBending, spaces: Spaces, *, cured: bool
    ) -> None:
        self.bending = bending
        numbers = [_numbers(domain, *space) for space in (spaces.u, spaces.moment, spaces.rotation)]
        frame = _numbers(domain, bending.reference.space, 0)
        turns = _turns(bending, spaces, numbers[1], numbers[2])
        self._parts = [
            _Part(block, bending, law, thickness, [n[block.elements] for n in (*numbers, frame)], turns, cured)
            for block in blocks(domain)
        ]

    def residual(self, state: Array, out: Array) -> None:
        """Add the derivative of the energy at ``state`` to ``out``."""
        frame = self.bending.memory
        for part in self._parts:
            for numbers, values in part.residual(state, frame):
                np.add.at(out, numbers, values)

    def condensed(self, state: Array, update: Array) -> Iterator[Array]:
        """The condensed matrices (e, nk, nk) of each block at ``state``, the membrane stress extrapolated over
        ``update``, of which the displacement counts.

        Raises:
            numpy.linalg.LinAlgError: a matrix of moments is singular.
        """
        frame = self.bending.memory
        for part in self._parts:
            yield part.condensed(state, update, frame)

    @property
    def kept(self) -> list[Integers]:
        """Numbers (e, nk) of the unknowns of the condensed matrices, block by block."""
        return [part.kept for part in self._parts]

    def load(self, vector: Array, out: Array) -> None:
        """Add to ``out`` what the load ``vector`` on the moments is on the kept unknowns."""
        for part in self._parts:
            np.add.at(out, part.kept, part.condensation.load(vector[part.moment]))

    def follow(self, vector: Array, out: Array) -> None:
        """Add to ``out`` the moments that go with the kept unknowns in ``vector``."""
        for part in self._parts:
            out[part.moment] += part.condensation.follow(vector[part.kept])

    def own(self, vector: Array, out: Array) -> None:
        """Add to ``out`` the moments that the load ``vector`` on them brings by itself."""
        for part in self._parts:
            out[part.moment] += part.condensation.own(vector[part.moment])


class _Part:
    """One block with its energies; ``numbers`` (e, ...) are those of displacement, moment, rotation and frame."""

    condensation: Condensation

    def __init__(
        self,
        block: Block,
        bending: SurfaceBending,
        law: Law,
        thickness: Any,
        numbers: list[Integers],
        turns: Array,
        cured: bool,
    ) -> None:
        u, self.moment, self._rotation, frame = numbers
        self._u = u.reshape(len(u), 3, -1)
        self._frame = frame.reshape(len(u), 3, 3, -1).transpose(1, 2, 3, 0)
        self.kept = np.concatenate([u, self._rotation], axis=1)
        self._turns = turns[block.elements]
        moments, degree = moment_basis(block.orientation, block.order - 1), bending.degree
        inner, fine = triangle_rule(degree)[0], 2 * block.order
        self._bending = Bending(block, moments, degree, *_material(block, inner, law, thickness))
        reference = np.array(bending.reference.vec.FV().NumPy())
        self._edges = Edges(block, moments, degree, reference[self._frame])
        points = triangle_rule(fine)[0]
        self._membrane = Membrane(block, fine, *_material(block, points, law, thickness), cured=cured)
        self._places = block.places

    def _at(self, state: Array) -> tuple[Array, Array]:
        """Displacement (n, 3, e) and moment (nm, e)."""
        return np.ascontiguousarray(state[self._u].transpose(2, 1, 0)), np.ascontiguousarray(state[self.moment].T)

    def residual(self, state: Array, frame: Array) -> Iterator[tuple[Integers, Array]]:
        """Pairs of numbers and the derivatives to be added there."""
        u, m = self._at(state)
        x = self._places + u
        pull, curvature = self._bending.residual(x, m)
        edge_pull, turn = self._edges.residual(x, m, frame[self._frame])
        pull = pull + edge_pull + self._membrane.residual(u)
        yield self._u, pull.transpose(2, 1, 0)
        rotation = (self._turns @ state[self._rotation][:, :, None])[:, :, 0]
        yield self.moment, (curvature + turn).T + rotation
        yield self._rotation, (m.T[:, None] @ self._turns)[:, 0]

    def condensed(self, state: Array, update: Array, frame: Array) -> Array:
        """The condensed matrices (e, nk, nk)."""
        u, m = self._at(state)
        x = self._places + u
        moved, _ = self._at(update)
        matrices = self._bending.matrices(x, m) + self._edges.matrices(x, m, frame[self._frame])
        nm, n, _, count = matrices.mu.shape
        half = np.ascontiguousarray(matrices.uu.transpose(4, 2, 0, 3, 1)).reshape(count, 3 * n, 3 * n)
        kept = np.zeros((count, *2 * (self.kept.shape[1],)))
        kept[:, : 3 * n, : 3 * n] = half + half.swapaxes(1, 2)
        kept[:, : 3 * n, : 3 * n] += self._membrane.matrix(u, moved if np.any(moved) else None)
        pull = matrices.mu.transpose(3, 0, 2, 1).reshape(count, nm, 3 * n)
        moments = np.ascontiguousarray(np.asarray(matrices.mm).transpose(2, 0, 1))
        out, self.condensation = Condensation.of(kept, np.concatenate([pull, self._turns], axis=2), moments)
        return out


def _material(block: Block, points: Array, law: Law, thickness: Any) -> tuple[Hooke | Rubber, Array]:
    """Law and thickness at reference ``points`` of a block."""
    there = law_at(law, block, points)
    if there is None:
        raise TypeError(f"no elements of {type(law).__name__}")
    return there, block.at(points, thickness)


def _numbers(domain: Domain, space: Any, start: int) -> Integers:
    """Numbers of the unknowns of each element of the shell, shape (elements, n)."""
    return np.array([space.GetDofNrs(ElementId(BND, int(i))) for i in domain.facets.numbers], np.int64) + start


def _turns(bending: SurfaceBending, spaces: Spaces, moments: Integers, rotations: Integers) -> Array:
    """The matrix (elements, nm, nr) that pairs moments with rotations, which is constant."""
    space = FESpace([spaces.moment[0], spaces.rotation[0]])
    (moment, rotation), _ = space.TnT()
    form = BilinearForm(space, symmetric=True)
    form += Variation(bending.rotation_work(moment.Trace(), rotation.Trace()))
    form.AssembleLinearization(GridFunction(space).vec)
    rows, columns, entries = (np.asarray(part) for part in form.mat.COO())
    pattern = Pattern(rows, columns, space.ndof)
    shift = spaces.moment[0].ndof - spaces.rotation[1]
    where = pattern.find((moments - spaces.moment[1])[:, :, None], (rotations + shift)[:, None, :])
    return np.asarray(entries[where])
