"""What a charged conducting balloon and tube share: elastic pressure against the pull of the field.

A conductor at voltage V carries the normal traction eps E^2 / 2 on its outer face and nothing else (Maxwell),
so

    p_elastic(l) = p + eps E^2 / 2,    E = V / distance(l).

p is the inflating pressure p_b - p_t of mechanical origin, `distance` the length that turns the voltage into
the field at the face. "thick" is the exact wall, with the field at the true outer face; "membrane" is the
limit of a thin wall, with the field at the mid-surface (closed interface).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Literal

from problems.exact.material import Law, neo_hookean
from problems.exact.roots import bracketed_root, increasing_root, sign_changes
from problems.exact.sphere import LimitPoint

Theory = Literal["membrane", "thick"]
LARGEST_STRETCH = 50.0  # limit points are sought up to here


@dataclass(frozen=True)
class ChargedShell(ABC):
    """A conducting closed shell of undeformed mid radius `radius` inside a concentric grounded one.

    Any consistent units; `outer_radius` infinite is free space. Raises ValueError for a ground inside the
    shell.
    """

    radius: float = 1.0
    thickness: float = 0.1
    law: Law = field(default_factory=neo_hookean)
    permittivity: float = 1.0
    outer_radius: float = math.inf
    theory: Theory = "thick"

    def __post_init__(self) -> None:
        if self.outer_radius <= self.radius + 0.5 * self.thickness:
            raise ValueError(f"outer_radius {self.outer_radius:.6g} must exceed the outer face of the shell")

    @abstractmethod
    def face_radius(self, stretch: float) -> float:
        """Deformed radius at which the field acts: the outer face, or the mid-surface of a membrane."""

    @abstractmethod
    def _face_slope(self, stretch: float) -> float:
        """Derivative of the face radius with respect to the stretch."""

    @abstractmethod
    def _elastic(self, stretch: float) -> tuple[float, float]:
        """Elastic pressure and its derivative."""

    @abstractmethod
    def _distance(self, face: float) -> tuple[float, float]:
        """V / E at a face of deformed radius `face`, and its derivative."""

    @abstractmethod
    def _capacitance(self, face: float) -> float:
        """Charge per voltage (per axial length for a tube)."""

    def pressure(self, stretch: float, voltage: float = 0.0) -> float:
        """Inflating pressure that holds the stretch at the voltage."""
        return self._elastic(stretch)[0] - 0.5 * self.permittivity * self.field(stretch, voltage) ** 2

    def pressure_slope(self, stretch: float, voltage: float = 0.0) -> float:
        """Derivative of `pressure` with respect to the stretch, at a held voltage."""
        distance, distance_slope = self._distance(self.face_radius(stretch))
        pull = self.permittivity * voltage**2 * distance_slope / distance**3
        return self._elastic(stretch)[1] + pull * self._face_slope(stretch)

    def field(self, stretch: float, voltage: float) -> float:
        """Electric field on the outer face."""
        return voltage / self._distance(self.face_radius(stretch))[0]

    def charge(self, stretch: float, voltage: float) -> float:
        """Charge on the shell (per axial length for a tube)."""
        return voltage * self._capacitance(self.face_radius(stretch))

    def voltage(self, stretch: float, pressure: float = 0.0) -> float:
        """Voltage that holds the stretch against the inflating pressure.

        Raises ValueError where the pressure alone holds a larger stretch.
        """
        pull = self._elastic(stretch)[0] - pressure
        if pull < 0.0:
            raise ValueError(f"pressure {pressure:.6g} alone stretches the shell beyond {stretch:.6g}")
        return self._distance(self.face_radius(stretch))[0] * math.sqrt(2.0 * pull / self.permittivity)

    def face_pressures(self, stretch: float, voltage: float, pressure: float = 0.0) -> tuple[float, float]:
        """Total (p_t, p_b): -eps E^2 / 2 on the outer face, the inflating pressure inside."""
        return -0.5 * self.permittivity * self.field(stretch, voltage) ** 2, pressure

    def pull_in(self, pressure: float = 0.0) -> LimitPoint | None:
        """First maximum of the voltage at fixed inflating pressure, (stretch, voltage), or None."""

        def slope(stretch: float) -> float:
            elastic, elastic_slope = self._elastic(stretch)
            distance, distance_slope = self._distance(self.face_radius(stretch))
            growth = distance_slope * self._face_slope(stretch)
            return elastic_slope * distance + 2.0 * (elastic - pressure) * growth

        start = self._unelectrified(pressure)
        roots = sign_changes(slope, start * (1.0 + 1e-9), self.largest_stretch())
        return LimitPoint(roots[0], self.voltage(roots[0], pressure)) if roots else None

    def pressure_limit(self, voltage: float) -> LimitPoint | None:
        """First maximum of the inflating pressure at fixed voltage, (stretch, pressure), or None."""

        def slope(stretch: float) -> float:
            return self.pressure_slope(stretch, voltage)

        roots = sign_changes(slope, 1.0, self.largest_stretch())
        maxima = [r for r in roots if slope(r * (1.0 - 1e-6)) > 0.0]
        return LimitPoint(maxima[0], self.pressure(maxima[0], voltage)) if maxima else None

    def stretch(self, voltage: float, pressure: float = 0.0) -> float:
        """Stretch on the branch that starts at rest: pressure first, voltage after.

        Raises ValueError beyond the pressure's limit point or the pull-in voltage.
        """
        start = self._unelectrified(pressure)
        limit = self.pull_in(pressure)

        def excess(stretch: float) -> float:
            distance = self._distance(self.face_radius(stretch))[0]
            pull = (self._elastic(stretch)[0] - pressure) * distance**2
            return pull - 0.5 * self.permittivity * voltage**2

        if limit is None:
            return increasing_root(excess, start=start)
        if abs(voltage) > limit.load:
            raise ValueError(f"voltage {voltage:.6g} exceeds the pull-in voltage {limit.load:.6g}")
        return bracketed_root(excess, start * (1.0 - 1e-9), limit.stretch)

    @abstractmethod
    def _unelectrified(self, pressure: float) -> float:
        """Stretch at zero voltage, on the first branch; ValueError beyond the limit of the pressure."""

    def largest_stretch(self) -> float:
        """Where the face meets the ground, or far out in free space."""
        if math.isinf(self.outer_radius):
            return LARGEST_STRETCH
        touching = increasing_root(lambda stretch: self.face_radius(stretch) - self.outer_radius)
        return min(LARGEST_STRETCH, touching * (1.0 - 1e-9))
