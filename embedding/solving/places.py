"""The displacements of points of the shell, as linear functions of the unknowns."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from ngsolve import BND, ElementId

from embedding.errors import Problem as SceneProblem
from embedding.errors import SceneError
from embedding.geometry.places import locate
from embedding.scene.path import Until
from embedding.solving.continuation import Array
from embedding.solving.problem import Problem

NOTHING = 1e-9
"""Weights that rounding leaves of those that vanish at a point."""


def displacement_row(problem: Problem, until: Until, number: int) -> Array:
    """Weights of the unknowns of u in the displacement that ``until``, of stage ``number``, names.

    With mirror planes the point may lie on either side of them.

    Raises:
        SceneError: the point is not on the mid-surface, or the reduction does not show the axis.
    """
    components, trace = problem.domain.reduction.components(until.axis), problem.system.unknowns.trace
    if not components:
        raise SceneError([SceneProblem(f"path.{number}.until.axis", f'"{until.axis}" does not occur in plane strain')])
    numbers, weights = _weights(problem, until.where, f"path.{number}.until.where")
    row = np.zeros((trace.components, trace.space.ndof // trace.components))
    row[components[0], numbers] = weights[components[0]]
    return row.ravel()


def refuse_held(problem: Problem, row: Array, until: Until, number: int) -> None:
    """Raises SceneError if the displacement with the weights ``row``, that ``until`` names, cannot change."""
    prescribed = problem.system.physics.prescribed  # a support may take the point along
    if not prescribed and abs(row[problem.system.unknowns.trace.free]).max(initial=0.0) < NOTHING:
        reason = f"a support or a symmetry of the plan holds this point along {until.axis}"
        raise SceneError([SceneProblem(f"path.{number}.until", f"not allowed: {reason}")])


class Tracked:
    """The displacements of the points that a scene names under ``output.points``.

    Raises:
        SceneError: a point is not on the mid-surface.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem, self._points = problem, problem.scene.output.points
        self._at = {name: _weights(problem, where, f"output.points.{name}") for name, where in self._points.items()}

    def scalars(self) -> dict[str, float]:
        """Components of each displacement in m, u_NAME_x, u_NAME_y, u_NAME_z (plane strain: the first two)."""
        problem, named = self._problem, dict[str, float]()
        trace = problem.system.unknowns.trace
        u = problem.system.unknowns.field("u").vec.FV().NumPy().reshape(trace.components, -1)
        for name, (numbers, weights) in self._at.items():
            shown = problem.scales.length * (weights * u[:, numbers]).sum(axis=1)
            components = dict(zip(problem.reduction.axes, shown, strict=True))
            if "r" in components:
                x, y, _ = self._points[name]
                radial, angle = components.pop("r"), math.atan2(y, x)
                components = {"x": radial * math.cos(angle), "y": radial * math.sin(angle)} | components
            named |= {f"u_{name}_{axis}": float(value) for axis, value in components.items()}
        return named


def _weights(problem: Problem, where: tuple[float, float, float], field: str) -> tuple[npt.NDArray[np.intp], Array]:
    """Unknowns (n,) of each component of u and their weights (d, n) in the displacement of the point ``where``, in m.

    Raises:
        SceneError: the point is not on the mid-surface.
    """
    domain, trace = problem.domain, problem.system.unknowns.trace
    x, y, z = (c / problem.scales.length for c in where)
    place = {"3d": (x, y, z), "axisymmetric": (float(np.hypot(x, y)), z), "plane-strain": (x, y)}[domain.reduction.name]
    at = locate(domain, place)
    if not at.on_surface:
        away = f"{at.distance * problem.scales.length:.3g} m away from the mid-surface"
        raise SceneError([SceneProblem(field, f"{list(where)} m is not allowed: {away}")])
    element = ElementId(BND, at.element)
    shape = np.asarray(trace.scalar.GetFE(element).CalcShape(*at.local)).ravel()
    numbers: npt.NDArray[np.intp] = np.asarray(trace.in_block(trace.scalar.GetDofNrs(element)))
    flips = [axis in domain.reduction.planes and place[c] < 0.0 for c, axis in enumerate(domain.reduction.axes)]
    return numbers, np.asarray(np.where(flips, -1.0, 1.0)[:, None] * shape)
