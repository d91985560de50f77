"""A preconditioner for forms of second order on a volume mesh: patches around vertices, over linear elements.

One cycle solves for all unknowns around each vertex in turn (those of the vertex and of the edges, faces and cells that
meet in it), then for the piecewise linear part at once and directly, then around the vertices in the opposite order.
The number of iterations it leaves to conjugate gradients is bounded for any mesh size and polynomial order (Pavarino,
Numer. Math. 66 (1994) 493; Schoeberl, Melenk, Pechstein, Zaglmayr, IMA J. Numer. Anal. 28 (2008) 1). Smaller blocks
(nodes, edges with their faces) need ten times as many iterations at order 4.

No patch helps where coefficients differ by direction without bound, along a surface of high contrast or in a region
that is mapped to infinity. All unknowns there join the linear ones; surfaces and thin layers are cheap to factor.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import CELL, EDGE, FACE, VERTEX, NodeId, Projector

from embedding.geometry.spaces import Mask, as_bits
from embedding.threads import factored


class VertexPatches:
    """The blocks of a ``space`` (H1, VectorH1, restricted to a shell, or a product of those) over ``free`` unknowns.

    Those marked ``stiff`` are solved for with the piecewise linear part, the ones ``at_once``.
    """

    def __init__(self, space: Any, free: Mask, stiff: Mask | None = None) -> None:
        mesh, kinds = space.mesh, (VERTEX, EDGE, FACE, CELL)[: space.mesh.dim + 1]
        groups = [mesh.vertices, mesh.edges, mesh.faces, *([mesh.Elements()] if mesh.dim == 3 else [])]
        self.at_once = np.zeros(len(free), bool)
        covered = np.zeros(len(free), bool)
        around: list[set[int]] = [set() for _ in range(mesh.nv)]
        for kind, group in zip(kinds, groups, strict=True):
            for node in group:
                dofs = [d for d in space.GetDofNrs(NodeId(kind, node.nr)) if d >= 0 and free[d]]
                if not dofs:
                    continue
                covered[dofs] = True
                if kind == VERTEX:
                    self.at_once[dofs] = True
                for vertex in [node.nr] if kind == VERTEX else [v.nr for v in node.vertices]:
                    around[vertex].update(dofs)
        self.at_once |= free & ~covered  # numbers belong to no node
        if stiff is not None:
            self.at_once |= free & stiff
        self.free = free
        self._bits, self._bits_at_once = as_bits(free), as_bits(self.at_once)
        self._blocks = [sorted(block) for block in around if block]

    def cycle(self, matrix: Any) -> Cycle:
        """The preconditioner for ``matrix``, which must be definite on the free unknowns."""
        smoother = matrix.CreateBlockSmoother(self._blocks)
        at_once = factored(matrix, self._bits_at_once)
        return Cycle(matrix, smoother, at_once, Projector(self._bits, True))


class Cycle:
    """A symmetric approximate inverse of a ``matrix``, zero on the unknowns that are not free."""

    def __init__(self, matrix: Any, smoother: Any, at_once: Any, free: Any) -> None:
        self.matrix, self.free = matrix, free
        self._smoother, self._at_once = smoother, at_once
        self._rest = matrix.CreateColVector()

    def apply(self, right_side: Any, out: Any) -> None:
        """Write the approximate solution for ``right_side``, zero where it is not free, to ``out``."""
        out[:] = 0.0
        self._smoother.Smooth(out, right_side)
        self._rest.data = right_side - self.matrix * out
        out.data += self._at_once * self._rest
        self._smoother.SmoothBack(out, right_side)
