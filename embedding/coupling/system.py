"""A coupled problem ready to be solved: state, forms and the operations a Newton step is made of."""

from __future__ import annotations

from contextlib import nullcontext
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from ngsolve import BND, GridFunction, InnerProduct

from embedding.ambient.inverse import Linear
from embedding.ambient.motion import AmbientMotion
from embedding.coupling.distant import Distant
from embedding.coupling.elementwise import form_of
from embedding.coupling.following import Following
from embedding.coupling.iterative import JointSolver, far_unknowns
from embedding.coupling.joint import joint_form_of
from embedding.coupling.lagrangian import OFFSET, Factors, Lagrangian
from embedding.coupling.linear import DirectSolver, LinearSolver
from embedding.coupling.physics import Physics
from embedding.coupling.potential_form import PotentialForm
from embedding.coupling.potential_solve import PotentialSolve
from embedding.coupling.resultants import resultants
from embedding.coupling.tractions import FaceTractions
from embedding.coupling.unknowns import SIDES, Unknowns
from embedding.coupling.work import LoadWork
from embedding.geometry.domain import Domain
from embedding.geometry.places import displaced
from embedding.geometry.spaces import Mask
from embedding.shell.point_loads import point_load_vector
from embedding.threads import shared
from embedding.timing import part

if TYPE_CHECKING:
    from scipy import sparse

Memory = dict[str, Any]
"""Named numbers and arrays, lists and tables of them: what a part of a run goes on from."""
FEW = 100
"""Most unknowns at which the inverse is told: a solve for each takes as long as one more step of Newton's method."""
SADDLE = ("moment", "pressure", "tau_t", "tau_b", "phi", "jump")
"""Unknowns in which the Lagrangian is stationary but not least: each brings one negative eigenvalue to its matrix."""


class System:
    """The coupled shell, field and moving ambient on one mesh, with its present state.

    All quantities are dimensionless. The state is ``unknowns.state`` plus the ambient's interior motion.
    """

    @part("forms")
    def __init__(self, domain: Domain, physics: Physics, linear: Linear = "auto") -> None:
        self.domain, self.physics = domain, physics
        self.factors = Factors()
        self.unknowns = Unknowns(domain, physics)
        self.motions = self._ambient_motions(linear)
        self.lagrangian = Lagrangian(domain, physics, self.unknowns, self.motions, self.factors)
        if "axial" in self.unknowns:
            self.unknowns.field("axial").vec[0] = 1.0
        self.place_faces()  # before any form is evaluated: between faces that coincide there is no field
        self.form, self.potential = self._forms(linear)
        self.tractions = {face: FaceTractions(self.lagrangian, face) for face in self.unknowns.faces}
        self.following: Following | None = None
        if self.lagrangian.field is not None and domain.open and self.motions:
            motion = self.motions[SIDES["t"]]
            self.following = Following(domain, self.lagrangian.field, self.unknowns, motion)
        self.resultants = resultants(self.lagrangian, self.following) if self.motions else {}
        self._point_forces = point_load_vector(domain, self.unknowns.trace, physics.loads)
        self.load_work = LoadWork(self.lagrangian, self._point_forces)
        self._displaced = displaced(domain, self.unknowns.trace, physics.prescribed)
        self._update = GridFunction(self.unknowns.trace.space)
        self._held: tuple[str, ...] = ()
        self._solver = self._linear_solver(())
        self._measured = self._linearised = self._displacement
        self._guessed = self._continued = self.lagging = False
        self.residual()  # NGSolve differentiates an interpolation wrongly until it has been evaluated once

    def _forms(self, linear: Linear) -> tuple[Any, PotentialSolve | None]:
        """The joint form, and what solves for the potential alone."""
        lagrangian = self.lagrangian
        if self.unknowns.potential is None:
            return form_of(lagrangian), None
        distant = Distant(lagrangian) if "phi" in self.unknowns else None
        alone = PotentialForm(lagrangian, distant)
        joint = form_of(lagrangian) if distant is None else joint_form_of(lagrangian, distant, alone)
        return joint, PotentialSolve(lagrangian, alone, linear)

    def _ambient_motions(self, linear: Linear) -> dict[str, AmbientMotion]:
        """The motion of each side; around an open shell both sides are one space with one motion."""
        faces = {SIDES[face]: space for face, space in self.unknowns.face_spaces.items()}
        if self.domain.open and faces:
            return dict.fromkeys(faces, AmbientMotion(self.domain, faces, linear))
        return {side: AmbientMotion(self.domain, {side: space}, linear) for side, space in faces.items()}

    @property
    def _different_motions(self) -> list[AmbientMotion]:
        return list({id(motion): motion for motion in self.motions.values()}.values())

    def place_faces(self) -> None:
        """Put the opened faces where the present displacement of the mid-surface has them."""
        values = {name: self.unknowns.field(name) for name in self.unknowns.names}
        director = self.lagrangian.kinematics(values).director
        for face in self.unknowns.opened:
            y = self.unknowns.field(self.unknowns.moved_by(face))
            place = OFFSET[face] * self.physics.thickness * director
            place = place if self.domain.open else values["u"] + place
            y.Set(place, BND, definedon=self.domain.shell)
            y.vec.FV().NumPy()[~self.unknowns.face_free] = 0.0

    def load(self, mechanical: float, field: float, volume: float | None, pressure: float | None = None) -> None:
        """Set the load factors, and move what is held at a displacement.

        Where the path controls the volume somewhere, p_t - p_b is an unknown: free when ``volume`` (a ratio) is
        given, else held at ``pressure``.
        """
        self.factors.mechanical.Set(mechanical)
        where, displacements = self._displaced
        self.unknowns.field("u").vec.FV().NumPy()[where] = mechanical * displacements
        self.factors.field.Set(field)
        held: tuple[str, ...] = ()
        if "pressure" in self.unknowns:
            if volume is None:
                held = ("pressure",)
                self.unknowns.field("pressure").vec[0] = pressure
            else:
                self.factors.volume.Set(volume)
        if held != self._held:
            self._held = held
            self._solver = self._linear_solver(held)
        if self.potential is not None:
            self.potential.prescribe(field)

    def _linear_solver(self, held: tuple[str, ...]) -> LinearSolver:
        free, potential, condensed = self.unknowns.free(held), self.potential, self.unknowns.condensed
        if potential is None or potential.iterative is None:
            return DirectSolver(free, symmetric=self.symmetric, condensed=condensed)
        return JointSolver(
            free,
            symmetric=self.symmetric,
            far=far_unknowns(self.unknowns),
            potential=self.unknowns.range("phi"),
            cycle=potential.cycle,
            condensed=condensed,
        )

    @property
    def free(self) -> Mask:
        """Marks the free unknowns of the joint system."""
        return self._solver.mask

    @property
    def free_count(self) -> int:
        """Number of free unknowns of the joint system."""
        return int(self._solver.mask.sum())

    @property
    def iterations(self) -> tuple[int, int]:
        """Iterations of the last linear solves, of the potential alone and of the joint system; 0 for direct ones."""
        potential = self.potential.iterative if self.potential is not None else None
        joint = self._solver if isinstance(self._solver, JointSolver) else None
        alone, together = (solver.iterations[-1:] if solver is not None else [] for solver in (potential, joint))
        return sum(alone), sum(together)

    @part("motion")
    def follow(self) -> bool:
        """Let the ambient's mesh follow the faces; False if elements would turn over."""
        places = self._places()
        return all(motion.follow(places) for motion in self._different_motions)

    def ambient_as_in(self, other: System) -> None:
        """Let the interior of the ambient be where ``other``, on the same mesh and in the same state, has it."""
        places = self._places()
        for motion, known in zip(self._different_motions, other._different_motions, strict=True):
            motion.continue_from(known, places)

    def _places(self) -> dict[str, npt.NDArray[np.float64]]:
        """Displacements of the faces by side."""
        places = {}
        for face in self.unknowns.faces:
            self.unknowns.displacement(face, self.tractions[face].displacement.vec)
            places[SIDES[face]] = np.array(self.tractions[face].displacement.vec.FV().NumPy())
        return places

    @property
    def present(self) -> npt.NDArray[np.float64]:
        """A copy of the unknowns (n,) of the present state; they can be set."""
        return np.array(self.unknowns.state.vec.FV().NumPy())

    @present.setter
    def present(self, unknowns: npt.NDArray[np.float64]) -> None:
        self.unknowns.state.vec.FV().NumPy()[:] = unknowns

    @property
    def _displacement(self) -> npt.NDArray[np.float64]:
        return np.array(self.unknowns.field("u").vec.FV().NumPy())

    @part("residual")
    def residual(self) -> Any:
        """Internal minus external forces at the present state and load, a new vector."""
        self._measure_rotations()
        residual = self.unknowns.state.vec.CreateVector()
        self.form.Apply(self.unknowns.state.vec, residual)
        if self.physics.loads.point_forces:
            forces = self.factors.mechanical.Get() * self._point_forces
            residual.FV().NumPy()[self.unknowns.range("u")] -= forces
        if self.potential is not None:
            for name, number, charge in self.potential.charges_given():
                residual.FV().NumPy()[self.unknowns.range(name).start + number] += charge
        if self.following is not None:
            self.following.add_to(residual)
        return residual

    def support_work(self) -> float | None:
        """What the reactions of supports that move do on all of the displacement given to them; None without any."""
        where, displacements = self._displaced
        return float(self.residual().FV().NumPy()[where] @ displacements) if len(where) else None

    def _measure_rotations(self) -> None:
        """Let bending measure rotations from the present state, if it has moved. The equilibrium is the same for any
        choice, but rotations must stay small as seen from it."""
        present = self._displacement
        if self.unknowns.bending is not None and not np.array_equal(present, self._measured):
            values = {name: self.unknowns.field(name) for name in self.unknowns.names}
            self.unknowns.bending.refresh(self.lagrangian.kinematics(values))
            self._measured = present

    @part("matrix")
    def linearise(self) -> None:
        """Assemble the tangent at the present state and load, for :meth:`solve`."""
        vector, membrane = self.unknowns.state.vec, self.lagrangian.membrane
        present = self._displacement
        led: Any = nullcontext()
        if membrane is not None:
            led = membrane.extrapolating(
                present - self._linearised, guessed=self._guessed, continued=self._continued
            )
        with led, shared():
            self.form.AssembleLinearization(vector)
        self.lagging = self._guessed and membrane is not None
        self._linearised, self._guessed, self._continued = present, False, True
        self._solver.factor(self.form)
        if self.following is not None:
            self.following.linearise()

    def guess(self) -> None:
        """The present state is a guess: let the stress of the next tangent be that of the state it was made from."""
        self._guessed, self._continued = True, False

    def begin(self) -> None:
        """What is solved next begins at the present state, with its own stress."""
        self._continued = False

    def forget(self) -> None:
        """Let the next tangent be that of its state alone."""
        self._linearised, self._guessed, self._continued = self._displacement, False, False

    def solve(self, right_side: Any, enough: float = 0.0) -> Any:
        """Solve with the tangent of the last :meth:`linearise`, all of it. What iterates may leave the part ``enough``.

        Raises:
            LinearSolverError: the tangent is singular.
        """
        update = self._solver.solve(right_side, enough)
        return update if self.following is None else self.following.complete(self._solver, update)

    @property
    def more_negative(self) -> int:
        """Negative eigenvalues that the whole tangent has more than the matrix of :meth:`tangent`."""
        return 0 if self.following is None else self.following.more_negative(self._solver)

    def tangent(self) -> tuple[sparse.csc_array, Mask]:
        """The tangent of the last :meth:`linearise` on its free unknowns, condensed, and which of them are numbers."""
        numbers = np.zeros(len(self._solver.mask), bool)
        for name in self.unknowns.names:
            where = self.unknowns.range(name)
            numbers[where] = name in self.unknowns.numbers
        return self._solver.matrix(), numbers[self._solver.kept]

    def free_in(self, name: str) -> int:
        """Number of the unknowns of ``name`` that are free at the present load."""
        return int(self._solver.mask[self.unknowns.range(name)].sum()) if name in self.unknowns else 0

    def inverse_at(self, *names: str) -> npt.NDArray[np.float64] | None:
        """The block (n, n) of the tangent's inverse at the free unknowns of ``names``, with a solve for each; None
        where there are no factors of the whole tangent, or more than ``FEW`` such unknowns.

        Raises:
            LinearSolverError: the tangent is singular.
        """
        free = self._solver.mask
        where = [np.arange(free.size)[self.unknowns.range(name)] for name in names if name in self.unknowns]
        numbers = np.concatenate(where)
        numbers = numbers[free[numbers]]
        solver, whole = self._solver, self.unknowns.condensed is None and self.following is None
        return solver.block(numbers) if whole and isinstance(solver, DirectSolver) and len(numbers) <= FEW else None

    @property
    def saddle_count(self) -> int:
        """Negative eigenvalues that the tangent of a stable shell has: one for each free unknown in ``SADDLE`` that is
        not condensed out, and for each multiplier of a rigid motion.

        The anchors of the faces change none: per unit of area y and tau meet in [[k - a, -1], [-1, a]], with k from
        the field and a the anchor, whose determinant is negative as long as k < 1 / a, a million shear moduli per
        shell size.
        """
        kept = self._solver.kept
        counted = [name for name in SADDLE if name in self.unknowns]
        return sum(int(kept[self.unknowns.range(name)].sum()) for name in counted) + len(self.unknowns.rigid)

    def newton_update(self, enough: float = 0.0) -> tuple[Any, float]:
        """Solve the linearised joint system, up to the part ``enough`` where that takes iterations; returns the step to
        add and its decrement.

        Raises:
            LinearSolverError: the tangent is singular.
        """
        residual = self.residual()
        self.linearise()
        step = self.solve(residual, enough)
        step *= -1.0
        return step, self.decrement(residual, step)

    def decrement(self, residual: Any, step: Any) -> float:
        """sqrt(|residual . step| / (T A)): an energy norm per shear modulus and shell volume."""
        work = float(np.dot(*(vector.FV().NumPy()[self._solver.mask] for vector in (residual, step))))
        return float(np.sqrt(abs(work) / self.shell_volume))

    @cached_property
    def shell_volume(self) -> float:
        """Reference volume of the shell itself, dimensionless (plane strain: per length); found once."""
        return self.domain.shell_integral(self.physics.thickness)

    @property
    def symmetric(self) -> bool:
        """Do all loads have a potential, so that the Newton matrix is symmetric?"""
        return self.lagrangian.symmetric

    @property
    def min_jacobian(self) -> float:
        """Smallest det F of the moving ambient (1 where there is none)."""
        return min((motion.min_jacobian for motion in self._different_motions), default=1.0)

    def displacement_norm(self, vector: Any) -> float:
        """Root mean square over the shell of the displacement part of a state-sized ``vector``, in shell sizes."""
        self._update.vec.FV().NumPy()[:] = vector.FV().NumPy()[self.unknowns.range("u")]
        squared = self.domain.shell_integral(InnerProduct(self._update, self._update))
        return float(np.sqrt(squared / self.domain.area))

    def save(self) -> Memory:
        """A copy of the whole state as named arrays, for :meth:`restore`: all unknowns, the motions of the ambient,
        what bending measures rotations from (None without bending)."""
        bending = self.unknowns.bending
        return {
            "unknowns": self.present,
            "motions": [motion.save() for motion in self._different_motions],
            "turned": None if bending is None else bending.memory,
        }

    def restore(self, saved: Memory) -> None:
        """Go back to a state returned by :meth:`save`."""
        self._put(saved)
        if self.unknowns.bending is not None:
            self._measured = self._linearised = self._displacement
        self._guessed = self._continued = False

    def _put(self, saved: Memory) -> None:
        self.present = saved["unknowns"]
        if self.unknowns.bending is not None:
            self.unknowns.bending.memory = saved["turned"]
        for motion, kept in zip(self._different_motions, saved["motions"], strict=True):
            motion.restore(kept)

    def memory(self) -> Memory:
        """The state, and all else that what is solved next depends on to the last bit: matrices at hand and the
        displacements that rotations and stresses are seen from. ``ranges`` tells where each unknown begins and ends."""
        membrane = self.lagrangian.membrane
        return self.save() | {
            "ranges": {name: [where.start, where.stop] for name, where in self._ranges()},
            "assembled": [motion.memory() for motion in self._different_motions],
            "measured": None if self.unknowns.bending is None else self._measured,
            "linearised": None if membrane is None else self._linearised,
        }

    def _ranges(self) -> list[tuple[str, slice]]:
        return [(name, self.unknowns.range(name)) for name in self.unknowns.names]

    def recall(self, memory: Memory) -> None:
        """Go on from what :meth:`memory` returned, at the same load."""
        self._put(memory)
        for motion, assembled in zip(self._different_motions, memory["assembled"], strict=True):
            motion.recall(assembled)
        if memory["measured"] is not None:
            self._measured = memory["measured"]
        if memory["linearised"] is not None:
            self._linearised = memory["linearised"]
        self._guessed = self._continued = False
