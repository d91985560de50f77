"""The dimensionless statement of a coupled problem: what the residual needs to know, and nothing of the scene file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from embedding.ambient.sources import Electrodes, Source
from embedding.ambient.transmission import Matter
from embedding.geometry.places import Place
from embedding.shell.laws import Law
from embedding.shell.loads import MechanicalLoads

Extent = Literal["surroundings", "inside", "given"]


@dataclass(frozen=True)
class Solid:
    """A rigid body with a field inside: its relative permittivity or permeability, and its remanence (or None)."""

    contrast: float
    remanence: tuple[float, ...] | None = None


@dataclass(frozen=True)
class FieldPhysics:
    """The field, dimensionless.

    ``extent`` says what of it is modelled: the potential in the ``surroundings``; only the field ``inside`` the shell,
    between its electrodes; or the ``given`` applied field alone, as if the shell did not change it. ``matter`` is the
    shell's, ``applied`` the uniform applied field (mesh components), ``varying`` one that depends on the place: a
    function from a position (mesh components) to a field. ``bodies`` are the conductors and solids beside the shell,
    in the order of the mesh's, ``liquids`` the contrasts of what fills the space, by side. ``odd_planes`` are the
    mirror planes on which the potential is 0. ``beyond``: space goes on beyond the outer boundary as a mapped region.
    """

    electrodes: Electrodes
    matter: Matter
    applied: tuple[float, ...]
    grounded: bool
    odd_planes: tuple[str, ...]
    extent: Extent = "surroundings"
    varying: Callable[[Any], Any] | None = None
    bodies: tuple[Source | Solid, ...] = ()
    liquids: Mapping[str, float] = field(default_factory=dict)
    beyond: bool = False

    @property
    def conductors(self) -> tuple[Source | None, ...]:
        """The source of each body that is a conductor, None for each that is not."""
        return tuple(body if isinstance(body, Source) else None for body in self.bodies)

    @property
    def driven(self) -> bool:
        """Is there anything that the field's factor scales?"""
        sources = [self.electrodes.top, self.electrodes.bottom, *self.conductors]
        given = any(source is not None and source.strength != 0.0 for source in sources)
        return given or any(self.applied) or self.varying is not None


@dataclass(frozen=True)
class Physics:
    """The shell, its loads and supports, and the field around it; lengths in shell sizes, stresses in shear moduli.

    ``thickness`` is a number, or a coefficient function of the reference where it varies. ``supports`` lists the
    (where, component) pairs that are held, ``prescribed`` those of them that are held at a displacement, its third
    entry; where is an edge, a face, "surface" or a point in mesh coordinates. ``clamped`` names the edges about which
    the shell cannot turn. ``opened`` names the faces ("t", "b") that are placed at their true positions; the others
    count as lying at the mid-surface. With ``bending`` the shell resists it; ``locking_cured`` says whether membrane
    strains are interpolated for it.
    """

    law: Law
    thickness: Any
    loads: MechanicalLoads
    supports: tuple[tuple[Place, int], ...]
    axial_free: bool
    axial_stretch: float
    volume_controlled: bool
    opened: tuple[str, ...]
    field: FieldPhysics | None
    prescribed: tuple[tuple[Place, int, float], ...] = ()
    clamped: tuple[str, ...] = ()
    bending: bool = False
    locking_cured: bool = False
