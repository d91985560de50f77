"""What the theory of the shell leaves out, as a relative error of the loads it carries.

Spheres and tubes are the thick walls that are known exactly: at the deformed radius and the stretches of the shell, the
pressure that a thick incompressible sphere or tube of the same law takes is an integral over the wall
(Haughton and Ogden, J. Mech. Phys. Solids 26 (1978) 111; 27 (1979) 179),

    p = int_a^b 2 sigma(l(r)) / r dr  (sphere),    p = int_a^b sigma(l(r), l_z) / r dr  (tube),

with sigma the stress difference of the law, and the membrane's is 2 sigma(l) t / r or sigma(l) t / r. A shell that
bends has its bending energy on top (shell/bending/stiffness): with X = 1 - l^-3 or 1 - 1 / (l^2 l_z) per reference area

    W_b = mu_b T^3 X^2 / (2 l^4)  (sphere),    W_b = mu_b T^3 X^2 / (6 l^2 l_z^2)  (tube),

which is most of the difference near rest, and none of it far from there. What they differ by is taken for every shell
of that mean radius and stretch. The pull of a field through the wall differs as well: the field is
V a b / ((b - a) r^2) in a sphere and V / (r ln(b / a)) in a tube, and V / t in a membrane. All is of second order in
the thickness over the radius.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from embedding.shell.laws.pieces import PiecewiseLaw
from embedding.solving.problem import Problem

POINTS = 8
"""Gauss points through the wall."""
AT_REST = 1e-6
"""Strain below which the wall counts as unstressed."""
NUDGE = 1e-4
"""Relative change of stretches by which slopes are measured."""


@dataclass(frozen=True)
class Wall:
    """A sphere or a tube of ``thickness`` over radius at rest, its mid-surface stretched by ``stretch``, a tube by
    ``axial`` along itself; in the theory of the shell it ``bends``, or is a membrane."""

    tube: bool
    thickness: float
    stretch: float
    axial: float = 1.0
    bends: bool = False

    def _layers(self) -> tuple[Any, Any, Any]:
        """Radii before and after, and their weights; lengths over the radius at rest."""
        nodes, weights = np.polynomial.legendre.leggauss(POINTS)
        before = 1.0 + 0.5 * self.thickness * nodes
        after = self._after(before)
        measure = before / (self.axial * after) if self.tube else (before / after) ** 2
        return before, after, 0.5 * self.thickness * weights * measure

    def _after(self, before: Any) -> Any:
        if self.tube:
            return np.sqrt((before**2 - 1.0) / self.axial + self.stretch**2)
        return np.cbrt(before**3 - 1.0 + self.stretch**3)

    @property
    def thin(self) -> float:
        """t / r of the deformed membrane."""
        return self.thickness / (self.stretch**2 * (self.axial if self.tube else self.stretch))

    def elastic(self, law: Any) -> float:
        """How much more pressure the thick wall takes than the shell, relative; 0 where it is at rest."""
        before, after, weights = self._layers()
        thin = float(self._stress(law, self.stretch)) * self.thin
        if abs(self.stretch - 1.0) < AT_REST or thin == 0.0:
            return 0.0
        low, high = (self.bending(law, self.stretch * (1.0 + side * NUDGE)) for side in (-1, 1))
        slope = (high - low) / (2.0 * NUDGE * self.stretch)
        thin += slope / (self.stretch * (self.axial if self.tube else 2.0 * self.stretch))
        return float((self._stress(law, after / before) / after) @ weights) / thin - 1.0

    def energy(self, law: Any) -> float:
        """How much more energy the thick wall stores than the shell, relative; 0 where it is at rest."""
        before, after, weights = self._layers()
        stored = self._density(law, after / before) * (self.axial * after if self.tube else after**2)
        thin = self.thickness * float(self._density(law, np.array([self.stretch]))[0])
        thin += self.bending(law, self.stretch)
        if abs(self.stretch - 1.0) < AT_REST or thin <= 0.0:
            return 0.0
        return float(stored @ weights) / thin - 1.0

    def _stress(self, law: Any, stretch: Any) -> Any:
        """The stress difference at a hoop stretch, for which the pressure goes over the wall."""
        return law.principal_stresses(stretch, self.axial if self.tube else stretch)[0]

    def _density(self, law: Any, stretches: Any) -> Any:
        """Energy per volume at hoop ``stretches`` (n,): the work of the stresses on the way there from rest."""
        nodes, weights = np.polynomial.legendre.leggauss(POINTS)
        logs = np.log(stretches)[:, None] * (0.5 * (1.0 + nodes))
        work = 0.5 * np.log(stretches) * (self._stress(law, np.exp(logs)) @ weights)
        if not self.tube:
            return 2.0 * work
        along = 0.5 * math.log(self.axial) * (1.0 + nodes)
        return work + 0.5 * math.log(self.axial) * (law.principal_stresses(1.0, np.exp(along))[1] @ weights)

    def bending(self, law: Any, stretch: float) -> float:
        """Energy of bending per reference area that the shell has at a hoop ``stretch``."""
        if not self.bends:
            return 0.0
        if self.tube:
            curved, area = 1.0 - 1.0 / (stretch**2 * self.axial), 6.0 * (stretch * self.axial) ** 2
        else:
            curved, area = 1.0 - stretch**-3, 2.0 * stretch**4
        return _modulus(law, stretch, self.axial if self.tube else stretch) * self.thickness**3 * curved**2 / area

    @property
    def electric(self) -> float:
        """How much more the field between electrodes on the faces pulls in the thick wall, relative."""
        _, after, weights = self._layers()
        a, b = (float(self._after(1.0 + 0.5 * side * self.thickness)) for side in (-1, 1))
        field = 1.0 / (after * math.log(b / a)) if self.tube else a * b / ((b - a) * after**2)
        t = self.thin * self.stretch
        return float((field**2 / after) @ weights) * t * self.stretch - 1.0

    def place(self, steepness: float) -> float:
        """How much stronger a pull of the field is on an outer face, relative, where the shell opens it to.

        The shell has the face at b_m = r + t/2, a wall that keeps its volume has it at b, first apart as it stretches.
        ``steepness`` is -d ln (pull) / d ln b of the field.
        """
        b, t = float(self._after(1.0 + 0.5 * self.thickness)), self.thin * self.stretch
        return float((b / (self.stretch + 0.5 * t)) ** steepness - 1.0)

    def face(self, steepness: float) -> float:
        """How much more a pull on an outer face stretches the shell, relative.

        Besides its :meth:`place`: a pressure there counts b_m^2 db_m / r^2 dr times (tube: b_m db_m / r dr) as the
        shell thins, in a wall that keeps its volume once.
        """
        half = 0.5 * self.thin
        counts = (1.0 + half) * (1.0 - half) if self.tube else (1.0 + half) ** 2 * (1.0 - 2.0 * half)
        return counts * (1.0 + self.place(steepness)) - 1.0

    def pressure(self, law: Any) -> float:
        """What the membrane takes, 2 sigma t / r or sigma t / r, dimensionless as sigma."""
        stress = law.principal_stresses(self.stretch, self.axial if self.tube else self.stretch)[0]
        return float(stress) * self.thin * (1.0 if self.tube else 2.0)


def _modulus(law: Any, first: float, second: float) -> float:
    """The mean of (s_i - s_j) / (l_i^2 - l_j^2) over the pairs of principal directions, beside these in-plane stretches
    to either side: where two are the same it is a limit."""
    found = []
    for side in (-NUDGE, NUDGE):
        stretches = first * (1.0 + side), second * (1.0 - side)
        l1, l2, l3 = *stretches, 1.0 / (stretches[0] * stretches[1])
        s1, s2 = law.principal_stresses(l1, l2)
        pairs = (s1 - s2) / (l1**2 - l2**2) + s1 / (l1**2 - l3**2) + s2 / (l2**2 - l3**2)
        found.append(float(pairs) / 3.0)
    return 0.5 * sum(found)


def law_of(problem: Problem) -> Any:
    """The law of the shell outside of its regions."""
    law: Any = problem.system.physics.law
    while isinstance(law, PiecewiseLaw):
        law = law.outside
    return law


def wall_of(problem: Problem, scalars: dict[str, float]) -> Wall | None:
    """The sphere or tube of the mean radius and stretch of the shell; None for flat shapes and for laws that are not
    those of rubber."""
    physics, domain = problem.system.physics, problem.domain
    if domain.is_flat or not physics.law.incompressible:
        return None
    radius = domain.curvature_radius
    if not math.isfinite(radius):
        return None
    ratio = problem.scene.shell.thickest / problem.scales.length / radius
    axial = scalars.get("axial_stretch", physics.axial_stretch)
    return Wall(problem.reduction.name == "plane-strain", ratio, scalars["stretch"], axial, problem.plan.bending)
