"""A stage of a scene as an equilibrium path: the parameter runs from 0 at the start of the stage to 1 at its end.

Everything a stage changes - loads, prescribed displacements, a field, a volume - depends on the one parameter t, and
the path may go through values of t below 0 or beyond 1. Where the forces of the field are even in its factor, it is the
square of the factor that is linear in t: out of no field, the response to the factor itself would be zero.
"""

from __future__ import annotations

import time
from functools import cached_property
from typing import Any

import numpy as np
from ngsolve import ET, BilinearForm, GridFunction, InnerProduct, IntegrationRule

from embedding.coupling.physics import FieldPhysics
from embedding.solving.continuation import Array, Linearised
from embedding.solving.newton import Clock
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.stability import unstable_modes

WHOLE, SMALL = 1.0, 1e-4
"""Difference of the parameter for the derivative of the residual: loads are linear in it, so any does; prescribed
displacements are not."""


ROUNDING = float(np.finfo(float).eps)
"""A square of the field that is negative by no more than this part of the largest is that of no field."""


class ShellPath:
    """The shell of ``problem`` on the way from ``start`` to ``end``; see :class:`Equilibrium`."""

    def __init__(self, problem: Problem, start: Target, end: Target, clock: Clock) -> None:
        self.problem, self.start, self.end, self.clock = problem, start, end, clock
        self._system = problem.system
        self._state = problem.system.unknowns.state.vec
        self._parameter, self.faded = 0.0, False
        field = problem.system.physics.field
        self._squared = field is not None and _even(field) and start.field != end.field and start.field * end.field >= 0
        self._scales = field is not None and field.matter.saturation is None

    def target(self, parameter: float) -> Target:
        """The load at ``parameter``."""
        return self.end.between(self.start, parameter, squared=self._squared)

    @property
    def parameter(self) -> float:
        """The present value of the parameter."""
        return self._parameter

    def values(self) -> Array:
        """A copy of the unknowns."""
        return self._system.present

    def move(self, values: Array, parameter: float, *, curved: bool = False) -> bool:
        """Go to another state; False (and nothing moved) if elements of the ambient would turn over, or if there is no
        such state for want of a field (``faded``)."""
        self.faded = self._square(parameter) < -ROUNDING * max(self.start.field**2, self.end.field**2)
        if self.faded:
            return False
        before = self.values(), self._parameter
        self._put(values, parameter)
        start = time.perf_counter()
        moved = self._system.follow()
        self.clock.add("ambient motion", start)
        if not moved:
            self._put(*before)
        elif curved:
            self._system.guess()
        return moved

    def _put(self, values: Array, parameter: float) -> None:
        self._system.present = values
        self._load(parameter)
        self._parameter = parameter

    def _load(self, parameter: float) -> None:
        target = self.target(parameter)
        self._system.load(target.mechanical, target.field, target.volume, target.pressure)

    def linearise(self) -> Linearised:
        """Factor the tangent of the present state. Raises LinearSolverError."""
        system, start = self._system, time.perf_counter()
        if system.potential is not None:
            system.potential.solve()
            start = self.clock.add("potential", start)
        residual = self._numbers(system.residual())
        load, prescribed = self._difference()
        system.linearise()
        update = -self.solve(residual)
        response = prescribed - self.solve(load)
        self.clock.add("joint", start)
        return Linearised(residual, load, update, response)

    @property
    def lagging(self) -> bool:
        """Had the last tangent the stress of the state before a guess?"""
        return self._system.lagging

    def _difference(self) -> tuple[Array, Array]:
        """Derivatives of the residual and of the prescribed unknowns in the parameter, by central differences.

        With the square of the field's factor as the parameter, the potential as a whole counts as prescribed: that of
        the present shape, which goes with the factor. The residual is then linear in the parameter.
        """
        step = SMALL if self._system.physics.prescribed or self.start.field != self.end.field else WHOLE
        values, here = self.values(), self._parameter
        sides = []
        for side in (here - step, here + step):
            at = here if self._square(side) < 0.0 else side
            self._load(at)
            if self._squared:
                self._follow_field(values, self.target(here).field, self.target(at).field)
            sides.append((at, self._numbers(self._system.residual()), self.values()))
            self._system.present = values
        self._load(here)
        (start, low, before), (stop, high, after) = sides
        return (high - low) / (stop - start), (after - before) / (stop - start)

    def _square(self, parameter: float) -> float:
        """The square of the field's factor, where that is linear in the parameter; it may be negative."""
        start, end = self.start.field**2, self.end.field**2
        return start + parameter * (end - start) if self._squared else 0.0

    def _follow_field(self, values: Array, present: float, factor: float) -> None:
        """Bring the potential to a ``factor`` of the field from that in ``values``, at the ``present`` factor."""
        system = self._system
        if system.potential is None or factor == present:
            return
        if present == 0.0 or not self._scales:
            system.potential.solve()
            return
        for name in ("phi", "jump"):
            if name in system.unknowns:
                where = system.unknowns.range(name)
                self._state.FV().NumPy()[where] = factor / present * values[where]

    def solve(self, right_side: Array) -> Array:
        """K^-1 times ``right_side``. Raises LinearSolverError."""
        vector = self._state.CreateVector()
        vector.FV().NumPy()[:] = right_side
        return self._numbers(self._system.solve(vector))

    @cached_property
    def _mass(self) -> Any:
        domain, space = self.problem.domain, self._system.unknowns.trace.space
        trial, test = space.TnT()
        area = domain.area
        form = BilinearForm(space, symmetric=True)
        form += domain.reduction.measure / area * InnerProduct(trial.Trace(), test.Trace()) * domain.surface()
        return form.Assemble().mat

    def gradient(self, direction: Array) -> Array:
        """M times ``direction``, for the mean square of the displacement over the shell, in shell sizes."""
        where = self._system.unknowns.range("u")
        vector = self._mass.CreateColVector()
        vector.FV().NumPy()[:] = direction[where]
        out = np.zeros_like(direction)
        out[where] = self._numbers((self._mass * vector).Evaluate())
        return out

    def turned_over(self, values: Array) -> bool:
        """Has every piece of a membrane turned by more than a right angle since it had these ``values``? Beyond the
        state of no size a squeezed sheet is found again as its own point reflection. Shells that bend may turn."""
        if self.problem.plan.bending:
            return False
        domain, before = self.problem.domain, self._before
        before.vec.FV().NumPy()[:] = values[self._system.unknowns.range("u")]
        rule = IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, domain.sizes.order)
        points = domain.mesh.MapToAllElements(rule, domain.shell)
        return bool(np.asarray(self._likeness(points)).max() < 0.0)

    @cached_property
    def _before(self) -> GridFunction:
        return GridFunction(self._system.unknowns.trace.space)

    @cached_property
    def _likeness(self) -> Any:
        """Product of the deformation gradients before and now."""
        lagrangian, names = self._system.lagrangian, self._system.unknowns.names
        now = {name: self._system.unknowns.field(name) for name in names}
        pair = (lagrangian.kinematics({**now, "u": u}).deformation_gradient for u in (self._before, now["u"]))
        return InnerProduct(*pair)

    def decrement(self, residual: Array, step: Array) -> float:
        """Energy norm of a Newton step, see :meth:`System.decrement`."""
        first, second = self._state.CreateVector(), self._state.CreateVector()
        first.FV().NumPy()[:], second.FV().NumPy()[:] = residual, step
        return self._system.decrement(first, second)

    def unstable_modes(self) -> int | None:
        """Negative eigenvalues of the last tangent, see :func:`unstable_modes`."""
        return unstable_modes(self._system)

    def save(self) -> Any:
        """A copy of the whole state."""
        return self._system.save(), self._parameter

    def restore(self, saved: Any) -> None:
        """Go back to a state returned by :meth:`save`."""
        state, self._parameter = saved
        self._system.restore(state)
        self._load(self._parameter)

    @staticmethod
    def _numbers(vector: Any) -> Array:
        return np.array(vector.FV().NumPy())


def _even(field: FieldPhysics) -> bool:
    """Are the forces the same with the field turned round? A remanence of the shell does not turn with it."""
    return field.matter.remanence is None
