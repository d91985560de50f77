"""What a theory of normals that stay normal leaves out of a shell that bends, as a relative error of its loads.

*Shear.* The shear force Q that the moments are in balance with has the energy Q^2 / (2 k G T) per area, k = 5/6, which
the theory has not: what is over the elastic energy is missing of the compliance (E. Reissner, J. Appl. Mech. 12 (1945)
A69). A clamped strip under pressure: 60 D / (k G T L^2), of its middle 48; a cantilever: 3 D / (k G T L^2).

*Curling.* Bent in plane strain to t = curvature times thickness, rubber takes the moment mu T^2 (t/3 - t^3/10 + ...),
its mid-surface stretched by 1 + t^2/4 (R. Rivlin, Proc. R. Soc. A 195 (1949) 463). The theory has the stretch, and the
moment mu T^2 (t/3 - t^3/2 + ...): less by 1.2 t^2, with t^2 six times the bending energy per volume and modulus.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from ngsolve import CF

from embedding.geometry.points import sampling_rule
from embedding.solving.problem import Problem

SHEAR_FACTOR = 5.0 / 6.0
CURLED = 1.2
SHARP = 0.5
"""Curvature times thickness from which on the theory says nothing of rubber."""


class Bent:
    """The bending of ``problem`` at its present, converged state."""

    def __init__(self, problem: Problem) -> None:
        system = problem.system
        self._domain, self._thickness = problem.domain, system.physics.thickness
        self._law: Any = system.physics.law
        self._bending: Any = system.unknowns.bending
        self._values = {name: system.unknowns.field(name) for name in system.unknowns.names}
        self._state = system.lagrangian.kinematics(self._values)
        self._factor = system.factors.mechanical
        self._energy = system.lagrangian.elastic_energy(self._values)

    @property
    def shear(self) -> float:
        """What shear would add to the elastic energy, relative."""
        square = self._bending.shear_force_squared(self._values, self._state, self._factor)
        return self._part(0.5 * square / (SHEAR_FACTOR * self._modulus * self._thickness))

    @property
    def curling(self) -> float:
        """What is missing of the moments of rubber, relative to all that carries the load."""
        if not self._law.incompressible:
            return 0.0
        stored = self._bending.stored(self._values, self._state, self._factor)
        return self._part(CURLED * self.curvature_squared * stored)

    @property
    def curvature_squared(self) -> Any:
        """(Curvature times thickness)^2, as of rubber in plane strain."""
        stored = self._bending.stored(self._values, self._state, self._factor)
        return 6 * stored / (self._modulus * self._thickness)

    @property
    def sharpest(self) -> float:
        """Largest curvature times thickness of rubber; 0 of other materials."""
        return math.sqrt(self._largest(self.curvature_squared)) if self._law.incompressible else 0.0

    @property
    def strain(self) -> float:
        """Largest strain on the faces from bending, of a law of small strains: half of curvature times thickness."""
        stored = self._bending.stored(self._values, self._state, self._factor)
        stiff = self._law.youngs / (1 - self._law.poisson**2) * self._thickness
        return math.sqrt(self._largest(6 * stored / stiff))

    def _largest(self, function: Any) -> float:
        """Of a function on the shell, at several points of every element; 0 if it is negative."""
        rule = sampling_rule(self._domain.mesh.dim, self._domain.sizes.order)
        points = self._domain.mesh.MapToAllElements(rule, self._domain.shell)
        return max(float(np.asarray(CF(function)(points)).max()), 0.0)

    @property
    def _modulus(self) -> Any:
        """Shear modulus of the state."""
        if self._law.incompressible:
            return self._law.bending_modulus(self._state)
        return self._law.youngs / (2 * (1 + self._law.poisson))

    def _part(self, density: Any) -> float:
        return float(self._domain.shell_integral(density)) / self._energy if self._energy > 0.0 else 0.0
