"""The energies of one block of elements, joined to residuals and condensed matrices."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from embedding.shell.batched.bending import Bending
from embedding.shell.batched.condensation import Condensation
from embedding.shell.batched.edges import Edges
from embedding.shell.batched.laws import Hooke, Rubber, law_at
from embedding.shell.batched.membrane import Membrane
from embedding.shell.batched.pattern import Integers
from embedding.shell.batched.places import Block
from embedding.shell.batched.polynomials import Array, triangle_rule
from embedding.shell.batched.reference import moment_basis
from embedding.shell.bending import SurfaceBending
from embedding.shell.laws import Law


class Part:
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
        self.places, self._turns = block.places, turns[block.elements]
        moments, degree, fine = moment_basis(block.orientation, block.order - 1), bending.degree, 2 * block.order
        self.membrane = Membrane(block, fine, *_material(block, fine, law, thickness), cured=cured)
        self.bending = Bending(block, moments, degree, *_material(block, degree, law, thickness))
        self.edges = Edges(block, moments, degree, self.frame(np.array(bending.reference.vec.FV().NumPy())))

    def frame(self, memory: Array) -> Array:
        """The elements' unknowns (3, 3, k, e) of the averaged normal, of all of them in ``memory``."""
        return memory[self._frame]

    def unknowns(self, state: Array) -> tuple[Array, Array]:
        """Displacement (n, 3, e) and moment (nm, e)."""
        return np.ascontiguousarray(state[self._u].transpose(2, 1, 0)), np.ascontiguousarray(state[self.moment].T)

    def residual(self, state: Array, memory: Array) -> Iterator[tuple[Integers, Array]]:
        """Pairs of numbers and the derivatives to be added there."""
        u, m = self.unknowns(state)
        x = self.places + u
        pull, curvature = self.bending.residual(x, m)
        edge_pull, turn = self.edges.residual(x, m, self.frame(memory))
        pull = pull + edge_pull + self.membrane.residual(u)
        yield self._u, pull.transpose(2, 1, 0)
        rotation = (self._turns @ state[self._rotation][:, :, None])[:, :, 0]
        yield self.moment, (curvature + turn).T + rotation
        yield self._rotation, (m.T[:, None] @ self._turns)[:, 0]

    def condensed(self, state: Array, update: Array, memory: Array, led: tuple[bool, bool]) -> Array:
        """The condensed matrices (e, nk, nk)."""
        u, m = self.unknowns(state)
        x = self.places + u
        moved, _ = self.unknowns(update)
        matrices = self.bending.matrices(x, m) + self.edges.matrices(x, m, self.frame(memory))
        nm, n, _, count = matrices.mu.shape
        half = np.ascontiguousarray(matrices.uu.transpose(4, 2, 0, 3, 1)).reshape(count, 3 * n, 3 * n)
        kept = np.zeros((count, *2 * (self.kept.shape[1],)))
        kept[:, : 3 * n, : 3 * n] = half + half.swapaxes(1, 2)
        kept[:, : 3 * n, : 3 * n] += self.membrane.matrix(u, moved, *led)
        pull = matrices.mu.transpose(3, 0, 2, 1).reshape(count, nm, 3 * n)
        moments = np.ascontiguousarray(np.asarray(matrices.mm).transpose(2, 0, 1))
        out, self.condensation = Condensation.of(kept, np.concatenate([pull, self._turns], axis=2), moments)
        return out


def _material(block: Block, degree: int, law: Law, thickness: Any) -> tuple[Hooke | Rubber, Array]:
    """Law and thickness at the points of the rule of ``degree``."""
    points, _ = triangle_rule(degree)
    there = law_at(law, block, points)
    if there is None:
        raise TypeError(f"no elements of {type(law).__name__}")
    return there, block.at(points, thickness)
