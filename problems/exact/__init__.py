"""Closed-form and exact reference solutions, independent of the finite element code.

One module a body: `plate`, `cylinder`, `sphere` (mechanics), `charged_balloon`, `charged_tube` (a conductor
at a voltage), `permeable_sphere`, `permeable_cylinder` (a linear shell in a uniform field). `material` holds
the laws.

Conventions: the top face is the outer one; a positive pressure pushes on its face; `radius` and `thickness`
belong to the undeformed body, the radius to its middle; a stretch without further name is the hoop stretch of
that material mid-surface. Units are free but must be consistent; most functions are called with moduli and
radius 1.
"""
