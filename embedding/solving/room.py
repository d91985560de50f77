"""Where the deformed shell is in its space: how far it reaches, and how near it comes to what stands beside it."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from ngsolve import CF, ET, IntegrationRule

from embedding.scene.checks_field import axes_of, centre_of_space
from embedding.solving.problem import Problem


def places(problem: Problem) -> npt.NDArray[np.float64]:
    """Where points of the deformed mid-surface are, (n, 3) in m, several in every element."""
    domain = problem.domain
    rule = IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, 2 * domain.sizes.order)
    points = domain.mesh.MapToAllElements(rule, domain.shell)
    place = domain.reduction.position + problem.system.unknowns.field("u")
    return problem.embed(np.asarray(CF(place)(points)))


def reach(problem: Problem) -> float:
    """Distance of the farthest point of the deformed shell from the centre of space, in shell sizes."""
    scene, away = problem.scene, places(problem) / problem.scales.length
    away[:, axes_of(scene) - 1] -= centre_of_space(scene) / problem.scales.length
    return float(np.linalg.norm(away, axis=1).max())


def gap(problem: Problem) -> float:
    """Narrowest distance between the deformed shell and a body beside it, in shell sizes; infinite without any."""
    scene = problem.scene
    bodies = scene.ambient.bodies if scene.ambient is not None else ()
    axes, where = axes_of(scene), [(float(a), float(b), float(c)) for a, b, c in places(problem)]
    gaps = (body.clearance(place, axes) for body in bodies for place in where)
    return min(gaps, default=math.inf) / problem.scales.length
