"""Face tractions: p_t and p_b, and the tangential tractions, as fields on the shell.

The derivative of the ambient's Lagrangian with respect to the face's displacement is minus the force on the face. With
the interface opened it is an unknown of the Newton system (tau); closed, it is recovered from the nodal forces of each
side with the shell's mass matrix. Per reference area the traction is -tau; with m = cof(F_face) N the face's area
vector,

    p_t = tau_t . m_t / (m_t . m_t),     p_b = - tau_b . m_b / (m_b . m_b),

so that a pressure pushes on its face: along -n at the top, along +n at the bottom. Around an open shell tau has a part
more, from the field inside the shell, which is taken off. Source: theory pages, "Face tractions" and "Open shells".
"""

from __future__ import annotations

from typing import Any

from ngsolve import BilinearForm, Grad, GridFunction, InnerProduct, Variation, sqrt

from embedding.coupling.field import Moved
from embedding.coupling.lagrangian import Lagrangian
from embedding.coupling.unknowns import SIDES
from embedding.geometry.spaces import TraceSpace, as_bits
from embedding.shell.kinematics import Kinematics
from embedding.threads import factored

SIGN = {"t": 1.0, "b": -1.0}


class FaceTractions:
    """The field's traction on face ``face`` ("t" or "b") in the present state: ``total`` is minus it, per reference
    area."""

    def __init__(self, lagrangian: Lagrangian, face: str) -> None:
        unknowns, domain = lagrangian.unknowns, lagrangian.domain
        self.face = face
        self._domain, self._unknowns = domain, unknowns
        opened = face in unknowns.opened
        self.displacement = GridFunction(unknowns.trace.space)
        self.tau = unknowns.field(f"tau_{face}") if opened else GridFunction(unknowns.face_spaces[face])
        self._recovery = None if opened else NodalForces(lagrangian, face)
        self._flux: FaceFlux | None = None
        self.total = self.tau
        if opened and lagrangian.field is not None:
            # The faces' multipliers of an open shell carry what the field inside it does on them, too.
            pull = lagrangian.field.pull_inside({name: unknowns.field(name) for name in unknowns.names})
            self.total = self.tau if pull is None else self.tau + SIGN[face] * pull
        if lagrangian.field is not None and lagrangian.field.field.varying is not None:
            self._flux = FaceFlux(lagrangian, face)
            given = lagrangian.field.given_at(domain.reduction.position + self.displacement)
            self.total = self.total - self._flux.flux * given
        self.kinematics = Kinematics(
            domain.reduction, domain.normal, self.displacement, lagrangian.physics.axial_stretch
        )
        self._pressure = self.pressure()

    def refresh(self) -> None:
        """Bring the face's displacement and ``tau`` up to date with the state."""
        self._unknowns.displacement(self.face, self.displacement.vec)
        if self._recovery is not None:
            self._recovery.recover(self.tau)
        if self._flux is not None:
            self._flux.refresh()

    def pressure(self, kinematics: Kinematics | None = None) -> Any:
        """p_t or p_b, dimensionless; ``kinematics`` replaces the face's own (for evaluation on the axis)."""
        k = kinematics or self.kinematics
        return SIGN[self.face] * InnerProduct(self.total, k.area_vector) / k.surface_stretch_squared

    def tangential(self, kinematics: Kinematics | None = None) -> Any:
        """Tangential traction vector per deformed face area, dimensionless, shape (d,)."""
        k = kinematics or self.kinematics
        normal_part = InnerProduct(self.total, k.area_vector) / k.surface_stretch_squared
        return -1 * (self.total - normal_part * k.area_vector) / sqrt(k.surface_stretch_squared)

    def mean_pressure(self) -> float:
        """Mean of the pressure over the reference mid-surface."""
        return self._domain.shell_integral(self._pressure) / self._domain.area


class NodalForces:
    """Traction of one side of a closed interface: nodal forces of the side's field energy over the mass matrix."""

    def __init__(self, lagrangian: Lagrangian, face: str) -> None:
        unknowns, domain, field = lagrangian.unknowns, lagrangian.domain, lagrangian.field
        if field is None:
            raise RuntimeError("this scene has no field")
        space = unknowns.face_spaces[face]
        motion = space.TrialFunction()
        values = {name: unknowns.field(name) for name in unknowns.names if name in ("phi", "jump")}
        self._force = BilinearForm(space)
        for term in field.side_energies(values, SIDES[face], Moved(motion, Grad(motion))):
            self._force += Variation(-1 * term).Compile()
        mass = BilinearForm(space, symmetric=True)
        trial, test = space.TnT()
        mass += domain.reduction.measure * InnerProduct(trial.Trace(), test.Trace()) * domain.surface()
        mass.Assemble()
        self._mass = mass
        self._inverse = factored(mass.mat, as_bits(unknowns.face_free))
        self._displacement = unknowns.field("u")

    def recover(self, tau: GridFunction) -> None:
        """Write the recovered tau into the grid function ``tau``."""
        forces = tau.vec.CreateVector()
        self._force.Apply(self._displacement.vec, forces)
        tau.vec.data = self._inverse * forces


class FaceFlux:
    """How the co-energy of one side answers to the potential of its face, per reference area: ``flux``, b . m on the
    top, - b . m on the bottom.

    Where the applied field varies, the face's multiplier is the derivative of that co-energy at a fixed potential of
    the change. At a fixed potential of the whole, which the traction is, comes minus the flux times the applied field
    on top; the field inside the shell carries the difference.
    """

    def __init__(self, lagrangian: Lagrangian, face: str) -> None:
        unknowns, domain, field = lagrangian.unknowns, lagrangian.domain, lagrangian.field
        if field is None:
            raise RuntimeError("this scene has no field")
        order, side = domain.sizes.potential_order, SIDES[face]
        trace = TraceSpace(domain.mesh, order, vector=False, reach=domain.materials(side))
        self.flux = GridFunction(trace.space)
        self._still = GridFunction(trace.space)
        values = {name: unknowns.field(name) for name in unknowns.names} | {"shift": trace.space.TrialFunction()}
        self._form = BilinearForm(trace.space)
        terms = field.side_energies(values, side, field.motion_of(face, values))
        for term in [*terms, field.through_face(face, values)]:
            self._form += Variation(term).Compile()
        mass = BilinearForm(trace.space, symmetric=True)
        trial, test = trace.space.TnT()
        mass += domain.reduction.measure * trial.Trace() * test.Trace() * domain.potential_surface()
        mass.Assemble()
        self._inverse = factored(mass.mat, as_bits(trace.free))

    def refresh(self) -> None:
        """Bring ``flux`` up to date with the state."""
        answer = self.flux.vec.CreateVector()
        self._form.Apply(self._still.vec, answer)
        self.flux.vec.data = self._inverse * answer
