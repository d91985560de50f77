"""The field's second derivatives in the tets that touch the shell, many at once, in closed form.

With x(xi) the place of an element's points, moved, and G = dx/dxi, the co-energy 1/2 det G |G^-T phi_xi|^2 has the
second derivatives, in the directions N e_i and M e_j of the motion and psi of the potential, with q = G^-T N_xi,
e = G^-T phi_xi and h = G^-T psi_xi (from d det G = det G tr A and d e = - A^T e, A = dG G^-1),

    det G [ 1/2 e.e (q_i q'_j - q_j q'_i) + e_i (q_j e.q' - e.q q'_j) - e_j (q_i e.q' - e.q q'_i) + e_i e_j q.q' ]
    det G [ q_i e.h - e.q h_i - e_i q.h ].

The symbolic form stays the definition. What two potentials have to do with each other is in the potential's own matrix.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from ngsolve import ET, H1, IntegrationRule

from embedding.ambient.stiffening import BLOCK, PAIRS, inverse
from embedding.ambient.tets import Array, Integers, Tets, invariant
from embedding.coupling.blocks import Block
from embedding.coupling.field import FieldEnergies
from embedding.coupling.lagrangian import Lagrangian
from embedding.coupling.unknowns import SIDES
from embedding.geometry.domain import Domain


def possible(lagrangian: Lagrangian) -> bool:
    """Do these formulas hold for the field around the shell, and is each side moved by one unknown?"""
    domain, field = lagrangian.domain, lagrangian.field
    if field is None or field.field.extent != "surroundings" or field.field.varying is not None:
        return False
    space = domain.mesh.dim == 3 and domain.base is None and not domain.open
    return space and invariant(_rule(domain))


def _rule(domain: Domain) -> IntegrationRule:
    """That of all forms of the field, see :meth:`Domain.volume`."""
    return IntegrationRule(ET.TET, 2 * domain.sizes.order)


class TouchingTets:
    """Adds to the joint matrix what the motion of the faces has to do with itself and with the potential."""

    def __init__(self, lagrangian: Lagrangian) -> None:
        if lagrangian.field is None:
            raise RuntimeError("this scene has no field")
        self._sides = [_Side(lagrangian.field, face) for face in SIDES]

    def add(self, vector: Any, matrix: Any) -> None:
        """Add the second derivatives at ``vector`` to the joint ``matrix``."""
        for side in self._sides:
            side.add(vector.FV().NumPy(), matrix)


class _Side:
    """The elements on one side of the shell."""

    def __init__(self, field: FieldEnergies, face: str) -> None:
        domain, unknowns, side = field.domain, field.unknowns, SIDES[face]
        scale = -float(domain.reduction.copies) * field.field.liquids.get(side, 1.0)
        tets, degree, richer = Tets(domain, domain.near(side)), domain.sizes.order, domain.sizes.potential_order
        rule = _rule(domain)
        points, self._weights = np.array(rule.points), np.array(rule.weights)
        self._motion = field.motions[side].w
        interior, interior_degree = self._motion.space, self._motion.space.globalorder
        spaces = ((H1(domain.mesh, order=degree), degree), (H1(domain.mesh, order=richer), richer))
        of_interior = (interior.components[0], interior_degree)
        self._slopes, self._slopes_of_potential, self._slopes_of_interior = (
            tets.shapes(space, order, points)[1] for space, order in (*spaces, of_interior)
        )
        self._places = tets.places(*spaces[0])
        at_rest = np.tensordot(self._slopes[:, 0], self._places, axes=(1, 0)).transpose(1, 0, 2)
        self._scale = scale * np.sign(inverse(at_rest)[1])  # the order of their vertices may turn elements
        size = len(tets.numbers)
        self._interior = tets.dofs(interior, interior_degree).reshape(3, -1, size)
        (self._mover,) = field.movers(face)
        self._face = tets.dofs(unknowns.field(self._mover).space, degree).reshape(3, -1, size)
        names = ["phi", *(["jump"] if field.lifts(side, dict.fromkeys(unknowns.names)) else [])]
        self._potentials = {name: tets.dofs(unknowns.field(name).space, richer) for name in names}
        self._ranges = {name: unknowns.range(name) for name in (self._mover, *names)}
        # elements that touch the shell alike have the same functions of the displacement
        kinds, number = np.unique(self._face[0] >= 0, axis=1, return_inverse=True)
        self._groups = [
            (np.flatnonzero(kinds[:, kind]), np.flatnonzero(number.ravel() == kind)) for kind in range(kinds.shape[1])
        ]
        self._blocks: dict[str, Block] = {}
        self._where: dict[str, list[Integers]] = {}

    def _find(self, matrix: Any) -> None:
        rows = self._ranges[self._mover]
        for name, columns in self._ranges.items():
            own = name == self._mover
            block = Block(matrix, rows, columns, 3, 3 if own else 1)
            self._blocks[name] = block
            self._where[name] = [
                block.find(
                    self._face[0][np.ix_(chosen, group)],
                    self._face[0][np.ix_(chosen, group)] if own else self._potentials[name][:, group],
                )
                for chosen, group in self._groups
            ]

    def add(self, state: Array, matrix: Any) -> None:
        """Add the second derivatives at the joint ``state`` to the ``matrix``."""
        if not self._blocks:
            self._find(matrix)
        found: list[tuple[Array, Array]] = []
        with np.errstate(all="ignore"):
            for chosen, group in self._groups:
                own, other = self._slopes[:, :, chosen], self._slopes_of_potential
                products = np.einsum("apn,bpm->nmabp", own, own).reshape(len(chosen) ** 2, -1)
                mixed = np.einsum("apn,bpm->nmabp", own, other).reshape(len(chosen) * other.shape[2], -1)
                moving = np.empty((6, len(products), len(group)))
                coupling = np.empty((3, len(mixed), len(group)))
                for first in range(0, len(group), BLOCK):
                    part = slice(first, first + BLOCK)
                    stiffness, coupled = self._joined(state, group[part])
                    for target, table, values in ((moving, products, stiffness), (coupling, mixed, coupled)):
                        for place, value in zip(target, values, strict=True):
                            place[:, part] = table @ value.reshape(table.shape[1], -1)
                found.append((moving, coupling))
        for name, block in self._blocks.items():
            kind = 0 if name == self._mover else 1
            where = np.concatenate([place.ravel() for place in self._where[name]])
            count = 6 if kind == 0 else 3
            block.add(matrix, where, np.concatenate([pair[kind].reshape(count, -1) for pair in found], axis=1))

    def _joined(self, state: Array, elements: Integers) -> tuple[list[Array], list[Array]]:
        """What joins the derivatives of two functions, (3, 3, p, e): of the motion's components i <= j, and of the
        component i and the potential."""
        back, weight, e = self._geometry(state, elements)
        p = back.swapaxes(0, 1)  # q_i is the sum of p[i, a] and the derivatives N_a
        s = (e[:, None] * p).sum(axis=0)
        metric = (p[:, :, None] * p[:, None]).sum(axis=0)
        square = 0.5 * (e * e).sum(axis=0)
        turned = [v[:, None] * s[None] - s[:, None] * v[None] for v in p]
        stiffness = []
        for i, j in PAIRS:
            joined = e[i] * e[j] * metric
            if i != j:
                joined = joined + square * (p[i][:, None] * p[j][None] - p[j][:, None] * p[i][None])
                joined += e[i] * turned[j] - e[j] * turned[i]
            stiffness.append(weight * joined)
        return stiffness, [weight * (turned[i] - e[i] * metric) for i in range(3)]

    def _geometry(self, state: Array, elements: Integers) -> tuple[Array, Array, Array]:
        """G^-1 (3, 3, p, e), the weights times det G with the form's sign and factor, and e (3, p, e)."""
        displacement = np.append(state[self._ranges[self._mover]], 0.0)[self._face[:, :, elements]]
        place = displacement.transpose(1, 0, 2) + self._places[:, :, elements]
        interior = self._motion.vec.FV().NumPy()[self._interior[:, :, elements]]
        slope = np.tensordot(self._slopes, place, axes=(2, 0))  # (derivative, p, component, e)
        slope += np.tensordot(self._slopes_of_interior, interior, axes=(2, 1))
        back, volume = inverse(slope.transpose(2, 0, 1, 3))
        potential = sum(
            np.append(state[self._ranges[name]], 0.0)[dofs[:, elements]] for name, dofs in self._potentials.items()
        )
        gradient = np.tensordot(self._slopes_of_potential, potential, axes=(2, 0))
        return back, self._scale[elements] * self._weights[:, None] * volume, (back * gradient[:, None]).sum(axis=0)
