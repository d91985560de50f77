"""The field's part of the Lagrangian: its co-energy, term by term, for the joint form and for the potential alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ngsolve import CF, VOL, Cof, Det, Grad, InnerProduct, Parameter

from embedding.ambient.energy import field_energy
from embedding.ambient.far import far_field
from embedding.ambient.harmonics import missed_by_robin
from embedding.ambient.motion import AmbientMotion
from embedding.ambient.reduced import Face, face_energy, given_energy
from embedding.ambient.transmission import given_field_energy, shell_field_energy, tapered_field_energy
from embedding.coupling.physics import FieldPhysics, Physics, Solid
from embedding.coupling.unknowns import SIDES, Unknowns
from embedding.geometry.domain import Domain
from embedding.shell.kinematics import Kinematics, surface_gradient


@dataclass(frozen=True)
class Moved:
    """A motion of the ambient and its reference gradient."""

    value: Any
    gradient: Any


class FieldEnergies:
    """Co-energies of the ``field`` for values of the unknowns by name (trial functions or grid functions)."""

    def __init__(
        self,
        domain: Domain,
        physics: Physics,
        field: FieldPhysics,
        unknowns: Unknowns,
        motions: dict[str, AmbientMotion],
        factor: Parameter,
        kinematics: Callable[[dict[str, Any]], Kinematics],
    ) -> None:
        self.domain, self.field, self.unknowns, self.motions = domain, field, unknowns, motions
        self.thickness, self.axial = physics.thickness, physics.axial_stretch
        self.measure = domain.reduction.measure
        self._factor, self._kinematics = factor, kinematics
        uniform = field.applied if field.varying is None else tuple(0.0 for _ in field.applied)
        self._far = far_field(domain, uniform, infinite=field.beyond, level=_at_infinity(domain, field))

    def motion_of(self, face: str, values: dict[str, Any]) -> Moved:
        """What moves the elements beside ``face`` ("t" or "b"), without the ambient's interior motion."""
        parts = [values[name] for name in self.movers(face)]
        return Moved(sum(parts[1:], parts[0]), sum(map(Grad, parts[1:]), Grad(parts[0])))

    def movers(self, face: str) -> list[str]:
        """The unknowns whose sum displaces ``face``."""
        names = [] if face in self.unknowns.opened and not self.domain.open else ["u"]
        return names + ([self.unknowns.moved_by(face)] if face in self.unknowns.opened else [])

    def _on_face(self, face: str, values: dict[str, Any]) -> Moved:
        """Displacement of ``face`` and its surface gradient, on the shell itself."""
        parts = [values[name] for name in self.movers(face)]
        slopes = [surface_gradient(part) for part in parts]
        return Moved(sum(map(_trace, parts[1:]), _trace(parts[0])), sum(slopes[1:], slopes[0]))

    def side_potential_gradient(self, side: str, values: dict[str, Any]) -> Any:
        """Reference gradient of the potential on ``side`` in the elements that touch the shell; a ``shift`` among the
        values comes on top."""
        names = ["phi", *(["jump"] if self.lifts(side, values) else []), *(["shift"] if "shift" in values else [])]
        slopes = [Grad(values[name]) for name in names]
        return sum(slopes[1:], slopes[0])

    def lifts(self, side: str, values: dict[str, Any]) -> bool:
        """Is the potential on ``side`` phi + jump?"""
        return "jump" in values and side == self.field.electrodes.lifted

    def strength(self, side: str, values: dict[str, Any], motion: Any, F: Any) -> Any:
        """E or H on ``side``, where the ambient moves by ``motion`` with the deformation gradient ``F``."""
        strength = -1 * (Cof(F) * self.side_potential_gradient(side, values)) / Det(F)
        if self.field.varying is None:
            return strength
        return strength + self.given_at(self.domain.reduction.position + motion)

    def side_energies(
        self, values: dict[str, Any], side: str, face: Moved, interior: Moved | None = None, *, given: bool = True
    ) -> list[Any]:
        """Field energy of one side: where the shell's motion reaches, and beyond. ``interior`` replaces the present
        motion of the interior. Without ``given`` the square of a varying applied field is left out, which is counted
        beside the shell alone, and which an interior that moves does not change as a whole."""
        interior = interior or self._interior(side)
        near = self._near_energy(values, side, face, interior, given=given)
        return [near, *self._far_energy(values, side, interior)]

    def _near_energy(self, values: dict[str, Any], side: str, face: Moved, interior: Moved, *, given: bool) -> Any:
        domain = self.domain
        moved, slope = face.value + interior.value, face.gradient + interior.gradient
        rest = self.motions[side].rest[side]
        if rest is not None:
            moved, slope = moved - rest, slope - Grad(rest)
        gradient = self.side_potential_gradient(side, values)
        near = field_energy(domain.reduction, moved, slope, gradient, self.axial)
        if self.field.varying is not None and given:
            strength = self.given_at(domain.reduction.position + moved)
            near = near + given_energy(domain.reduction, moved, slope, strength, self.axial)
        return self.field.liquids.get(side, 1.0) * near * domain.volume(domain.near(side))

    def _far_energy(self, values: dict[str, Any], side: str, interior: Moved) -> list[Any]:
        domain, slope, far = self.domain, Grad(values["phi"]), self.domain.far(side)
        if far is None:
            return []
        energy = field_energy(domain.reduction, interior.value, interior.gradient, slope, self.axial)
        return [self.field.liquids.get(side, 1.0) * energy * domain.volume(far)]

    def _interior(self, side: str) -> Moved:
        w = self.motions[side].w
        return Moved(w, Grad(w))

    def moved_energies(
        self, values: dict[str, Any], interior: Callable[[Moved], Moved], *, given: bool = True
    ) -> list[Any]:
        """Co-energy of the ambient with its interior moved by what ``interior`` makes of its present motion; ``given``
        as in :meth:`side_energies`."""
        terms = []
        for name, side in SIDES.items():
            moved = interior(self._interior(side))
            terms += self.side_energies(values, side, self.motion_of(name, values), moved, given=given)
        return terms

    def energies(self, values: dict[str, Any]) -> list[Any]:
        """Every term of the co-energy: both sides, what lies beyond, other bodies, the inside of the shell."""
        return self.touching_energies(values) + self.distant_energies(values)

    def touching_energies(self, values: dict[str, Any]) -> list[Any]:
        """The terms on the shell and in the elements that touch it."""
        return self.near_energies(values) + self.shell_energies(values)

    def distant_energies(self, values: dict[str, Any]) -> list[Any]:
        """The terms in elements that do not touch the shell: they depend on the potential alone, quadratically."""
        if self.field.extent != "surroundings":
            return []
        far = [term for side in SIDES.values() for term in self._far_energy(values, side, self._interior(side))]
        return far + self._far_energies(values) + self._solid_energies(values)

    def near_energies(self, values: dict[str, Any]) -> list[Any]:
        """The terms in the elements of the ambient that touch the shell."""
        if self.field.extent != "surroundings":
            return []
        return [
            self._near_energy(values, side, self.motion_of(name, values), self._interior(side), given=True)
            for name, side in SIDES.items()
        ]

    def shell_energies(self, values: dict[str, Any]) -> list[Any]:
        """The terms on the shell itself."""
        field = self.field
        if field.extent == "given":
            return [self._in_given_field(values) * self.domain.surface()]
        if field.extent == "inside":
            return [self._film(values) * self.domain.surface()]
        terms = [self.through_face(name, values) for name in SIDES] if field.varying is not None else []
        if "jump" in values and (field.matter.contrast is not None or field.matter.remanence is not None):
            terms += self._inside_shell(values)
        return terms

    def through_face(self, name: str, values: dict[str, Any]) -> Any:
        """The mixed part of a varying applied field and the potential, on the face ``name``."""
        domain, field, side = self.domain, self.field, SIDES[name]
        moved = self._on_face(name, values)
        y, gradient = moved.value, moved.gradient
        potential = _trace(values["phi"]) + (_trace(values["jump"]) if self.lifts(side, values) else 0.0)
        potential = potential + (_trace(values["shift"]) if "shift" in values else 0.0)
        face = Face(domain.reduction, domain.normal, y, gradient, self.axial)
        energy = face_energy(domain.reduction, face, potential, self.given_at(domain.reduction.position + y))
        return (1.0 if name == "t" else -1.0) * field.liquids.get(side, 1.0) * energy * domain.potential_surface()

    def given_at(self, place: Any) -> Any:
        """The applied field at a place (mesh components)."""
        field = self.field
        strength = CF(field.applied) if field.varying is None else CF(field.applied) + field.varying(place)
        return self._factor * strength

    def _far_energies(self, values: dict[str, Any]) -> list[Any]:
        field = self.field
        if field.grounded:
            return []
        weight = self.axial * field.liquids.get("outside", 1.0)
        return self._far.terms(values["phi"], self._factor, weight)

    def missed_far_away(self, values: dict[str, Any], reach: float) -> float:
        """What Robin's condition misses of the potential in ``values``, relative; the sources lie within ``reach``."""
        decaying = self._far.decaying(values["phi"], self._factor)
        return missed_by_robin(self.domain, decaying, reach, odd=self.field.odd_planes)

    def _solid_energies(self, values: dict[str, Any]) -> list[Any]:
        """Bodies with a field inside, at rest; a magnet's strength follows the field's factor."""
        terms = []
        for number, body in enumerate(self.field.bodies):
            if isinstance(body, Solid):
                slope = Grad(values["phi"])
                field, energy = -1 * slope, CF(0.0)
                if self.field.varying is not None:
                    given = self.given_at(self.domain.reduction.position)
                    liquid = self.field.liquids.get(self._side_of_body(number), 1.0)
                    field, energy = field + given, liquid * InnerProduct(slope, given)
                energy = energy + 0.5 * body.contrast * InnerProduct(field, field)
                if body.remanence is not None:
                    energy = energy + self._factor * InnerProduct(CF(body.remanence), field)
                terms.append(self.measure * self.axial * energy * self.domain.volume(f"magnet{number}"))
        return terms

    def _side_of_body(self, number: int) -> str:
        """The side of the shell that a solid body stands on."""
        mesh = self.domain.mesh
        beside = mesh.Materials(f"magnet{number}").Neighbours(VOL)
        names = [name for name, there in zip(mesh.GetMaterials(), beside.Mask(), strict=True) if there]
        return "inside" if any(name.startswith("inside") for name in names) else "outside"

    def _inside_shell(self, values: dict[str, Any]) -> list[Any]:
        """The field inside the shell. Between electrodes the jump is one number, and the quadrature is that of the
        elastic energy: in a slack membrane the two stresses cancel, and must do so at every point."""
        domain, electrodes = self.domain, self.field.electrodes
        jump, mean_gradient = self._across(values)
        director = self.opening(values)
        bare = self.measure * self._coenergy(values, jump, mean_gradient, director)
        if electrodes.other is None:
            return [bare * domain.potential_surface()]
        region = domain.patch(electrodes.where)
        terms = [self.measure * self._coenergy(values, jump, mean_gradient) * domain.surface(region)]
        if electrodes.where:
            terms.append(bare * domain.potential_surface(domain.shell - region))
        return terms

    def _across(self, values: dict[str, Any]) -> tuple[Any, Any]:
        """Jump of the potential from bottom to top, and the surface gradient of its mean."""
        sign = 1.0 if self.field.electrodes.lifted == "outside" else -1.0
        half_jump = 0.5 * surface_gradient(values["jump"])
        return sign * _trace(values["jump"]), surface_gradient(values["phi"]) + half_jump

    def opening(self, values: dict[str, Any]) -> Any:
        """Distance of the faces of an open shell over its thickness, which tapers to nothing in its rims; None where
        it does not. In space, too: there it may vanish within an element that has its corners on rims, and the field
        inside the shell is that of its full thickness."""
        if self.domain.mesh.dim == 3 or not self.domain.open or len(self.unknowns.opened) < 2 or "jump" not in values:
            return None
        return (_trace(values["o_t"]) - _trace(values["o_b"])) / self.thickness

    def pull_inside(self, values: dict[str, Any]) -> Any | None:
        """Derivative of the co-energy inside the shell in the place of its top face, per reference area; None where it
        does not depend on it."""
        director, electrodes = self.opening(values), self.field.electrodes
        if director is None or (electrodes.other is not None and not electrodes.where):
            return None
        energy = self._coenergy(values, *self._across(values), director) / self.thickness
        axes = np.eye(self.domain.mesh.dim)
        pull = CF(tuple(energy.Diff(director, CF(tuple(axis))) for axis in axes))
        return pull if electrodes.other is None else (1.0 - self.domain.covered(electrodes.where)) * pull

    def _film(self, values: dict[str, Any]) -> Any:
        """The field between two electrodes, constant over the surface they cover."""
        electrodes = self.field.electrodes
        covered = self.domain.covered(electrodes.where) if electrodes.where else 1.0
        sign = 1.0 if electrodes.lifted == "outside" else -1.0
        no_gradient = CF((0.0,) * self.domain.mesh.dim)
        return self.measure * self._coenergy(values, sign * covered * values["jump"], no_gradient)

    def _coenergy(self, values: dict[str, Any], jump: Any, mean_gradient: Any, director: Any | None = None) -> Any:
        """Co-energy per reference area inside the shell, or between faces opened by ``director`` thicknesses."""
        matter, thickness, kinematics = self.field.matter, self.thickness, self._kinematics(values)
        given = self._given_here(values) if self.field.varying is not None else None
        if director is None:
            return shell_field_energy(kinematics, thickness, matter, jump, mean_gradient, given)
        medium = self.field.liquids.get("outside", 1.0)
        return tapered_field_energy(kinematics, director, thickness, matter, jump, mean_gradient, given, medium)

    def _in_given_field(self, values: dict[str, Any]) -> Any:
        kinematics, thickness = self._kinematics(values), self.thickness
        medium = self.field.liquids.get("outside", 1.0)
        given = self._given_here(values)
        return self.measure * given_field_energy(kinematics, thickness, self.field.matter, given, medium)

    def _given_here(self, values: dict[str, Any]) -> Any:
        return self.given_at(self.domain.reduction.position + _trace(values["u"]))


def _at_infinity(domain: Domain, field: FieldPhysics) -> float:
    """The potential far away: that of a half-space, or 0."""
    for body, source in zip(domain.sizes.bodies, field.conductors, strict=True):
        if body.kind == "half-space" and source is not None and source.voltage is not None:
            return source.voltage
    return 0.0


def _trace(value: Any) -> Any:
    return value.Trace() if hasattr(value, "Trace") else value
