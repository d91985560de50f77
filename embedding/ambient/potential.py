"""The scalar potential on both sides of the shell, with its jump as an explicit unknown where the scene has one.

``phi`` is continuous everywhere. On one side, the ``lifted`` one, the potential is phi + jump, where the jump lives on
the shell and reaches only into the elements that touch it; it vanishes on the rims of an open shell. On a conductor the
potential has one value: one unknown of the space, prescribed or free. Which values those are, ``sources`` says.

A shell that only has a field inside, between electrodes on both faces, has a single number for its jump and no phi.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import BND, CF, H1, GridFunction, InnerProduct, NumberSpace, PlateauFESpace

from embedding.ambient.sources import Electrodes, Source
from embedding.geometry.domain import Domain
from embedding.geometry.spaces import Mask, TraceSpace, as_mask, plane_mask, scalar_mask


@dataclass(frozen=True)
class Conductor:
    """One value of the potential: the unknown ``number`` of the component ``name``, and what it is given.

    ``charge`` is what the unknown answers to at full load, None where ``voltage`` is prescribed.
    """

    label: str
    name: str
    number: int
    voltage: float | None
    charge: float | None


class PotentialSpaces:
    """Spaces of the potential and its jump by name, which unknowns are free, and how prescribed values enter."""

    def __init__(
        self,
        domain: Domain,
        electrodes: Electrodes,
        bodies: Sequence[Source | None] = (),
        *,
        grounded: bool,
        applied: tuple[float, ...],
        odd_planes: tuple[str, ...],
    ) -> None:
        order = domain.sizes.potential_order
        self.electrodes = electrodes
        self.conductors: list[Conductor] = []
        self.phi, held = self._spread(domain, bodies, odd_planes)
        self.on_outer: Mask = scalar_mask(self.phi, domain.mesh.Boundaries("outer"))
        held |= self.on_outer & grounded
        for conductor in self.conductors:
            held[conductor.number] |= conductor.voltage is not None
        self.free_phi: Mask = as_mask(self.phi.FreeDofs()) & ~held
        self.jump: TraceSpace | None = None
        if electrodes.jump_exists:
            plateaus = (domain.patch(electrodes.where),) if electrodes.other is not None else ()
            reach = domain.materials(electrodes.lifted)
            self.jump = TraceSpace(domain.mesh, order, vector=False, reach=reach, plateaus=plateaus)
            self.jump.fix(0, _odd(self.jump.scalar, odd_planes) | domain.rim_dofs(self.jump.scalar))
            self._jump_conductor(domain)
        self._on_outer_values = self._uniform(domain, applied) if grounded and any(applied) else None

    def _spread(
        self, domain: Domain, bodies: Sequence[Source | None], odd_planes: tuple[str, ...]
    ) -> tuple[Any, Mask]:
        """The space of phi with one unknown for each conductor, and what symmetry holds."""
        electrodes, base = self.electrodes, self.electrodes.base
        regions, sources, labels = [], [], []
        if base is not None:
            regions.append(domain.patch(electrodes.where))
            sources.append(_with_other(base, electrodes.other))
            labels.append("shell")
        for number, body in enumerate(bodies):
            if body is not None:
                regions.append(domain.mesh.Boundaries(f"body{number}"))
                sources.append(body)
                labels.append(f"body{number}")
        space = H1(domain.mesh, order=domain.sizes.potential_order)
        phi = PlateauFESpace(space, regions) if regions else space
        for region, source, label in zip(regions, sources, labels, strict=True):
            number = int(np.flatnonzero(scalar_mask(phi, region))[0])
            self.conductors.append(Conductor(label, "phi", number, source.voltage, source.charge))
        return phi, _odd(phi, odd_planes)

    def _jump_conductor(self, domain: Domain) -> None:
        other, jump = self.electrodes.other, self.jump
        if other is None or jump is None:
            return
        number = jump.plateau_unknown(domain.patch(self.electrodes.where))
        conductor = Conductor("jump", "jump", number, self.electrodes.jump, other.charge)
        self.conductors.append(conductor)
        if conductor.voltage is not None:
            jump.fix_unknown(number)

    def _uniform(self, domain: Domain, applied: tuple[float, ...]) -> Any:
        """Potential of the applied field on the outer boundary of a box that is held at it."""
        field = GridFunction(self.phi)
        field.Set(
            -InnerProduct(CF(applied), domain.reduction.position),
            BND,
            definedon=domain.mesh.Boundaries("outer"),
        )
        return np.array(field.vec.FV().NumPy())[self.on_outer]

    @property
    def spaces(self) -> dict[str, Any]:
        """The spaces, phi first."""
        return {"phi": self.phi} | ({"jump": self.jump.space} if self.jump is not None else {})

    @property
    def free(self) -> dict[str, Mask]:
        """Free unknowns by name."""
        return {"phi": self.free_phi} | ({"jump": self.jump.free} if self.jump is not None else {})

    def prescribe(self, vectors: Mapping[str, Any], factor: float) -> None:
        """Write given potentials, scaled by ``factor``, into the vectors of phi and of the jump."""
        if self._on_outer_values is not None:
            vectors["phi"].FV().NumPy()[self.on_outer] = factor * self._on_outer_values
        _prescribe(self.conductors, vectors, factor)


class FilmPotential:
    """The one jump of a film between two electrodes, when the field around it is left out: V_t - V_b, a number."""

    def __init__(self, domain: Domain, electrodes: Electrodes) -> None:
        self.electrodes = electrodes
        space, other = NumberSpace(domain.mesh), electrodes.other
        if other is None or electrodes.base is None:
            raise RuntimeError("a film without two electrodes has no field")
        charge = other.charge
        self.conductors = [Conductor("jump", "jump", 0, electrodes.jump, charge)]
        self.spaces: dict[str, Any] = {"jump": space}
        self.free: dict[str, Mask] = {"jump": np.full(1, electrodes.jump is None)}

    def prescribe(self, vectors: Mapping[str, Any], factor: float) -> None:
        """Write the given jump, scaled by ``factor``, into its vector."""
        _prescribe(self.conductors, vectors, factor)


def _prescribe(conductors: Sequence[Conductor], vectors: Mapping[str, Any], factor: float) -> None:
    for conductor in conductors:
        if conductor.voltage is not None:
            vectors[conductor.name].FV().NumPy()[conductor.number] = factor * conductor.voltage


def _with_other(base: Source, other: Source | None) -> Source:
    """What the base's potential answers to: shifting it shifts both faces, so it sees the charge of both."""
    if base.charge is None or other is None:
        return base
    return Source(charge=base.charge + (other.charge or 0.0))


def _odd(space: Any, odd_planes: tuple[str, ...]) -> Mask:
    odd = np.zeros(space.ndof, bool)
    for axis in odd_planes:
        odd |= plane_mask(space, "xyz".index(axis))
    return odd
