"""Why a path stopped: the true cause behind a step that would not converge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from embedding.coupling.linear import LinearSolverError
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result

PROBE = 1e-4
STEEP = 5.0
COMPRESSION = -1e-3
"""Finite difference of the response, how much steeper a limit point is than the landmark, and the smallest principal
stress, in shear moduli, that still counts as no compression."""


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
    """An accepted state about one planned step before the end of the road: saved state, load, fraction of the stage."""

    saved: Any
    target: Target
    fraction: float


def diagnose(
    problem: Problem, reason: Result, here: Target, end: Target, fraction: float, landmark: Landmark | None
) -> Result:
    """Refine the ``reason`` Newton gave at the last good state, ``fraction`` of the way through a stage to ``end``.

    Near a limit point at the load p* the response grows like (p* - p)^(-1/2). The steps were cut down to a tiny part of
    the planned one, so between the ``landmark`` and here it must have grown manyfold; where Newton fails for another
    reason it has hardly changed. A limit point comes first: the wild updates beside it may fail in any way, turning the
    ambient over included.
    """
    if reason is Result.COMPRESSIVE_MEMBRANE or end.volume is not None or landmark is None:
        return reason
    system = problem.system
    saved = system.save()
    system.restore(landmark.saved)
    before = response_rate(problem, landmark.target, end) / (1 - landmark.fraction)
    system.restore(saved)
    now = response_rate(problem, here, end) / (1 - fraction)
    if now > STEEP * before:
        moving_field = _has_sources(problem) and end.field != here.field
        return Result.PULL_IN if moving_field else Result.LIMIT_POINT
    return reason


def compressed(problem: Problem, scalars: dict[str, float]) -> bool:
    """Is the membrane in compression where nothing keeps it from wrinkling?

    A flat shell whose whole surface is held normal to itself cannot wrinkle; every other membrane can.
    """
    if scalars["min_principal_stress"] >= COMPRESSION * problem.scales.stress:
        return False
    held = {support.held for support in problem.scene.supports if support.where == "surface"}
    flat = problem.domain.is_flat
    return not (flat and any("z" in directions for directions in held))


def _has_sources(problem: Problem) -> bool:
    """Is there a field at all: an electrode at a voltage, or an applied field?"""
    field = problem.system.physics.field
    if field is None:
        return False
    return any((field.electrodes.top, field.electrodes.bottom, *field.applied))
