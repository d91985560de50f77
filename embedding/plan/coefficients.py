"""What a neglected term is worth: coefficients that were measured (docs/planner.md) or follow from a closed form."""

from __future__ import annotations

MEMBRANE = 0.8
"""Of the load that membrane theory gives for a stretch, times (t/r)^2: a bound over exact thick spheres and tubes."""
BENT = 0.17
"""The same of the theory with bending (docs/theory/bending.md); the tube at rest is the worst of those measured."""
CLOSED_FACES = 1.6
"""A field on faces at the mid-surface is off by this many thicknesses over size; measured on exact thick spheres."""
ROBIN = 0.02
"""Of the second-order Robin condition, times (reach / radius)^5: in the dipole moment of a sphere off the centre, and a
little more than in the charge of a disc (docs/far_field.md)."""
