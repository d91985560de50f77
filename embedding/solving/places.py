"""The displacement of a point of the shell as a linear function of the unknowns."""

from __future__ import annotations

import numpy as np
from ngsolve import BND, ElementId

from embedding.errors import Problem as SceneProblem
from embedding.errors import SceneError
from embedding.geometry.places import locate
from embedding.scene.path import Until
from embedding.solving.continuation import Array
from embedding.solving.problem import Problem


def displacement_row(problem: Problem, until: Until, number: int) -> Array:
    """Weights of the unknowns of u in the displacement that ``until``, of stage ``number``, names.

    With mirror planes the point may lie on either side of them.

    Raises:
        SceneError: the point is not on the mid-surface, or the reduction does not show the axis.
    """
    domain, trace = problem.domain, problem.system.unknowns.trace
    x, y, z = (c / problem.scales.length for c in until.where)
    place = {"3d": (x, y, z), "axisymmetric": (float(np.hypot(x, y)), z), "plane-strain": (x, y)}[domain.reduction.name]
    components = domain.reduction.components(until.axis)
    at = locate(domain, place)
    if not components:
        raise SceneError([SceneProblem(f"path.{number}.until.axis", f'"{until.axis}" does not occur in plane strain')])
    if not at.on_surface:
        away = f"{at.distance * problem.scales.length:.3g} m away from the mid-surface"
        raise SceneError([SceneProblem(f"path.{number}.until.where", f"{list(until.where)} m is not allowed: {away}")])
    element, blocks = ElementId(BND, at.element), np.zeros((trace.components, trace.space.ndof // trace.components))
    shape = np.asarray(trace.scalar.GetFE(element).CalcShape(*at.local)).ravel()
    component = components[0]
    mirrored = until.axis in domain.reduction.planes and place[component] < 0.0
    blocks[component, trace.in_block(trace.scalar.GetDofNrs(element))] = -shape if mirrored else shape
    return blocks.ravel()
