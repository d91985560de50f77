"""Resultant force and torque of the field, on the shell and on the bodies beside it.

They are the work of the field on a rigid motion of one of them while all else stays where it is: derivatives of the
discrete co-energy, the line force on the rim of an open shell included. Pointwise tractions, which are infinite there,
are never integrated. Source: theory page, "Face tractions".
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, CF, BilinearForm, Compress, Cross, Grad, GridFunction, Variation, VectorH1

from embedding.coupling.field import FieldEnergies, Moved
from embedding.coupling.following import Following
from embedding.coupling.lagrangian import Lagrangian
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import as_bits, as_mask

Array = npt.NDArray[np.float64]
Turn = Callable[[Any], Any]


class ShellResultants:
    """Force and torque about the origin that the field exerts on the whole shell.

    Of an open shell with an interior that follows, as in its equilibrium: at a rim that is the far better derivative.
    """

    def __init__(self, lagrangian: Lagrangian, following: Following | None) -> None:
        self._unknowns, self._domain, self._following = lagrangian.unknowns, lagrangian.domain, following
        self._form = BilinearForm(self._unknowns.space, symmetric=True)
        for term in lagrangian.field_energies(self._unknowns.trial):
            self._form += Variation(term).Compile()
        self._moved = ["u", *(self._unknowns.moved_by(face) for face in self._unknowns.opened)]
        self._rows = self._unknowns.state.vec.CreateVector()
        shifts = _translations(self._domain)
        self._shifts = [{name: self._motion(name, shift) for name in self._placed} for shift in shifts]

    def evaluate(self) -> tuple[Array, Array]:
        """Force (d,) and torque (3 in space, 1 in plane strain, none in axisymmetry) of the present state."""
        self._form.Apply(self._unknowns.state.vec, self._rows)
        if self._following is not None:
            self._following.add_to(self._rows, -1.0)
        forces = [sum(self._work(name, motion) for name, motion in shift.items()) for shift in self._shifts]
        torques = [sum(self._turned(name, turn) for name in self._moved) for turn in _turns(self._domain)]
        return np.array(forces), np.array(torques)

    @property
    def _placed(self) -> list[str]:
        """The unknowns that a translation changes: not the distances of faces from the mid-surface."""
        return [name for name in self._moved if not name.startswith("o_")]

    def _turned(self, name: str, turn: Turn) -> float:
        present = self._unknowns.field(name)
        turned = turn(present + self._domain.reduction.position if name in self._placed else present)
        return self._work(name, self._motion(name, turned))

    def _motion(self, name: str, motion: Any) -> Array:
        """The unknown ``name`` of a ``motion`` of the shell."""
        direction = GridFunction(self._unknowns.field(name).space)
        direction.Set(motion, BND, definedon=self._domain.shell)
        return np.array(direction.vec.FV().NumPy())

    def _work(self, name: str, motion: Array) -> float:
        return float(self._rows.FV().NumPy()[self._unknowns.range(name)] @ motion)


class BodyResultants:
    """Force and torque about the origin that the field exerts on one of the bodies, bounded by ``body<number>``."""

    def __init__(self, domain: Domain, field: FieldEnergies, values: dict[str, Any], number: int) -> None:
        self._domain = domain
        self._boundary = domain.mesh.Boundaries(f"body{number}")
        whole = VectorH1(domain.mesh, order=domain.sizes.order)
        space = Compress(whole, as_bits(as_mask(whole.GetDofs(self._boundary))))
        self._still, self._rows = GridFunction(space), GridFunction(space).vec
        self._form = BilinearForm(space)
        shift = space.TrialFunction()
        for term in field.moved_energies(values, lambda w: Moved(w.value + shift, w.gradient + Grad(shift))):
            self._form += Variation(term).Compile()

    def evaluate(self) -> tuple[Array, Array]:
        """Force (d,) and torque (3 in space, 1 in plane strain, none in axisymmetry) of the present state."""
        self._form.Apply(self._still.vec, self._rows)
        position = self._domain.reduction.position
        motions = [*_translations(self._domain), *(turn(position) for turn in _turns(self._domain))]
        works = np.array([self._work(motion) for motion in motions])
        return works[: self._domain.mesh.dim], works[self._domain.mesh.dim :]

    def _work(self, motion: Any) -> float:
        direction = GridFunction(self._still.space)
        direction.Set(motion, BND, definedon=self._boundary)
        return float(self._rows.FV().NumPy() @ direction.vec.FV().NumPy())


def _translations(domain: Domain) -> list[Any]:
    return [CF(tuple(row)) for row in np.eye(domain.mesh.dim)]


def _turns(domain: Domain) -> list[Turn]:
    """Rotations about the axes through the origin that the mesh can show, as functions of the place."""
    if domain.reduction.name == "axisymmetric":
        return []
    if domain.mesh.dim == 2:
        return [lambda x: CF((-x[1], x[0]))]
    return [partial(Cross, CF(tuple(row))) for row in np.eye(3)]


def resultants(
    lagrangian: Lagrangian, following: Following | None
) -> dict[str, ShellResultants | BodyResultants]:
    """What measures the field's force and torque on the shell and on each body, by name; nothing without a field."""
    field, unknowns = lagrangian.field, lagrangian.unknowns
    if field is None:
        return {}
    values = {name: unknowns.field(name) for name in unknowns.names}
    bodies = range(len(field.field.bodies))
    return {"shell": ShellResultants(lagrangian, following)} | {
        f"body{number}": BodyResultants(lagrangian.domain, field, values, number) for number in bodies
    }
