"""A homogeneous film of an incompressible ideal dielectric between compliant electrodes.

Stretches l1 and l2 in the plane, area a = l1 l2, thickness T / a; V the voltage, the field V a / T is uniform and
there is none outside (no fringe: the film is thin). Energy per reference volume at held voltage, and at held charge
q per reference area:

    W(l1, l2) - eps V^2 a^2 / (2 T^2),    W(l1, l2) + q^2 / (2 eps a^2),    q = eps V a^2 / T.

X. Zhao, Z. Suo, Method to analyze electromechanical stability of dielectric elastomers, Appl. Phys. Lett. 91 (2007)
061921. Either l1 = l2 = l ("equibiaxial"), or l1 = l with the width held at l2 ("pure shear").
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from problems.exact.material import Law, neo_hookean
from problems.exact.roots import bracketed_root, complex_slope, increasing_root, sign_changes
from problems.exact.sphere import LimitPoint

LARGEST_STRETCH = 50.0  # limit points are sought up to here


@dataclass(frozen=True)
class DielectricFilm:
    """Film of undeformed thickness `thickness` under the dead nominal stress `load` along each free direction.

    `width` is the held stretch across, None for a film that is free both ways. Any consistent units.
    """

    thickness: float = 1.0
    law: Law = field(default_factory=neo_hookean)
    permittivity: float = 1.0
    load: float = 0.0
    width: float | None = None

    def area(self, stretch: complex) -> complex:
        """Deformed over undeformed area."""
        return stretch * (stretch if self.width is None else self.width)

    def _pull(self, stretch: complex) -> complex:
        """eps E^2 with E = V / T: from the nominal stress `load` = (s1 - s3) / l - eps E^2 a^2 / l."""
        area = self.area(stretch)
        return (self.law.stress_difference(stretch, 1.0 / area) - self.load * stretch) / area**2

    def voltage(self, stretch: float) -> float:
        """Voltage in equilibrium: V = T (mu/eps)^(1/2) (l^-2 - l^-8)^(1/2) for neo-Hooke, free both ways, without load.

        Raises ValueError where the load alone holds a larger stretch.
        """
        pull = self._pull(stretch).real
        if pull < 0.0:
            raise ValueError(f"load {self.load:.6g} alone stretches the film beyond {stretch:.6g}")
        return self.thickness * math.sqrt(pull / self.permittivity)

    def charge(self, stretch: float) -> float:
        """Charge per undeformed area in equilibrium."""
        return self.permittivity * self.voltage(stretch) * self.area(stretch).real ** 2 / self.thickness

    def true_field(self, stretch: float) -> float:
        """Field in the deformed film in equilibrium."""
        return self.voltage(stretch) * self.area(stretch).real / self.thickness

    @property
    def unelectrified(self) -> float:
        """Stretch under the load alone; ValueError beyond what the law can carry."""
        return increasing_root(
            lambda s: self.law.stress_difference(s, 1.0 / self.area(s).real) - self.load * s,
            start=1.0 if self.width is None else self.width**-0.5,
        )

    def pull_in(self) -> LimitPoint | None:
        """First maximum of the voltage, (stretch, voltage), or None.

        Neo-Hooke without load: l = 2^(1/3), V = 0.687364818... T (mu/eps)^(1/2). With the width held there is
        none: V rises to T (mu/eps)^(1/2) / width.
        """
        start = self.unelectrified
        roots = sign_changes(lambda s: complex_slope(self._pull, s), start * (1.0 + 1e-9), LARGEST_STRETCH)
        return LimitPoint(roots[0], self.voltage(roots[0])) if roots else None

    def stretch(self, voltage: float) -> float:
        """Stretch at a held voltage, on the branch that starts at rest; ValueError beyond pull-in."""
        wanted, limit = self.permittivity * (voltage / self.thickness) ** 2, self.pull_in()
        start = self.unelectrified
        if limit is None:
            return increasing_root(lambda s: self._pull(s).real - wanted, start=start)
        if abs(voltage) > limit.load:
            raise ValueError(f"voltage {voltage:.6g} exceeds the pull-in voltage {limit.load:.6g}")
        return bracketed_root(lambda s: self._pull(s).real - wanted, start * (1.0 - 1e-9), limit.stretch)

    def stretch_at_charge(self, charge: float) -> float:
        """Stretch at a held charge per undeformed area: one, and stable, past the pull-in as well."""
        return increasing_root(
            lambda s: self._pull(s).real * self.area(s).real ** 4 - charge**2 / self.permittivity,
            start=self.unelectrified,
        )
