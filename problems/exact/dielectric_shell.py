"""What a dielectric balloon and tube share: electrodes on both faces, a dielectric wall between.

With the voltage U across the wall and the outer electrode at V over a ground around it, the balance of the total
radial stress of the incompressible wall is

    p_elastic(l) = p + U^2 squeeze(l) + eps0 E_o^2 / 2,    E_o = V / distance(l),

p the inflating pressure p_b - p_t. The first field pulls with the Maxwell stress of the wall, eps (E E - E^2/2 I)
for an ideal dielectric; the last one is that of the outer face's own charge in the space around (`charged_shell`).
U^2 squeeze dv is the change of the energy C U^2 / 2 with the enclosed volume v.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field

from problems.exact.charged_shell import ChargedShell, Theory
from problems.exact.material import Law, neo_hookean
from problems.exact.roots import bracketed_root, complex_slope, increasing_root, sign_changes
from problems.exact.sphere import LimitPoint


@dataclass(frozen=True)
class DielectricShell(ABC):
    """A closed shell of undeformed mid radius `radius` with a compliant electrode on each face.

    `permittivity` is that of the wall, `vacuum` that of the space up to a concentric ground of `outer_radius`
    (infinite: free space; it matters with a voltage of the outer electrode only). Any consistent units.
    """

    radius: float = 1.0
    thickness: float = 0.1
    law: Law = field(default_factory=neo_hookean)
    permittivity: float = 1.0
    vacuum: float = 1.0
    outer_radius: float = math.inf
    theory: Theory = "thick"

    @property
    @abstractmethod
    def conductor(self) -> ChargedShell:
        """The same shell with the outer electrode's own field only."""

    @abstractmethod
    def _squeeze(self, stretch: complex) -> complex:
        """Pressure of the wall's field per squared voltage."""

    @abstractmethod
    def capacitance(self, stretch: float) -> float:
        """Charge of the wall per voltage across it (per axial length for a tube)."""

    @abstractmethod
    def _faces(self, stretch: complex) -> tuple[complex, complex, complex]:
        """Deformed radii of the inner and outer face, and their difference without cancellation."""

    def face_radii(self, stretch: float) -> tuple[float, float]:
        """Deformed radii of the inner and outer face."""
        inner, outer, _ = self._faces(stretch)
        return inner.real, outer.real

    def pressure(self, stretch: float, voltage: float = 0.0, outer_voltage: float = 0.0) -> float:
        """Inflating pressure that holds the stretch at `voltage` across and `outer_voltage` of the outer face."""
        return self.conductor.pressure(stretch, outer_voltage) - voltage**2 * self._squeeze(stretch).real

    def pressure_at_charge(self, stretch: float, charge: float, outer_voltage: float = 0.0) -> float:
        """Inflating pressure that holds the stretch at a charge of the wall."""
        return self.pressure(stretch, charge / self.capacitance(stretch), outer_voltage)

    def charges(self, stretch: float, voltage: float, outer_voltage: float = 0.0) -> tuple[float, float]:
        """Charge on the outer and on the inner electrode; `voltage` is inner minus outer potential."""
        wall = voltage * self.capacitance(stretch)
        outside = self.conductor.charge(stretch, outer_voltage) if outer_voltage else 0.0
        return outside - wall, wall

    def voltage(self, stretch: float, pressure: float = 0.0) -> float:
        """Voltage across the wall that holds the stretch against the pressure; ValueError if there is none."""
        pull = self.conductor.pressure(stretch) - pressure
        if pull < 0.0:
            raise ValueError(f"pressure {pressure:.6g} alone stretches the shell beyond {stretch:.6g}")
        return math.sqrt(pull / self._squeeze(stretch).real)

    def pull_in(self, pressure: float = 0.0) -> LimitPoint | None:
        """First maximum of the voltage at fixed inflating pressure, (stretch, voltage), or None."""

        def slope(stretch: float) -> float:
            squeeze, pull = self._squeeze(stretch).real, self.conductor.pressure(stretch) - pressure
            return self.conductor.pressure_slope(stretch) * squeeze - pull * complex_slope(self._squeeze, stretch)

        start = self.conductor.stretch(0.0, pressure)
        roots = sign_changes(slope, start * (1.0 + 1e-9), self.conductor.largest_stretch())
        return LimitPoint(roots[0], self.voltage(roots[0], pressure)) if roots else None

    def pressure_limit(self, voltage: float, outer_voltage: float = 0.0) -> LimitPoint | None:
        """First maximum of the inflating pressure at fixed voltages, (stretch, pressure), or None."""

        def slope(stretch: float) -> float:
            elastic = self.conductor.pressure_slope(stretch, outer_voltage)
            return elastic - voltage**2 * complex_slope(self._squeeze, stretch)

        roots = sign_changes(slope, 1.0, self.conductor.largest_stretch())
        maxima = [r for r in roots if slope(r * (1.0 - 1e-6)) > 0.0]
        return LimitPoint(maxima[0], self.pressure(maxima[0], voltage, outer_voltage)) if maxima else None

    def stretch(self, voltage: float, pressure: float = 0.0) -> float:
        """Stretch on the branch that starts at rest: pressure first, voltage after; ValueError beyond pull-in."""
        start, limit = self.conductor.stretch(0.0, pressure), self.pull_in(pressure)

        def excess(stretch: float) -> float:
            return self.conductor.pressure(stretch) - pressure - voltage**2 * self._squeeze(stretch).real

        if limit is None:
            return increasing_root(excess, start=start)
        if abs(voltage) > limit.load:
            raise ValueError(f"voltage {voltage:.6g} exceeds the pull-in voltage {limit.load:.6g}")
        return bracketed_root(excess, start * (1.0 - 1e-9), limit.stretch)
