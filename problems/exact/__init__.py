"""Closed-form and exact reference solutions, independent of the finite element code.

One module a body: `plate`, `cylinder` (held length), `open_tube` (free length) and `sphere` are purely
mechanical; `charged_balloon` and `charged_tube` are conductors at a voltage; `permeable_sphere` and
`permeable_cylinder` are linear shells in a uniform field. `material` holds the laws.

Fields: `dielectric_film`, `dielectric_balloon` and `dielectric_tube` have electrodes on both faces; `capacitance`,
`conducting_spheres` and `charged_disc` are rigid conductors; `mems` is pull-in over a rigid electrode;
`hard_magnetic_elastica` a remanent cantilever; `radial_modes` the force on permeable shells that change their shape;
`magnetised_shell` remanent, saturated and normally magnetised shells; `line_current` a tube beside or around a wire.

For shells with bending and for membranes: `circular_membrane` and its small-strain limit `hencky`; `flexure`
(exact block in bending); `elastica`, `koiter_strip` (a strip of the shell's own energy), `arch` and
`circular_arch` (snap-through); linear `plates`, `edge_bending` and `diaphragm_cylinder`; critical loads in
`buckling`. Published tables without a closed form are in `problems.published`.

Conventions: the top face is the outer one; a positive pressure pushes on its face; radius and thickness
belong to the undeformed body, the radius to its middle; a stretch without further name is the hoop stretch
of that material mid-surface. Any consistent units; `thickness_ratio` is T/R, the default modulus 1.
"""
