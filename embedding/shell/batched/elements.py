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
from embedding.shell.batched.part import Part
from embedding.shell.batched.pattern import Integers, Pattern
from embedding.shell.batched.places import blocks
from embedding.shell.batched.polynomials import Array
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
        self.parts = [
            Part(block, bending, law, thickness, [n[block.elements] for n in (*numbers, frame)], turns, cured)
            for block in blocks(domain)
        ]

    def residual(self, state: Array, out: Array) -> None:
        """Add the derivative of the energy at ``state`` to ``out``."""
        memory = self.bending.memory
        for part in self.parts:
            for numbers, values in part.residual(state, memory):
                np.add.at(out, numbers, values)

    def condensed(self, state: Array, update: Array, led: tuple[bool, bool]) -> Iterator[Array]:
        """The condensed matrices (e, nk, nk) of each block at ``state``, the membrane strain extrapolated over
        ``update``, of which the displacement counts; ``led`` as in :attr:`embedding.shell.membrane.Membrane.led`.

        Raises:
            numpy.linalg.LinAlgError: a matrix of moments is singular.
        """
        memory = self.bending.memory
        for part in self.parts:
            yield part.condensed(state, update, memory, led)

    @property
    def kept(self) -> list[Integers]:
        """Numbers (e, nk) of the unknowns of the condensed matrices, block by block."""
        return [part.kept for part in self.parts]

    def load(self, vector: Array, out: Array) -> None:
        """Add to ``out`` what the load ``vector`` on the moments is on the kept unknowns."""
        for part in self.parts:
            np.add.at(out, part.kept, part.condensation.load(vector[part.moment]))

    def follow(self, vector: Array, out: Array) -> None:
        """Add to ``out`` the moments that go with the kept unknowns in ``vector``."""
        for part in self.parts:
            out[part.moment] += part.condensation.follow(vector[part.kept])

    def own(self, vector: Array, out: Array) -> None:
        """Add to ``out`` the moments that the load ``vector`` on them brings by itself."""
        for part in self.parts:
            out[part.moment] += part.condensation.own(vector[part.moment])


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
