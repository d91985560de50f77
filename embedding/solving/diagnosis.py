"""Why a path stopped: the true cause behind a step that would not converge."""

from __future__ import annotations

from embedding.coupling.linear import LinearSolverError
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.result import Result

PROBE = 1e-4
STEEP = 4.0
COMPRESSION = -1e-3
"""Finite difference of the response, what counts as steep against earlier in the stage, and the smallest principal
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


def diagnose(problem: Problem, reason: Result, here: Target, towards: Target, usual_rate: float) -> Result:
    """Refine the ``reason`` Newton gave, at the last good state; ``usual_rate`` is the rate earlier in the stage.

    A limit point comes first: the wild updates beside it may fail in any way, turning the ambient over included.
    """
    if reason is Result.COMPRESSIVE_MEMBRANE:
        return reason
    controlled = towards.volume is None and usual_rate > 0
    if controlled and response_rate(problem, here, towards) > STEEP * usual_rate:
        moving_field = _has_sources(problem) and towards.field != here.field
        return Result.PULL_IN if moving_field else Result.LIMIT_POINT
    return reason


def compressed(problem: Problem, scalars: dict[str, float]) -> bool:
    """Is the membrane in compression where nothing keeps it from wrinkling?

    A flat shell whose whole surface is held normal to itself cannot wrinkle; every other membrane can.
    """
    if scalars["min_principal_stress"] >= COMPRESSION * problem.scales.stress:
        return False
    held = {support.fix for support in problem.scene.supports if support.where == "surface"}
    flat = problem.domain.mean_curvature == 0.0
    return not (flat and any("z" in fix for fix in held))


def _has_sources(problem: Problem) -> bool:
    """Is there a field at all: an electrode at a voltage, or an applied field?"""
    field = problem.system.physics.field
    if field is None:
        return False
    return any((field.electrodes.top, field.electrodes.bottom, *field.applied))
