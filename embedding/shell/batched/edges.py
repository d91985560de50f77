"""The edge integral: angles between elements paired with their moments.

The density over an edge of the reference triangle is q m_nn with q = (angle_0 - angle) / |x_tau|, see angles.py, and
the normal-normal component of the moment on the reference triangle: the map to the element scales it by 1 / |X_tau|^2
and lengths by |X_tau|, and F t is x_tau / |X_tau|. The term of the rotation is bilinear and not among these.
"""

from __future__ import annotations

import numpy as np

from embedding.shell.batched.angles import Angle, Turn
from embedding.shell.batched.matrices import Matrices, columns, gathered, pair_columns, pairs
from embedding.shell.batched.places import Block, derivatives
from embedding.shell.batched.polynomials import Array, monomials, segment_rule
from embedding.shell.batched.reference import CORNERS, EDGES, edge_points, frame_basis


class Edges:
    """The edge integral of a block without the rotations; ``frame`` (3, 3, k, e) are the unknowns of the averaged
    normal of the reference: component, edge, number."""

    def __init__(self, block: Block, moments: Array, degree: int, frame: Array) -> None:
        slopes, normal = [], []
        for points, (start, end) in zip(edge_points(degree), EDGES, strict=True):
            tangent = np.subtract(CORNERS[end], CORNERS[start])
            outward = np.array([-tangent[1], tangent[0]])
            gradients = block.gradients(points)
            slopes.append([np.tensordot(v, gradients, axes=1) for v in (tangent, outward)])
            square = [outward[0] ** 2, 2 * outward[0] * outward[1], outward[1] ** 2]
            normal.append(np.einsum("v,pvq->pq", square, np.tensordot(monomials(block.order - 1, points), moments, 1)))
        self._slopes = np.concatenate(slopes, axis=1)
        self._normal = np.concatenate(normal)
        self._frame = frame_basis(block.orientation, block.order - 1, degree)
        self._sign = block.sign
        self._weights = block.copies * np.tile(segment_rule(degree)[1], 3)[:, None]
        self._uu, self._mu = pairs(self._slopes, self._slopes), pairs(self._normal[None], self._slopes)
        self._start = self._angle(block.places, frame).value

    def residual(self, x: Array, m: Array, frame: Array) -> tuple[Array, Array]:
        """First derivatives (n, 3, e) and (nm, e) at places ``x``, moments ``m`` and the unknowns of the ``frame``."""
        turn = Turn(self._start, self._angle(x, frame))
        force = gathered(self._slopes, self._weights * (self._normal @ m) * turn.slope)
        return force, self._normal.T @ (self._weights * turn.value)

    def matrices(self, x: Array, m: Array, frame: Array) -> Matrices:
        """Second derivatives; the one in the moments alone vanishes."""
        turn = Turn(self._start, self._angle(x, frame))
        n, nm, count = self._slopes.shape[2], *m.shape
        half = pair_columns(0.5 * self._weights * (self._normal @ m) * turn.bend)
        across = columns(self._weights * turn.slope)
        return Matrices(
            (self._uu @ half).reshape(n, n, 3, 3, count),
            (self._mu @ across).reshape(nm, n, 3, count),
            np.zeros((nm, nm, 1)),
        )

    def _angle(self, x: Array, frame: Array) -> Angle:
        tangent, outward = derivatives(self._slopes, x)
        common = np.asarray(self._frame @ frame).reshape(3, -1, frame.shape[3])
        return Angle(tangent, outward, common, self._sign)
