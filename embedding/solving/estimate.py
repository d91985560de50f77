"""The error statement of a solve: what one more polynomial order would change, and the model's own error.

Discretisation: the converged state is carried to the next order, on the same elements with their geometry refined as
well, and two Newton steps are taken there: their effect on the answer estimates the error without a second solve.

Model: with t the deformed thickness and r the deformed radius, the load that membrane theory gives for a stretch is
off by up to 0.8 (t/r)^2 of itself, and the load of a field on closed faces by up to 1.6 t/r: bounds of what was
measured against exact thick spheres and tubes. A shell that is bent rather than stretched leaves out transverse shear,
0.6 (T/L)^2 of the deflection of a cantilever, and a law of small strains is off by the strain. A relative error of the
load becomes one of the stretch through the response d ln(stretch) / d ln(load) of the last steps.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from ngsolve import BND

from embedding.coupling.linear import LinearSolverError
from embedding.coupling.system import System
from embedding.geometry.domain import Domain
from embedding.geometry.ends import unknowns_on
from embedding.geometry.outline import SHARP_ANGLE
from embedding.geometry.remeshing import one_order_more
from embedding.shell.bending import CurveBending
from embedding.solving.events import StepRecord
from embedding.solving.path import Target
from embedding.solving.problem import Problem, physics_of
from embedding.solving.solution import ErrorEstimate
from embedding.solving.state import State

THEORY = 0.8
CLOSED_FACES = 1.6
SHEAR = 0.6
BENT = 0.1
NEWTON_STEPS, NEAR = 2, 0.01
"""Steps on the next order. After one shorter than ``NEAR`` (shell sizes) its tangent serves for the other as well."""


def estimate_error(problem: Problem, target: Target, steps: Sequence[StepRecord]) -> ErrorEstimate:
    """Relative error of the answer at the present, converged state, the last of ``steps``.

    The answer is the mean stretch, the mean displacement of a shell that is bent, the pressure difference where the
    path controls the volume, or the field's energy around a shell that is held (without an applied field, whose own
    energy has no end).
    """
    if _held(problem) and "field_energy" in steps[-1].scalars:
        return _held_estimate(problem, target)
    controlled = target.volume is not None
    bent = _bent(problem, steps[-1].scalars)
    quantity = "pressure_difference" if controlled else "displacement" if bent else "stretch"
    response = 1.0 if controlled or bent else _response(steps)
    slenderness = _slenderness(problem, steps[-1].scalars)
    parts = _bending_parts(problem, steps[-1].scalars) if bent else {"shell theory": response * THEORY * slenderness**2}
    if problem.system.motions and not problem.plan.opened:
        parts["closed faces"] = response * CLOSED_FACES * slenderness
    order = problem.domain.sizes.order
    change = _enriched_change(problem, target, quantity)
    if change is None:
        return ErrorEstimate(sum(parts.values()), quantity, "thickness only; discretisation is NOT included", parts)
    # From a rung below the joint one, Newton's steps find what the coupling left out as well.
    parts["discretisation and coupling" if problem.plan.coupling == "once" else "discretisation"] = change
    method = f"thickness, and the change from order {order} to order {order + 1}"
    if problem.domain.rims and not problem.plan.bending:
        method += "; bending at held edges is NOT included"
    return ErrorEstimate(sum(parts.values()), quantity, method, parts)


def _held(problem: Problem) -> bool:
    """Is there a field, and nothing of the shell can move?"""
    return problem.system.potential is not None and not problem.system.unknowns.trace.free.any()


def _held_estimate(problem: Problem, target: Target) -> ErrorEstimate:
    """Of the energy. Around an edge at which the normal of a conductor turns by an angle, pi at a rim, the potential
    goes like r^a, a = pi / (pi + angle), and the error falls as order^(-4 a): the change from one order to the next is
    a known part of it. Dielectric and permeable edges are less singular."""
    order = problem.domain.sizes.potential_order
    change = _enriched_change(problem, target, "field_energy")
    if change is None:
        return ErrorEstimate(0.0, "field_energy", "discretisation is NOT included", {})
    method = f"the change from order {order} to order {order + 1} of the potential; the thickness is NOT included"
    angle = math.pi if problem.domain.open else problem.domain.facets.sharpest(problem.domain.normal)
    if angle > SHARP_ANGLE:
        change /= 1.0 - (order / (order + 1)) ** (4 * math.pi / (math.pi + angle))
        method = f"at {'rims' if problem.domain.open else 'sharp edges'}, the limit of {method}"
    return ErrorEstimate(change, "field_energy", method, {"discretisation": change})


def _bent(problem: Problem, scalars: dict[str, float]) -> bool:
    """Does the shell move by bending more than by stretching?"""
    moved = scalars["displacement"] / problem.scales.length
    return problem.plan.bending and abs(scalars["stretch"] - 1.0) < BENT * moved


def _bending_parts(problem: Problem, scalars: dict[str, float]) -> dict[str, float]:
    """Model errors of a bent shell: the transverse shear it leaves out, and strains beyond those of a linear law."""
    thickness = problem.scene.shell.thickest / problem.scales.length
    parts = {"transverse shear": SHEAR * thickness**2}
    if not problem.system.physics.law.incompressible:
        parts["small strains"] = max(abs(scalars["stretch_max"] - 1.0), abs(scalars["stretch_min"] - 1.0))
    return parts


def _slenderness(problem: Problem, scalars: dict[str, float]) -> float:
    """t / r of the deformed shell; 0 for flat shapes, whose in-plane deformation the theory has exactly."""
    if problem.domain.is_flat:
        return 0.0
    stretch = scalars["stretch"]
    across = scalars.get("axial_stretch", problem.system.physics.axial_stretch)
    other = across if problem.reduction.name == "plane-strain" else stretch
    thickness = problem.scene.shell.thickest / problem.scales.length
    return thickness / problem.domain.curvature_radius / (stretch * stretch * other)


def _response(steps: Sequence[StepRecord]) -> float:
    """|d ln(stretch) / d ln(load)| at the last step, from a parabola through the last three of its stage.

    Field forces grow with the square of the field's factor. A single step is taken to answer linearly.
    """
    stage = [step for step in steps if step.stage == steps[-1].stage][-3:]
    field = "min_jacobian" in stage[-1].scalars and stage[-1].factor_field != stage[0].factor_field
    factors = [step.factor_field**2 if field else step.factor_mechanical for step in stage]
    stretches = [math.log(step.scalars["stretch"]) for step in stage]
    if len(stage) < 2 or min(factors) <= 0.0 or len(set(factors)) < len(stage):
        return abs(stretches[-1])
    loads = np.log(factors) - math.log(factors[-1])
    slope: float = np.polyfit(loads, stretches, len(stage) - 1)[-2]
    return float(abs(slope))


def _enriched_change(problem: Problem, target: Target, quantity: str) -> float | None:
    before = State(problem).scalars()[quantity]
    with one_order_more(problem.domain) as domain:
        richer = Enriched(problem, domain)
        after = State(richer).scalars()[quantity] if richer.improve(target) else None
    return None if after is None else abs(after - before) / max(abs(before), 1e-300)


class Enriched(Problem):
    """The same problem with the fields of ``domain``, of one order more on the same elements, started from the present
    state."""

    def __init__(self, problem: Problem, domain: Domain) -> None:
        self.scene, self.plan, self.scales = problem.scene, problem.plan, problem.scales
        self.reduction = problem.reduction
        self.domain = domain
        physics = physics_of(self.scene, self.plan, self.scales, self.domain)
        self.system = System(self.domain, physics, self.scene.solver.linear)
        for name in self.system.unknowns.names:
            self._carry(name, problem)
        counted, present = self.system.unknowns.bending, problem.system.unknowns.bending
        if isinstance(counted, CurveBending) and isinstance(present, CurveBending):
            counted.continue_from(present)
        self.system.ambient_as_in(problem.system)
        self.system.restore(self.system.save())  # the state did not get here by Newton steps

    def _carry(self, name: str, problem: Problem) -> None:
        richer, present = self.system.unknowns.field(name), problem.system.unknowns.field(name)
        if name in ("pressure", "axial"):
            richer.vec[0] = present.vec[0]
        elif name in ("u", "y_t", "y_b", "o_t", "o_b", "tau_t", "tau_b"):
            richer.Set(present, BND, definedon=self.domain.shell)
            unknowns = self.system.unknowns
            richer.vec.FV().NumPy()[~(unknowns.trace.free if name == "u" else unknowns.face_free)] = 0.0
        elif name == "moment":
            richer.Set(present, BND, definedon=self.domain.shell)
        elif name == "rotation":
            facets = np.flatnonzero(self.domain.facets.neighbours > 0)
            for facet in facets:  # the polynomials on an edge are hierarchical
                old, new = (unknowns_on(field.space, np.array([facet])) for field in (present, richer))
                richer.vec.FV().NumPy()[new[: len(old)]] = present.vec.FV().NumPy()[old]

    def improve(self, target: Target) -> bool:
        """Take Newton steps at ``target``; False if they cannot be taken. Around a shell that is held, with its faces
        on the mid-surface, the potential is all that changes."""
        system = self.system
        alone = _held(self) and not self.plan.opened
        system.load(target.mechanical, target.field, target.volume, target.pressure)
        size = math.inf
        try:
            for _ in range(NEWTON_STEPS):
                if not system.follow():
                    return False
                if system.potential is not None:
                    system.potential.solve()
                if alone:
                    break
                residual = system.residual()
                if not size < NEAR:
                    system.linearise()
                step = system.solve(residual)
                size = system.displacement_norm(step)
                system.unknowns.state.vec.data -= step
        except LinearSolverError:
            return False
        return system.follow()
