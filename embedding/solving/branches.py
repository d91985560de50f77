"""From one branch of equilibria to another, at the point where they cross."""

from __future__ import annotations

from dataclasses import dataclass

from embedding.solving.continuation import Corrector, Direction, Metric, Watch
from embedding.solving.critical import Critical
from embedding.solving.curve import Point


@dataclass
class BranchAsked:
    """A branch that a ``stage`` asks for, by the ``number`` of its bifurcation: how many were ``met`` so far, and
    whether the path was ``left`` for it."""

    stage: str
    number: int
    met: int = 0
    left: bool = False


def onto_branch(
    corrector: Corrector, metric: Metric, critical: Critical, amplitude: float, watch: Watch
) -> Point | None:
    """The state on the crossing branch in which the critical mode has the (signed) ``amplitude``; None without one.

    The condition mode . M (x - x_c) = amplitude takes the place of the load: the state is an equilibrium of the perfect
    structure, and the path it came from, on which that product is zero, does not meet it. Its tangent leads away.
    Source: Keller's method of branch switching, see the theory page "Critical points".
    """
    equilibrium, at = corrector.equilibrium, critical.point
    mode = Direction(critical.mode, 0.0)
    equilibrium.restore(at.saved)
    guess = at.values + amplitude * critical.mode
    plane = metric.plane(mode, guess, at.parameter)
    correction = corrector.correct(guess, at.parameter, plane, watch, thorough=True, straight=True)
    if correction.reason is not None or correction.response is None:
        return None
    values, parameter = equilibrium.values(), equilibrium.parameter
    away = Direction(values - at.values, parameter - at.parameter)
    tangent = metric.unit(Direction(correction.response, 1.0))
    if metric.inner(tangent, away) < 0.0:
        tangent = tangent.scaled(-1.0)
    place = at.place + metric.length(away)
    return Point(values, parameter, place, tangent, equilibrium.unstable_modes(), equilibrium.save())
