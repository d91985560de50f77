"""The energy of the ambient's extension on tets, many at once, with derivatives in closed form.

It stands in for the symbolic form of :func:`~embedding.ambient.motion.extension_energy`, which stays the definition and
serves two dimensions. With F = I + Grad(y) + Grad(w), J = det F, q = F^-T Grad N, f = F Grad N for a function N, and
h^-3 times the volume an element has in the mesh being the weight of a point alone, that is

    Phi    = 1/2 [ J^-2/3 F.F - 3 + c (J^2 - 1 - 2 log J) ]
    dPhi   = J^-2/3 ( f_i - 1/3 F.F q_i ) + c (J^2 - 1) q_i                                     in the direction N e_i
    d2Phi  = J^-2/3 ( delta_ij Grad N . Grad M - 2/3 (f_i q'_j + q_i f'_j) + 2/9 F.F q_i q'_j + 1/3 F.F q_j q'_i )
             + c ( 2 J^2 q_i q'_j - (J^2 - 1) q_j q'_i )                                                 and in M e_j.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import ET, H1, BilinearForm, GridFunction, InnerProduct, IntegrationRule, dx

from embedding.ambient.entries import Entries
from embedding.ambient.tets import Array, Integers, Tets
from embedding.geometry.domain import Domain

PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
BLOCK = 128
"""Most elements at once: their arrays then stay in the cache."""


@dataclass(frozen=True)
class _Part:
    """Elements of some materials: unknowns of w (n, e) of one component and of the face's displacement y (3, m, e), -1
    where it has none; positions (m, 3, e)."""

    own: Integers
    face: Integers | None
    y: Any
    places: Array
    slopes: Array  # of the functions of w, (3, p, n)
    slopes_of_places: Array  # (3, p, m)


@dataclass(frozen=True)
class _Strain:
    """F.F, J, and the vectors that q, f and Grad N are of the derivatives of N, arrays (3 components, 3, p, e)."""

    square: Array
    volume: Array
    q: Array
    f: Array
    slope: Array


class StiffeningForm:
    """Energy, residual and matrix in the interior motion w, by the names of NGSolve's form; the faces' displacements
    ``parts`` (by pattern of materials, None where none reaches) are taken as they are.

    ``price`` is that of a change of volume, c, and ``rule`` the quadrature.
    """

    def __init__(
        self, domain: Domain, interior: Any, parts: Mapping[str, Any], price: float, rule: IntegrationRule
    ) -> None:
        self._price = price
        points, self._weights = np.array(rule.points), np.array(rule.weights)
        scalar, degree = interior.components[0], interior.globalorder
        richer = H1(domain.mesh, order=domain.sizes.order)
        self._parts = []
        for materials, y in parts.items():
            tets = Tets(domain, materials)
            if not len(tets.numbers):
                continue
            face = None if y is None else tets.dofs(y.space, richer.globalorder).reshape(3, -1, len(tets.numbers))
            slopes, slopes_of_places = (
                tets.shapes(space, space_degree, points)[1]
                for space, space_degree in ((scalar, degree), (richer, richer.globalorder))
            )
            places = tets.places(richer, richer.globalorder)
            self._parts.append(_Part(tets.dofs(scalar, degree), face, y, places, slopes, slopes_of_places))
        self._count = scalar.ndof
        self.mat = _pattern(interior)
        self._entries = Entries(self.mat, self._count)
        self._where = [self._entries.find(part.own) for part in self._parts]

    def Energy(self, vector: Any) -> float:
        """The energy at ``vector``; not a number where an element has turned over."""
        total = 0.0
        with np.errstate(all="ignore"):
            for _, _, strain in self._all_strains(vector):
                square, volume = strain.square, strain.volume
                stored = volume ** (-2 / 3) * square - 3 + self._price * (volume**2 - 1 - 2 * np.log(volume))
                total += 0.5 * float((self._weights @ stored).sum())
        return total

    def Apply(self, vector: Any, out: Any) -> None:
        """Write the residual at ``vector`` to ``out``."""
        rows = out.FV().NumPy()
        rows[:] = 0.0
        with np.errstate(all="ignore"):
            for part, elements, strain in self._all_strains(vector):
                weight, shape, volume = self._weights[:, None], strain.volume ** (-2 / 3), strain.volume
                swell = self._price * (volume**2 - 1) - shape * strain.square / 3
                stress = weight * (shape * strain.f + swell * strain.q)
                forces = np.tensordot(part.slopes, stress, axes=((0, 1), (1, 2)))  # (n, 3, e)
                where = part.own[:, None, elements] + self._count * np.arange(3)[:, None]
                rows += np.bincount(where.ravel(), forces.ravel(), len(rows))

    def AssembleLinearization(self, vector: Any) -> None:
        """Write the matrix at ``vector`` to ``mat``."""
        self._entries.clear()
        with np.errstate(all="ignore"):
            for part, where in zip(self._parts, self._where, strict=True):
                products = np.einsum("apn,bpm->nmabp", part.slopes, part.slopes).reshape(len(part.own) ** 2, -1)
                blocks = np.empty((6, len(products), part.own.shape[1]))
                for elements, strain in self._strains(part, vector):
                    for block, stiffness in zip(blocks, self._stiffness(strain), strict=True):
                        block[:, elements] = products @ stiffness.reshape(-1, stiffness.shape[-1])
                for (i, j), block in zip(PAIRS, blocks, strict=True):
                    self._entries.add(i, j, where, block)
        self._entries.write()

    def _stiffness(self, strain: _Strain) -> Iterator[Array]:
        """For the pairs of components, what joins the derivatives of two functions, (3, 3, p, e)."""
        weight, shape, volume = self._weights[:, None], strain.volume ** (-2 / 3), strain.volume
        q, swell = strain.q, self._price * volume**2
        mixed = weight * ((shape * strain.square / 9 + swell) * q - 2 / 3 * shape * strain.f)
        turned = weight * (shape * strain.square / 3 - swell + self._price) * q
        metric = np.einsum("Aape,Abpe->abpe", weight * shape * strain.slope, strain.slope)
        for i, j in PAIRS:
            joined = q[i][:, None] * mixed[j] + mixed[i][:, None] * q[j] + q[j][:, None] * turned[i]
            yield joined + metric if i == j else joined

    def _all_strains(self, vector: Any) -> Iterator[tuple[_Part, slice, _Strain]]:
        for part in self._parts:
            for elements, strain in self._strains(part, vector):
                yield part, elements, strain

    def _strains(self, part: _Part, vector: Any) -> Iterator[tuple[slice, _Strain]]:
        values = vector.FV().NumPy().reshape(3, -1)
        unknowns = None if part.y is None else np.append(part.y.vec.FV().NumPy(), 0.0)
        for first in range(0, part.own.shape[1], BLOCK):
            elements = slice(first, first + BLOCK)
            # derivatives (3, p, 3 components, e)
            moved = np.tensordot(part.slopes, values[:, part.own[:, elements]], axes=(2, 1))
            if part.face is not None and unknowns is not None:
                moved += np.tensordot(part.slopes_of_places, unknowns[part.face[:, :, elements]], axes=(2, 1))
            at_rest = np.tensordot(part.slopes_of_places, part.places[:, :, elements], axes=(2, 0))
            yield elements, _strain(moved.transpose(2, 0, 1, 3), at_rest.transpose(2, 0, 1, 3))


def _strain(moved: Array, at_rest: Array) -> _Strain:
    """From the derivatives (3 components, 3, p, e) of the motion and of the position at rest."""
    reference, before = inverse(at_rest)  # d xi_a / d X_B at [a, B]
    back, after = inverse(at_rest + moved)
    gradient = np.einsum("iape,aBpe->iBpe", at_rest + moved, reference)
    return _Strain(
        (gradient**2).sum(axis=(0, 1)),
        after / before,
        back.swapaxes(0, 1),
        np.einsum("iBpe,aBpe->iape", gradient, reference),
        reference.swapaxes(0, 1),
    )


def inverse(matrix: Array) -> tuple[Array, Array]:
    """Inverse and determinant of 3 x 3 matrices along the first axes of ``matrix``."""
    cofactor = np.stack([np.stack([_minor(matrix, i, j) for i in range(3)]) for j in range(3)])
    determinant = sum(matrix[0, k] * cofactor[k, 0] for k in range(3))
    return cofactor / determinant, determinant


def _minor(matrix: Array, i: int, j: int) -> Array:
    (a, b), (c, d) = ((i + 1) % 3, (i + 2) % 3), ((j + 1) % 3, (j + 2) % 3)
    return np.asarray(matrix[a, c] * matrix[b, d] - matrix[a, d] * matrix[b, c])


def _pattern(interior: Any) -> Any:
    """A matrix of the space with zeros for entries."""
    trial, test = interior.TnT()
    form = BilinearForm(interior)
    form += (0.0 * InnerProduct(trial, test) * dx(intrules={ET.TET: IntegrationRule(ET.TET, 0)})).Compile()
    form.AssembleLinearization(GridFunction(interior).vec)
    return form.mat
