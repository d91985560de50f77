"""Published benchmark values, typed from the papers, each with its source and how sure it is.

`case` holds the form of an entry. One module a family: `sze_strips` and `sze_cylinders` (Sze, Liu and Lo 2004),
`sze_roof` (the hinged roofs of the same paper), `t_cantilever`, `obstacle_course` (linear), `hard_magnetic_beam`
(an experiment). Closed forms are in `problems.exact`.
"""
