"""Where a membrane is in compression: it has no stiffness of its own there, and wrinkles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import IfPos

from embedding.coupling.linear import LinearSolverError
from embedding.geometry.points import sampling_rule
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.state import State

COMPRESSION, ROUNDING = -1e-3, -1e-9
"""The smallest principal stress, in shear moduli, that still counts as no compression, and that which rounding makes of
none."""
TENTH = 0.1
"""A place belongs to the region in compression from a tenth of that on, or of what is found where it is worst: beside
the threshold a uniform compression would be told to be where the mesh happens to make it largest."""
START = 1e-6
"""A displacement, in shell sizes, that is linear in the load; and a small part of a stage."""
MOST = 0.5
"""Share of the area in compression that is most of it."""


def compressed(problem: Problem, scalars: dict[str, float]) -> bool:
    """Is the membrane in compression where nothing keeps it from wrinkling?"""
    return scalars["min_principal_stress"] < COMPRESSION * problem.scales.stress and may_wrinkle(problem)


def strongly_compressed(problem: Problem) -> bool:
    """The same of the present state, whose scalars are not at hand."""
    return may_wrinkle(problem) and float(_stresses(problem, State(problem))[1].min()) < COMPRESSION


def may_wrinkle(problem: Problem) -> bool:
    """Does nothing keep the shell from wrinkling? Bending stiffness does, and so do supports that hold all of a flat
    shell normal to itself."""
    held = {support.held for support in problem.scene.supports if support.where == "surface"}
    kept = problem.domain.is_flat and any("z" in directions for directions in held)
    return not (problem.plan.bending or kept)


def mostly_compressed(problem: Problem) -> bool:
    """Is most of a membrane in compression, however little, where nothing keeps it from wrinkling? Its equilibria are
    none of a membrane then: it turns and bifurcates as its mesh has it."""
    return may_wrinkle(problem) and _share(problem, State(problem), ROUNDING) > MOST


def compressed_from_rest(problem: Problem, here: Target, towards: Target) -> str | None:
    """Where the load ``towards`` compresses a membrane that is at rest at the load ``here``, by its linear response, if
    that is most of it; the state is left as it was."""
    system = problem.system
    saved, ahead = system.save(), towards.between(here, START)
    system.load(ahead.mechanical, ahead.field, ahead.volume, ahead.pressure)
    try:
        step, _ = system.newton_update()
        size = system.displacement_norm(step)
        if not 0.0 < size < math.inf:
            return None
        system.unknowns.state.vec.data += START / size * step
        return region_in_compression(problem, State(problem)) if mostly_compressed(problem) else None
    except LinearSolverError:
        return None
    finally:
        system.restore(saved)
        system.load(here.mechanical, here.field, here.volume, here.pressure)


def region_in_compression(problem: Problem, state: State) -> str:
    """Where the membrane is in compression: share of the area, centre and box of the reference positions, in m."""
    points, stress = _stresses(problem, state)
    threshold = TENTH * max(COMPRESSION, float(stress.min()))
    chosen = stress < threshold
    places = problem.embed(np.asarray(problem.reduction.position(points)).reshape(len(chosen), -1)[chosen])
    if not len(places):
        return ""
    low, high, centre = (_place(f(places, axis=0)) for f in (np.min, np.max, np.mean))
    kind = " (axisymmetric: x is the radius)" if problem.reduction.name == "axisymmetric" else ""
    share = 100 * _share(problem, state, threshold)
    return f"{share:.3g} % of the area around {centre} m, from {low} to {high} m{kind}"


def _stresses(problem: Problem, state: State) -> tuple[Any, npt.NDArray[np.float64]]:
    """Points all over the shell, and the smaller principal stress there."""
    rule = sampling_rule(problem.mesh.dim, problem.domain.sizes.order)
    points = problem.mesh.MapToAllElements(rule, problem.domain.shell)
    return points, np.asarray(state.min_principal_stress(points)).ravel()


def _share(problem: Problem, state: State, threshold: float) -> float:
    """Part of the area with a smaller principal stress below the ``threshold``."""
    inside = IfPos(threshold - state.min_principal_stress, 1.0, 0.0)
    return float(problem.domain.shell_integral(inside) / problem.domain.area)


def _place(point: Any) -> str:
    return "[" + ", ".join(f"{c + 0.0:.3g}" for c in point) + "]"
