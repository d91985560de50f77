"""T-section cantilever: a branched shell with a kink (Neunteufel and Schoberl 2019)."""

from __future__ import annotations

from problems.published.case import Case, columns

T_CANTILEVER = Case(
    name="T-section cantilever under a line force",
    source="M. Neunteufel, J. Schoberl, The Hellan-Herrmann-Johnson method for nonlinear shells, Comput. Struct. "
    "225 (2019); the table stands in the authors' notebook tstruct_hhj",
    geometry={"side": 1.0, "thickness": 0.1},
    young=6.2e6,
    poisson_ratio=0.0,
    supports="web: the square x = 0, 0 < y < 1, 0 < z < 1, clamped on z = 0; flange: the square z = 1, -1/2 < x < "
    "1/2, 0 < y < 1, joined to the web at a right angle that is kept",
    load="dead force per length (q, 0, q) on the flange's edge x = -1/2, q up to `largest_load`",
    largest_load=3000.0,
    quantities={
        "loaded": "x displacement of the corner (-1/2, 0, 1)",
        "opposite": "-z displacement of the corner (1/2, 0, 1)",
    },
    table=columns(
        "factor loaded opposite",
        """
        0.05 0.198 0.168
        0.10 0.409 0.334
        0.20 0.721 0.551
        0.30 0.901 0.660
        0.40 1.011 0.720
        0.50 1.085 0.755
        0.60 1.137 0.777
        0.80 1.208 0.803
        1.00 1.253 0.815
        """,
    ),
    mesh="not stated",
    confidence="medium",
    notes="E is 6.2e6 in the authors' program and 6e6 in the text beside it; the program's is taken.",
)
