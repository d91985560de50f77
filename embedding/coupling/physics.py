"""The dimensionless statement of a coupled problem: what the residual needs to know, and nothing of the scene file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from embedding.ambient.potential import Electrodes
from embedding.geometry.places import Place
from embedding.shell.laws import Law
from embedding.shell.loads import MechanicalLoads


@dataclass(frozen=True)
class FieldPhysics:
    """The field: electrodes, the shell's relative permittivity (None: not needed), surroundings.

    ``applied`` is the applied field (mesh components), ``odd_planes`` the mirror planes on which the potential is 0.
    """

    electrodes: Electrodes
    contrast: float | None
    applied: tuple[float, ...]
    grounded: bool
    odd_planes: tuple[str, ...]


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
