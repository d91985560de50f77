"""The linear shell obstacle course and its kin: one number a shell.

T. Belytschko et al., Comput. Methods Appl. Mech. Eng. 51 (1985) 221-258; R. H. MacNeal and R. L. Harder, Finite
Elem. Anal. Des. 1 (1985) 3-20. `reference` is the value everybody quotes. A Kirchhoff-Love shell converges to a
slightly different one: `thin`, where `problems.exact.diaphragm_cylinder` or a converged computation gives it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Obstacle:
    """A linear case. Consistent units, none given in the source."""

    name: str
    geometry: Mapping[str, float]
    young: float
    poisson_ratio: float
    supports: str
    load: str
    quantity: str
    reference: float
    thin: float | None
    notes: str


SCORDELIS_LO = Obstacle(
    name="Scordelis-Lo roof",
    geometry={"radius": 25.0, "length": 50.0, "half_angle_degrees": 40.0, "thickness": 0.25},
    young=4.32e8,
    poisson_ratio=0.0,
    supports="curved ends: displacement in their plane 0, axial free, rotation free; straight edges free",
    load="90 per area, vertically downwards (weight)",
    quantity="downward displacement of the middle of a straight edge",
    reference=0.3024,
    thin=0.300592,
    notes="0.3024 is the obstacle course's; isogeometric Kirchhoff-Love shells converge to 0.3006 (J. Kiendl et al., "
    "Comput. Methods Appl. Mech. Eng. 198 (2009) 3902-3914).",
)

PINCHED_HEMISPHERE = Obstacle(
    name="pinched hemisphere, closed",
    geometry={"radius": 10.0, "thickness": 0.04},
    young=6.825e7,
    poisson_ratio=0.3,
    supports="none but symmetry; equator free",
    load="four radial forces 2 on the equator, 90 degrees apart, alternately outward and inward",
    quantity="radial displacement under each force",
    reference=0.0924,
    thin=None,
    notes="A quarter model carries 1 at either point.",
)

PINCHED_HEMISPHERE_HOLE = Obstacle(
    name="pinched hemisphere with a hole",
    geometry={"radius": 10.0, "thickness": 0.04, "hole_half_angle_degrees": 18.0},
    young=6.825e7,
    poisson_ratio=0.3,
    supports="none but symmetry; equator and rim of the hole free",
    load="four radial forces 2 on the equator, 90 degrees apart, alternately outward and inward",
    quantity="radial displacement under each force",
    reference=0.0940,
    thin=0.0935,
    notes="0.0940 is MacNeal and Harder's; 0.0930 to 0.0940 in the literature. `thin` is half the mean of the two "
    "displacements of `sze_cylinders.HEMISPHERE_SMALL_LOAD`, order-4 elements at a force of 4, to 1e-4.",
)

PINCHED_CYLINDER = Obstacle(
    name="pinched cylinder over rigid diaphragms",
    geometry={"radius": 300.0, "length": 600.0, "thickness": 3.0},
    young=3e6,
    poisson_ratio=0.3,
    supports="on both ends the displacement in the plane of the end circle is 0; axial displacement and rotation free",
    load="two opposite radial forces 1, inward, at half the length",
    quantity="radial displacement under a force",
    reference=1.8248e-5,
    thin=1.828197e-5,
    notes="164.24 F / (E T) by a double Fourier series (G. M. Lindberg, M. D. Olson, G. R. Cowper 1969). `thin` is "
    "the series of Koiter's theory summed to the end, 164.54; Sanders' theory gives 164.49.",
)

ALL = (SCORDELIS_LO, PINCHED_HEMISPHERE, PINCHED_HEMISPHERE_HOLE, PINCHED_CYLINDER)
