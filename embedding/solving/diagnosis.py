"""Why a path stopped: the true cause behind a step that would not converge."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from embedding.coupling.linear import LinearSolverError
from embedding.solving.ahead import look_ahead
from embedding.solving.compression import mostly_compressed, region_in_compression
from embedding.solving.estimate.bent import SHARP, Bent
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result
from embedding.solving.room import reach
from embedding.solving.state import State

HIDDEN, USUAL = 1e4, 0.2
"""Stiffness of bending over that of stretching, in roundings, at which Newton's method may fail for want of digits, in
elements of the usual size of so many shell sizes: smaller ones are stiffer against stretching."""
FOLLOWED = frozenset({Result.MAX_ARC, Result.MAX_STEPS})
LOST = FOLLOWED | {Result.STEP_BELOW_MINIMUM, Result.LINEAR_SOLVER_FAILED}
"""Results that may have another cause than they say."""
PROBE = 1e-4
STEEP = 5.0
CROWDED = 0.9
"""Finite difference of the response, how much steeper a limit point is than the landmark, and the part of space that a
shell may reach to."""


def response_rate(problem: Problem, here: Target, towards: Target) -> float:
    """How fast the shell moves per unit of stage, at the converged state ``here``: it blows up at a limit point.

    A linearised step towards a target ``PROBE`` of the way ahead; the state is left as it was.
    """
    system = problem.system
    saved = system.save()
    ahead = towards.between(here, PROBE)
    try:
        system.load(ahead.mechanical, ahead.field, ahead.volume, ahead.pressure)
        if system.potential is not None:
            system.potential.solve()
        step, _ = system.newton_update()
        return system.displacement_norm(step) / PROBE
    except LinearSolverError:
        return float("inf")
    finally:
        system.restore(saved)
        system.load(here.mechanical, here.field, here.volume, here.pressure)


@dataclass(frozen=True)
class Landmark:
    """An accepted state about one planned step before the end of the road: saved state, load, fraction of the stage;
    once the mesh it belongs to is gone, how fast the shell moved there."""

    saved: Any
    target: Target
    fraction: float
    rate: float | None = None

    def measured(self, problem: Problem, end: Target) -> Landmark:
        """The landmark with its rate per unit of stage; the present state is left as it was, at the landmark's load."""
        if self.rate is not None:
            return self
        saved = problem.system.save()
        problem.system.restore(self.saved)
        rate = response_rate(problem, self.target, end) / (1 - self.fraction)
        problem.system.restore(saved)
        return replace(self, rate=rate)


def diagnose(
    problem: Problem, reason: Result, here: Target, failed: Target, stage: Way, landmark: Landmark | None
) -> tuple[Result, str]:
    """Refine the ``reason`` why there is no step from the last good state, at the load ``here``, to ``failed``; and
    words about it, if there is more to say than the reason's own.

    The path is followed by arc length to see. A membrane that comes into compression on it ends there, and what its
    mesh makes of the path behind is no limit point. Where it cannot be followed, this tells: near a limit point at the
    load p* the response grows like (p* - p)^(-1/2). The steps were cut down to a tiny part of the planned one, so
    between the ``landmark`` and here it must have grown manyfold; where Newton fails for another reason it has hardly
    changed.
    A limit point comes first: the wild updates beside it may fail in any way, turning the ambient over included.
    """
    if reason is Result.COMPRESSIVE_MEMBRANE or stage.end.volume is not None:
        return crowded(problem, reason)
    end, detail = crowded(problem, reason)
    if detail and not _grounded(problem):  # where space goes on, its mesh is no part of the structure
        return end, detail
    if problem.plan.coupling != "once":  # whose states are no equilibria of the joint system
        ahead = look_ahead(problem, here, failed, stage.tolerance)
        if ahead.compressed is not None:
            return Result.COMPRESSIVE_MEMBRANE, ahead.compressed
        if ahead.limit is not None:
            return limit_reason(problem, here, stage.end), largest(problem, ahead.limit)
        if ahead.reached:
            return crowded(problem, reason)
    if mostly_compressed(problem):
        return Result.COMPRESSIVE_MEMBRANE, region_in_compression(problem, State(problem))
    if landmark is not None:
        before = landmark.measured(problem, stage.end).rate
        now = response_rate(problem, here, stage.end) / (1 - stage.fraction)
        if before is not None and now > STEEP * before:
            return limit_reason(problem, here, stage.end), ""
    return crowded(problem, reason)


@dataclass(frozen=True)
class Way:
    """The stage to ``end``, of which a ``fraction`` is done, and the solver's ``tolerance``."""

    end: Target
    fraction: float
    tolerance: float


def limit_reason(problem: Problem, here: Target, end: Target) -> Result:
    """What a limit point on the way to ``end`` is a limit of."""
    return Result.PULL_IN if _has_sources(problem) and end.field != here.field else Result.LIMIT_POINT


def largest(problem: Problem, limit: Target) -> str:
    """The load of a limit point in words."""
    return f"the load is largest at {limit.told(problem.scene.ramped)}"


def crowded(problem: Problem, reason: Result) -> tuple[Result, str]:
    """The ``reason`` itself, unless the shell has come to the end of the meshed space: then that, and where."""
    radius = problem.plan.sizes.radius
    if reason not in (Result.STEP_BELOW_MINIMUM, Result.INVERTED_AMBIENT) or not problem.system.motions:
        return reason, ""
    far = reach(problem)
    if problem.plan.sizes.box is not None or far < CROWDED * radius:
        return reason, ""
    ends = f"the meshed space ends at the radius {radius * problem.scales.length:.4g} m"
    return Result.INVERTED_AMBIENT, f"the shell reaches to {far * problem.scales.length:.4g} m, and {ends}"


def out_of_theory(problem: Problem, reason: Result) -> Result:
    """The ``reason`` why a path ended, or what lies behind it at the last good state: a shell too thin for the digits
    of a number, or one that bends too sharply for a theory of shells."""
    if reason not in LOST or not problem.plan.bending:
        return reason
    ratio, sizes = problem.scene.shell.thickest / problem.scales.length, problem.domain.sizes
    finest = min((length for _, length in sizes.edges), default=sizes.shell)  # stiff as it stretches, as 1 / length
    if reason not in FOLLOWED and ratio**2 * min(1.0, finest / USUAL) < HIDDEN * float(np.finfo(float).eps):
        return Result.TOO_THIN
    return Result.SHARPLY_BENT if Bent(problem).sharpest > SHARP else reason


def _grounded(problem: Problem) -> bool:
    return problem.scene.ambient is not None and problem.scene.ambient.outer == "grounded"


def _has_sources(problem: Problem) -> bool:
    """Is there a field at all: an electrode at a voltage, or an applied field?"""
    field = problem.system.physics.field
    if field is None:
        return False
    return field.driven
