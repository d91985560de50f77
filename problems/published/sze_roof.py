"""Hinged cylindrical roofs of Sze, Liu and Lo (2004), isotropic: snap-through and snap-back.

Paths as quoted in MBDyn tests/plates/sze2004/sze38 (files a and d); the geometry also in the Kratos documentation
and, for the thin roof by arc length, in C. Kadapa, Eng. Struct. (2021), doi:10.1016/j.engstruct.2020.111755. The
problem is A. B. Sabir and A. C. Lock's (1972).
"""

from __future__ import annotations

from problems.published.case import SZE, Case, columns

SUPPORTS = (
    "both straight edges hinged: no displacement, free to turn about the edge; both curved edges free. The plan is "
    "508 along the straight edges by 2 R sin(0.1), half opening angle 0.1 rad"
)
QUANTITIES = {"centre": "-W_C: displacement of the loaded centre along the force"}
GEOMETRY = {"radius": 2540.0, "length": 508.0, "half_angle": 0.1}

THICK_ROOF = Case(
    name="hinged cylindrical roof, thickness 12.7",
    source=f"{SZE}, sec. 3.8",
    geometry={**GEOMETRY, "thickness": 12.7},
    young=3102.75,
    poisson_ratio=0.3,
    supports=SUPPORTS,
    load="dead central force, downwards",
    largest_load=3000.0,
    quantities=QUANTITIES,
    table=columns(
        "factor centre",
        """
        0.0877  0.693
        0.1980  1.638
        0.3473  3.087
        0.4686  4.477
        0.5647  5.802
        0.6381  7.057
        0.6908  8.237
        0.7246  9.339
        0.7412 10.358
        0.7421 11.293
        0.7286 12.141
        0.6649 13.583
        0.5643 14.728
        0.4442 15.676
        0.3245 16.590
        0.2272 17.657
        0.1750 19.028
        0.1729 19.852
        0.1905 20.771
        0.2950 22.875
        0.4443 24.663
        0.6644 26.601
        0.8549 27.964
        1.0835 29.374
        """,
    ),
    mesh="Abaqus S4R; the mesh is not given where the table was read",
    confidence="high",
    notes="Limit loads of the table: 2226 and 519.",
)

THIN_ROOF = Case(
    name="hinged cylindrical roof, thickness 6.35",
    source=f"{SZE}, sec. 3.8",
    geometry={**GEOMETRY, "thickness": 6.35},
    young=3102.75,
    poisson_ratio=0.3,
    supports=SUPPORTS,
    load="dead central force, downwards",
    largest_load=3000.0,
    quantities=QUANTITIES,
    table=columns(
        "factor centre",
        """
         0.0517  1.846
         0.1182  5.271
         0.1583  8.257
         0.1837 10.799
         0.1914 11.904
         0.1953 12.892
         0.1950 13.752
         0.1901 14.472
         0.1671 15.501
         0.1323 16.145
         0.0923 16.602
         0.0504 16.915
         0.0083 17.008
        -0.0312 16.697
        -0.0622 15.780
        -0.0739 15.206
        -0.0861 14.767
        -0.1001 14.520
        -0.1142 14.451
        -0.1247 14.862
        -0.1288 15.778
        -0.1271 16.961
        -0.1196 18.320
        -0.0825 21.420
        -0.0006 24.824
         0.1427 28.302
         0.3559 31.720
         0.6417 35.024
         1.0313 38.450
        """,
    ),
    mesh="Abaqus S4R; the mesh is not given where the table was read",
    confidence="high",
    notes="The displacement turns back at 17.01 (load 25) and at 14.45 (load -343): it is no control. The path is "
    "the doubly symmetric one: it bears no comparison with a branch that has left the symmetry.",
)
