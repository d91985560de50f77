"""The unknowns of a coupled problem, by name: one product space, its free unknowns, trial and test functions.

===========  ===================================================================
name         unknown
===========  ===================================================================
u            displacement of the mid-surface
y_t, y_b     displacement of the top and bottom face (opened interface of a closed shell)
o_t, o_b     displacement of a face from the mid-surface (opened interface of an open shell)
moment       bending moments (on a curve: q, see shell/bending/curve.py)
rotation     rotations of the edges of the surface's elements
tau_t, tau_b multipliers of the faces' places, minus the face tractions
phi, jump    potential and its jump
pressure     p_t - p_b under volume control
axial        axial stretch of an infinite cylinder with free ends
rigid        multipliers that hold free rigid motions
===========  ===================================================================

The faces of an open shell meet in its rim, where o_t and o_b vanish. Those of a closed shell share nothing, and the
mid-surface need not reach into the ambient: a third of the unknowns less in each element that touches the shell.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, COUPLING_TYPE, FESpace, GridFunction, NumberSpace

from embedding.ambient.motion import symmetry_components
from embedding.ambient.potential import FilmPotential, PotentialSpaces
from embedding.coupling.physics import Physics
from embedding.geometry.domain import Domain
from embedding.geometry.ends import directions, facets_named
from embedding.geometry.places import Place, unknowns_at
from embedding.geometry.spaces import Mask, TraceSpace, as_bits, plane_mask
from embedding.shell.batched import supported
from embedding.shell.bending import CurveBending, Stiffness, SurfaceBending
from embedding.timing import part

FACES = ("t", "b")
SIDES = {"t": "outside", "b": "inside"}


class Unknowns:
    """Named components of the coupled product space, with the state vector and the mask of free unknowns."""

    @part("spaces")
    def __init__(self, domain: Domain, physics: Physics) -> None:
        self.domain = domain
        field = physics.field
        surrounded = field is not None and field.extent == "surroundings"
        self.faces = FACES if surrounded else ()
        self.opened = physics.opened if surrounded else ()
        self.potential = _potential(domain, physics)
        self.bending = _bending(domain, physics)
        self.trace = _displacement(domain, self._reach_of_u())
        self.face_free = self.trace.free  # supports hold the mid-surface; the faces only know symmetry
        _support(domain, self.trace, physics.supports)
        self._parts: dict[str, tuple[Any, Mask]] = {"u": (self.trace.space, self.trace.free)}
        self.face_spaces = {face: self._face_space(face) for face in self.faces}
        if domain.open:
            rim = self.trace.on_shell(domain.rim_dofs(self.trace.scalar))
            self.face_free = self.face_free & ~np.tile(rim, self.trace.components)
        for face in self.opened:
            self._parts[self.moved_by(face)] = (self.face_spaces[face], self.face_free)
            self._parts[f"tau_{face}"] = (self.trace.space, self.face_free)
        if self.potential is not None:
            for name, space in self.potential.spaces.items():
                self._parts[name] = (space, self.potential.free[name])
        self._parts |= self.bending.parts() if self.bending is not None else {}
        numbers = ["pressure"] * physics.volume_controlled + ["axial"] * physics.axial_free
        self.rigid = free_rigid_motions(domain, self.trace, physics.clamped if physics.bending else ())
        self.numbers = (*numbers, *(f"rigid{i}" for i in range(len(self.rigid))))
        for name in self.numbers:
            self._parts[name] = (NumberSpace(domain.mesh, definedon=domain.shell), np.ones(1, bool))
        self.names = tuple(self._parts)
        ends = np.cumsum([0, *(space.ndof for space, _ in self._parts.values())]).tolist()
        self._ranges = {name: slice(*pair) for name, pair in zip(self.names, pairwise(ends), strict=True)}
        self.space = FESpace([space for space, _ in self._parts.values()])
        self.condensed = self._condense(physics)
        self.state = GridFunction(self.space)
        self.trial = dict(zip(self.names, self.space.TrialFunction(), strict=True))
        self.test = dict(zip(self.names, self.space.TestFunction(), strict=True))

    def moved_by(self, face: str) -> str:
        """Name of the unknown that carries an opened ``face`` ("t" or "b"): its displacement, or that from u."""
        return f"o_{face}" if self.domain.open else f"y_{face}"

    def _face_space(self, face: str) -> Any:
        """The space of what moves the elements on the side of ``face``."""
        if face in self.opened or self.domain.open:
            return self.trace.reaching(self.domain.materials(SIDES[face]))
        return self.trace.space

    def _reach_of_u(self) -> str:
        """u itself moves the ambient only where a face lies at the mid-surface, and around an open shell."""
        closed = [face for face in self.faces if face not in self.opened]
        if self.faces and self.domain.open:
            return ""
        return {0: "shell", 1: self.domain.materials(SIDES[closed[0]]) if closed else "", 2: ""}[len(closed)]

    def displacement(self, face: str, out: Any) -> None:
        """Write the present displacement of ``face`` into ``out``, a vector of the shell's displacement space."""
        values = out.FV().NumPy()
        values[:] = self.field("u").vec.FV().NumPy() if self.domain.open or face not in self.opened else 0.0
        if face in self.opened:
            values += self.field(self.moved_by(face)).vec.FV().NumPy()

    def _condense(self, physics: Physics) -> Mask | None:
        """Mark the unknowns that are eliminated element by element; all others stay in the global system.

        Beside volume elements NGSolve does not eliminate what belongs to surface elements; our own assembly does.
        """
        name = self.bending.condensed if self.bending is not None else None
        if name is None or (self.faces and not assembled_in_batches(self.domain, physics)):
            return None
        mask = np.zeros(self.space.ndof, bool)
        mask[self.range(name)] = True
        for number in np.flatnonzero(~mask):
            if self.space.CouplingType(int(number)) == COUPLING_TYPE.LOCAL_DOF:
                self.space.SetCouplingType(int(number), COUPLING_TYPE.INTERFACE_DOF)
        return mask

    def __contains__(self, name: str) -> bool:
        return name in self._parts

    def field(self, name: str) -> Any:
        """The grid function of component ``name`` of the state."""
        return self.state.components[self.names.index(name)]

    def range(self, name: str) -> slice:
        """Where the unknowns of ``name`` lie in the state vector."""
        return self._ranges[name]

    def free(self, held: tuple[str, ...] = ()) -> Any:
        """Bits of the free unknowns; components named in ``held`` count as prescribed."""
        masks = [mask & (name not in held) for name, (_, mask) in self._parts.items()]
        return as_bits(np.concatenate(masks))

    @property
    def count(self) -> dict[str, int]:
        """Number of free unknowns by name."""
        return {name: int(mask.sum()) for name, (_, mask) in self._parts.items()}


def _potential(domain: Domain, physics: Physics) -> PotentialSpaces | FilmPotential | None:
    field = physics.field
    if field is None or field.extent == "given":
        return None
    if field.extent == "inside":
        return FilmPotential(domain, field.electrodes)
    return PotentialSpaces(
        domain,
        field.electrodes,
        field.conductors,
        grounded=field.grounded,
        applied=field.applied,
        odd_planes=field.odd_planes,
    )


def assembled_in_batches(domain: Domain, physics: Physics) -> bool:
    """Are the elastic energies of the shell assembled many elements at once?

    Moments on edges bring terms in which the unknown moments meet other unknowns; they are left to NGSolve.
    """
    return physics.bending and not physics.loads.edge_moments and supported(domain, physics.law)


def _bending(domain: Domain, physics: Physics) -> SurfaceBending | CurveBending | None:
    if not physics.bending:
        return None
    kind = SurfaceBending if domain.mesh.dim == 3 else CurveBending
    return kind(domain, Stiffness(physics.law, physics.thickness), physics.clamped, physics.loads.edge_moments)


def _displacement(domain: Domain, reach: str) -> TraceSpace:
    """Displacement space of the mid-surface with what symmetry and the axis hold."""
    trace = TraceSpace(domain.mesh, domain.sizes.order, reach=reach)
    for axis in symmetry_components(domain):
        trace.fix(axis, plane_mask(trace.scalar, axis))
    return trace


def _support(domain: Domain, trace: TraceSpace, supports: tuple[tuple[Place, int], ...]) -> None:
    for place, component in supports:
        trace.fix(component, unknowns_at(domain, trace.scalar, place))


def free_rigid_motions(domain: Domain, trace: TraceSpace, clamped: tuple[str, ...] = ()) -> list[Any]:
    """Rigid motions that the supports and mirror planes leave free, as coefficient functions of shape (d,)."""
    motions = domain.reduction.rigid_motions()
    held = ~trace.free
    if not motions or not (held.any() or clamped):
        return motions
    field = GridFunction(trace.space)
    columns = []
    for motion in motions:
        field.Set(motion, BND, definedon=domain.shell)
        columns.append(np.array(field.vec.FV().NumPy())[held])
    turns = _held_axes(domain, clamped) @ domain.reduction.rotations().T
    _, sizes, rows = np.linalg.svd(np.concatenate([np.array(columns).T, turns]), full_matrices=True)
    rank = int((sizes > 1e-6 * max(1.0, sizes.max(initial=0.0))).sum())
    free = rows[rank:]
    return [sum((float(c) * m for c, m in zip(row, motions, strict=True)), 0 * motions[0]) for row in free]


def _held_axes(domain: Domain, clamped: tuple[str, ...]) -> npt.NDArray[np.float64]:
    """Unit vectors about which the shell cannot turn, where its rotation is held; shape (n, 3)."""
    facets = facets_named(domain.facets, clamped)
    return np.tile([0.0, 0.0, 1.0], (len(facets), 1)) if domain.mesh.dim == 2 else directions(domain.facets, facets)
