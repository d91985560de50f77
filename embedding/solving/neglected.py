"""How much what a plan leaves out is worth, measured on the present state: dimensionless numbers, relative to the load.

What a neglected term does to a load becomes an error of the answer through the response of the answer to the load.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

from ngsolve import InnerProduct, Inv, OuterProduct, Trace

from embedding.plan.coefficients import BENT, CLOSED_FACES, MEMBRANE, ROBIN
from embedding.plan.effects import Effects
from embedding.plan.loading import STRETCHES, TIGHTENED, Loading, is_displacement
from embedding.plan.response import Answer
from embedding.shell.derivatives import Derivatives
from embedding.shell.kinematics import Kinematics
from embedding.solving.estimate.bent import Bent
from embedding.solving.events import StepRecord
from embedding.solving.problem import Problem
from embedding.solving.room import gap, reach
from embedding.solving.sensitivity import moved, slope
from embedding.solving.state import State

LEAST = 0.05
"""A part of the load that is smaller is too small to measure the response to the whole load on."""
NOTHING = 1e-12
UNBENT = 1e-20
"""Energies of bending below the first part of the elastic one are rounding, and below the second part of that of a
shell bent to the radius of its own size."""


class Neglected:
    """Terms that the plan of ``problem`` leaves out, at its present state, the last of ``steps``.

    Numbers that end up in an answer are relative errors of the scalars ``of``, the worst of them.
    """

    def __init__(self, problem: Problem, steps: Sequence[StepRecord], of: Sequence[str]) -> None:
        self.problem, self.steps, self.of = problem, steps, of
        self.state, self.scalars = State(problem), steps[-1].scalars
        self._thickness = problem.scene.shell.thickest / problem.scales.length

    @cached_property
    def response(self) -> float:
        """Largest |d ln(answer) / d ln(load)| of the answers, all loads together: that of the last steps for stretches
        and displacements, else 1.

        Where only the field changed, or only the mechanical loads, the answer's slope is to that part of the load.
        """
        with_field = self.problem.system.physics.field is not None
        which = moved(self.steps, with_field=with_field)
        part = {"field": self.field_share, "mechanical": 1 - self.field_share, "both": 1.0}[which]
        return max((self._response_of(name, max(part, LEAST)) for name in self.of), default=1.0)

    def _response_of(self, name: str, part: float) -> float:
        """Of one answer, where that ``part`` of the load changed in the last steps."""
        physics = self.problem.system.physics
        if is_displacement(name):
            found = max(slope(self.steps, name, with_field=physics.field is not None) / part, TIGHTENED)
            return found * self._smallness(name)
        if name not in STRETCHES:
            return 1.0
        if physics.volume_controlled:
            return 0.0 if Loading(self.problem.scene).homogeneous or name == "volume_ratio" else 1.0
        return slope(self.steps, name, with_field=physics.field is not None) / part

    def _smallness(self, name: str) -> float:
        """How much less than the shell as a whole a point of a curved one moves: what changes all moves it as much as
        the rest. A flat one moves in its plane and out of it for different reasons."""
        if self.problem.domain.is_flat:
            return 1.0
        whole, here = abs(self.scalars["displacement"]), abs(self.scalars.get(name, 0.0))
        return max(whole / here, 1.0) if here > 0.0 else 1.0

    @cached_property
    def slenderness(self) -> float:
        """t / r of the deformed shell, as if it kept its shape; 0 for flat shapes."""
        domain = self.problem.domain
        return 0.0 if domain.is_flat else self._thickness / domain.curvature_radius / self._growth

    @property
    def _growth(self) -> float:
        """What the deformation divides t / r by."""
        plane = self.problem.reduction.name == "plane-strain"
        stretch = self.scalars["stretch"]
        across = self.scalars.get("axial_stretch", self.problem.system.physics.axial_stretch) if plane else stretch
        return stretch * stretch * across

    @property
    def thickness(self) -> float:
        """What shell theory itself leaves out of the load of a curved wall."""
        bending = self.problem.plan.bending
        at_rest = self.slenderness * self.scalars["stretch"]  # over the radius that the shell had
        return self.response * (BENT if bending else MEMBRANE) * at_rest**2

    @cached_property
    def planned(self) -> Effects:
        """The planner's estimates, with the stretch and the response that were found."""
        return Effects(self.problem.scene, Answer(self.scalars["stretch"], self.response))

    @property
    def field_felt(self) -> float:
        """What a field that was left out is worth: that between electrodes grows as the wall becomes thinner."""
        grown = self.scalars["stretch"] ** 4 if self.planned.field.film_voltage else 1.0
        return grown * self.planned.field_felt

    @property
    def closed_faces(self) -> float:
        """What the places of the faces are worth: their distance over the radius of the shell (the size of a flat one)
        and over the gaps to the bodies beside it, across which the field is as strong as they are narrow."""
        flat = self._thickness if self.problem.domain.is_flat else self.slenderness
        across = self._thickness / self._gap if self._gap > 0.0 else math.inf
        off = CLOSED_FACES * max(flat, across) + self.planned.counted_twice
        return self.response * self.field_share * off

    @property
    def coupling_gap(self) -> float:
        """What the change of the field's forces with the shape is worth."""
        return self.response * self.field_share * self.scalars["coupling_gap"]

    @property
    def far_field(self) -> float:
        """What Robin's condition misses of the field's load, by how far the deformed shell reaches."""
        sizes = self.problem.plan.sizes
        return self.response * self.field_share * ROBIN * (reach(self.problem) / sizes.radius) ** 5

    @cached_property
    def _gap(self) -> float:
        return gap(self.problem)

    @cached_property
    def field_share(self) -> float:
        """The field's part of the load: root mean squares of its tractions, the sum of both faces and, as a stress in
        the wall, each of them; against the mechanical pressure difference. Other mechanical loads do not count: the
        share is that of the field or more."""
        tractions = self.problem.system.tractions
        if not tractions:
            return 1.0
        for traction in tractions.values():
            traction.refresh()
        each = [traction.total for traction in tractions.values()]
        field = self._mean_square(sum(each[1:], each[0]))
        field += (self.slenderness or self._thickness) * sum(map(self._mean_square, each))
        mechanical = abs(self.scalars["pressure_difference"]) / self.problem.scales.stress
        return field / (field + mechanical) if field > 0.0 else 0.0

    def _mean_square(self, vector: Any) -> float:
        """Root of the mean square over the reference mid-surface."""
        domain = self.problem.domain
        return math.sqrt(domain.shell_integral(InnerProduct(vector, vector)) / domain.area)

    @property
    def strain(self) -> float:
        """Largest principal strain of the mid-surface, and what bending adds to it on the faces."""
        stretched = max(abs(self.scalars["stretch_max"] - 1.0), abs(self.scalars["stretch_min"] - 1.0))
        return stretched + (Bent(self.problem).strain if self.problem.plan.bending else 0.0)

    @property
    def bending(self) -> float:
        """What bending would add to the load that a membrane carries: the bending energy of its shape over the energy
        that carries the load. That of a curved shell is its elastic energy; a flat one, which may be stretched
        beforehand, carries loads by its tension on its slope."""
        k = self.state.mid_surface
        bent = self.problem.domain.shell_integral(self._bending_energy(k))
        unknowns = self.problem.system.unknowns
        elastic = self.problem.system.lagrangian.elastic_energy({name: unknowns.field(name) for name in unknowns.names})
        carried = self.problem.domain.shell_integral(self._slope_energy(k)) if self.problem.domain.is_flat else elastic
        if bent <= max(NOTHING * elastic, UNBENT * self._thickness**3):
            return 0.0
        return float(self.response * bent / carried) if carried > 0.0 else math.inf

    def _bending_energy(self, k: Kinematics) -> Any:
        """W_b(K) of the theory page "Bending" at the curvature of the membrane, per reference area."""
        physics, derivatives = self.problem.system.physics, Derivatives(self.problem.domain, k)
        F = derivatives.gradient
        N, n, thin = derivatives.reference_normal, derivatives.normal, 1 / k.surface_stretch
        inverse = Inv(F + thin * OuterProduct(n, N))
        along = derivatives.curvature * (F.trans * F)
        measure = thin * (F.trans * derivatives.deformed_curvature * F) - 0.5 * (along + along.trans)
        bend = inverse.trans * measure * inverse
        square, trace = InnerProduct(bend, bend), Trace(bend)
        law: Any = physics.law
        if law.incompressible:
            return law.bending_modulus(k) * physics.thickness**3 / (12 * k.surface_stretch_squared) * (
                square + trace * trace
            )
        stiffness = law.youngs * physics.thickness**3 / (12 * (1 - law.poisson**2))
        return 0.5 * stiffness * ((1 - law.poisson) * square + law.poisson * trace * trace)

    def _slope_energy(self, k: Kinematics) -> Any:
        """Of the mean tension on the slope of the deflected shell, per reference area."""
        major, minor = self.problem.system.physics.law.principal_stresses(*self.state.principal_stretches)
        turned = InnerProduct(k.normal, k.reference_normal)
        return 0.25 * (major + minor) * self.problem.system.physics.thickness * (1 - turned * turned)
