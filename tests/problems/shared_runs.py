"""Runs in 3D that more than one test module looks at."""

from __future__ import annotations

from functools import cache

from embedding import Solution
from problems import charged_balloon, permeable_sphere


@cache
def charged_in_3d() -> Solution:
    """An eighth of the charged balloon, T/R = 0.1, four steps up to a stretch of 1.2."""
    mesh = ("model.reduction=3d", "discretisation.shell_size=5 mm")
    return charged_balloon.run(*charged_balloon.at(0.1, 1.2), *mesh, "path=[{steps = 4}]")


@cache
def permeable_in_3d() -> Solution:
    """An eighth of the permeable sphere, inflated and magnetised in two steps each."""
    mesh = ("model.reduction=3d", "discretisation.shell_size=8 mm")
    return permeable_sphere.run(*mesh, "path=[{steps = 3, field = 0.0}, {steps = 3}]")
