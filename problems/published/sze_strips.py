"""Flat plates of Sze, Liu and Lo (2004): cantilever under shear and moment, slit annulus, all with nu = 0.

The tables were read from public repositories that quote the paper: MBDyn tests/plates/sze2004 for all three, and
with the same digits Elmer fem/tests (both strips), TACS examples (shear), FEniCS-Shells demos (annulus) and
Neunteufel's shell notebooks (shear, annulus). The strips have exact solutions: `problems.exact.elastica`, and
`problems.exact.koiter_strip` for a shell of Koiter's energy. The published S4R values differ from the elastica by
up to 0.0035.
"""

from __future__ import annotations

import math

from problems.published.case import SZE, Case, columns

END_SHEAR = Case(
    name="cantilever under end shear",
    source=f"{SZE}, sec. 3.1",
    geometry={"length": 10.0, "width": 1.0, "thickness": 0.1},
    young=1.2e6,
    poisson_ratio=0.0,
    supports="one short edge clamped",
    load="dead total force on the free short edge, normal to the undeformed strip; F L^2 / EI = 4 at the end",
    largest_load=4.0,
    quantities={"shortening": "-U of the tip, along the strip", "deflection": "W of the tip, along the force"},
    table=columns(
        "factor shortening deflection",
        """
        0.05 0.026 0.663
        0.10 0.103 1.309
        0.25 0.563 3.015
        0.50 1.604 4.933
        0.75 2.541 6.031
        1.00 3.286 6.698
        """,
    ),
    mesh="Abaqus S4R, 16 x 1",
    confidence="high",
)

END_MOMENT = Case(
    name="cantilever under end moment",
    source=f"{SZE}, sec. 3.2",
    geometry={"length": 12.0, "width": 1.0, "thickness": 0.1},
    young=1.2e6,
    poisson_ratio=0.0,
    supports="one short edge clamped",
    load="moment on the free short edge about the width; closes the strip to a circle at 2 pi EI / L",
    largest_load=50.0 * math.pi / 3.0,
    quantities={
        "shortening": "-U of the tip, S4R",
        "deflection": "W of the tip, S4R",
        "exact_shortening": "-U of the inextensible strip, as printed",
        "exact_deflection": "W of the inextensible strip, as printed",
    },
    table=columns(
        "factor shortening exact_shortening deflection exact_deflection",
        """
        0.05  0.196  0.196 1.870 1.870
        0.25  4.357  4.361 7.643 7.639
        0.50 12.000 12.000 7.652 7.639
        0.75 14.556 14.546 2.556 2.546
        0.90 13.254 13.247 0.407 0.405
        1.00 12.000 12.000 0.000 0.000
        """,
    ),
    mesh="Abaqus S4R, 16 x 1",
    confidence="high",
)

SLIT_ANNULUS = Case(
    name="slit annular plate under lifting line force",
    source=f"{SZE}, sec. 3.3",
    geometry={"inner_radius": 6.0, "outer_radius": 10.0, "thickness": 0.03},
    young=21e6,
    poisson_ratio=0.0,
    supports="full annulus cut along one radius; one lip clamped, the rest free",
    load="dead force per length on the free lip, out of plane (3.2 in total)",
    largest_load=0.8,
    quantities={"inner": "W of the free lip at r = 6", "outer": "W of the free lip at r = 10"},
    table=columns(
        "factor inner outer",
        """
        0.025  1.305  1.789
        0.050  2.455  3.370
        0.100  4.277  5.876
        0.200  6.725  9.160
        0.400  9.529 12.661
        0.600 11.257 14.674
        0.800 12.642 16.202
        1.000 13.891 17.528
        """,
    ),
    mesh="Abaqus S4R, 10 x 80",
    confidence="high",
    others={"MBDyn, 4-node EAS-ANS, 10 x 80": {"inner": 13.785, "outer": 17.422}},
)
