"""What a neglected term is worth: coefficients that were measured (docs/planner.md) or follow from a closed form."""

from __future__ import annotations

MEMBRANE = 0.8
"""Of the load that membrane theory gives for a stretch, times (t/R)^2, the thickness now over the radius at rest: a
bound over exact thick spheres and tubes up to twice their size, 0.6 and 0.45 at most."""
BENT = 0.4
"""The same of the theory with bending, 0.17 and 0.37 at most: both from the table that ends docs/theory/bending.md."""
CLOSED_FACES = 1.6
"""A field on faces at the mid-surface is off by this many thicknesses over size; measured on exact thick spheres."""
RIMS = 1.0
"""What the side of a thick conductor at its rims is worth to the field, times thickness over width: a bound over
rectangles of T/L from 0.01 to 0.05 (tests/solving/test_rims.py), 0.9 at most."""
OWN_FIELD = 0.1
"""Of the load on a magnet in a field H, times (M / H) (T / L): what its own field does to it. A bound over clamped
strips that bend by a tenth to nearly all of their length, 0.07 at most."""
TWICE = 2.2
"""Of the load that matter feels in a field, over chi (or chi^2 / (1 + chi) in a uniform one): what counting its space
twice, as the shell and as free space, makes of it; measured on permeable spheres."""
ON_FACES = 1.5
"""The pull on the outer face of a sphere at a voltage, per reference area of its mid-surface, changes by this times T/R
and the strain; measured, to some per cent."""
ROBIN = 0.02
"""Of the second-order Robin condition, times (reach / radius)^5: in the dipole moment of a sphere off the centre, and a
little more than in the charge of a disc (docs/far_field.md)."""
SHEAR = 0.6
"""Of the deflection of a bent shell, times (T/L)^2: transverse shear, as of a cantilever (Timoshenko's beam)."""
