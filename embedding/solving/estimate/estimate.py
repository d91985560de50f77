"""The relative error of every scalar a solve ends with: a sum over sources, each found in its own way.

==============  =====================================================================================================
source          how it is found
==============  =====================================================================================================
shell           what one more order changes, from the residual of the shell's own equations (:mod:`.enriched`)
geometry        the same, from curving the elements by one order more (where it can be told apart, else in "shell")
ambient         the rest of that change; at rims and sharp edges of conductors its limit over all orders
thickness       what membrane theory misses of a thick wall, times the response to loads (:mod:`.theory`)
shear           what bending without transverse shear leaves out, from the shear forces (:mod:`.bent`)
curling         what rubber bent to a radius not far above its thickness takes less than the theory says (:mod:`.bent`)
opened faces    where a field acts on them, of second order in t/r (:mod:`.theory`)
closed faces    the same at the mid-surface: 1.6 t/r of the field's load and of what the field itself is
rims            the side between the faces of a thick conductor, which the shell has not: t over its width
far field       what Robin's condition makes of the harmonics it is not exact for (ambient/harmonics)
solver          the last update of Newton's method, or of the turns of field and shell
==============  =====================================================================================================

A relative error of the loads becomes one of a scalar through its response d (scalar) / d ln (load), which one more
solve with the tangent at hand gives for all scalars at once. The end of a path does not depend on the steps that led
there: there is no part for them, but for what adds up along a path, whose balances state their own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from embedding.geometry.outline import SHARP_ANGLE
from embedding.geometry.remeshing import one_order_more
from embedding.plan.coefficients import CLOSED_FACES, RIMS
from embedding.plan.far_field import reach_of
from embedding.solving.estimate.bent import Bent
from embedding.solving.estimate.ending import Ending, at_displacement
from embedding.solving.estimate.enriched import Changes, Enriched
from embedding.solving.estimate.theory import Wall, law_of, wall_of
from embedding.solving.events import StepRecord
from embedding.solving.path import Target
from embedding.solving.problem import Problem
from embedding.solving.solution import DISCRETE, ErrorEstimate
from embedding.solving.state import State

Scalars = dict[str, float]
BENT = 0.1
"""Stretch over displacement below which a shell bends more than it stretches."""
STILL = 1e-12
"""Displacement over size of a shell that does not move."""
COUNTED = ("unstable_modes", "remeshings", "min_jacobian", "coupling_iterations", "contraction", "coupling_gap",
           "held_force")  # fmt: skip
"""Scalars that describe the run and not the answer."""
OF_FIELD = ("charge", "flux", "voltage", "potential", "field_energy", "force", "torque", "pressure_top",
            "pressure_bottom")  # fmt: skip
STEEPER = 6.0
"""The error of the energy far away goes like the fifth power of the shell's size over the ambient's radius (sixth in
the plane), so that forces, its derivatives by that size, are off by so many times as much of themselves."""
WALL, CANCELLING = ("thickness", "opened faces"), 2.0
CHARGED, STEEPEST = 2.0, 10.0
THROUGH = 0.15
"""Of the tractions on opened faces of permeable and dielectric shells times (t/r)^2: a bound of the root mean squares
of what was measured on exact spheres of three regions, from mu_r = 2 to 1e6 (tests/problems/test_permeable_sphere).
Tubes in a uniform field are exact (test_tubes_in_a_field)."""
ASIDE = 0.3
"""Of the tractions on both faces times (t/r)^3, in forces: where the shell is hardly seen they nearly cancel, and what
is off in them to the next order. A bound over exact tubes beside a line current, from mu_r = 1.001 to 50."""


@dataclass(frozen=True)
class Estimates:
    """The ``errors`` by scalar, and what came with them: |d ln (displacement) / d ln (load)| as ``response`` and the
    ``condition`` of the tangent, None where they are not known, and the norm of all nodal ``loads``, dimensionless."""

    errors: dict[str, ErrorEstimate]
    response: float | None
    condition: float | None
    loads: float


def estimate_errors(
    problem: Problem, target: Target, steps: Sequence[StepRecord], ending: Ending | None = None
) -> Estimates:
    """Error estimates of all scalars at the present, converged state, the last of ``steps``: at its load, or at the
    displacement that was the ``ending`` of its stage."""
    answers = {name: value for name, value in steps[-1].scalars.items() if name not in COUNTED and value != 0.0}
    scalars = answers | (ending.watch(problem)() if ending is not None else {})
    with one_order_more(problem.domain) as domain:
        richer = Enriched(problem, domain, ending)
        changes = richer.improve(target, scalars, _straight(problem))
        solved = changes is not None and not richer.held
        responses = richer.responses(target) if solved else None
        slopes = richer.slopes() if responses is not None else None
        condition = richer.condition() if solved else None
    singular = solved and responses is None
    adrift = ending is not None and slopes is None
    method = _method(problem, changes, singular=singular, adrift=adrift)
    responses = responses or {}
    limit, wall = _beyond(problem), wall_of(problem, scalars)
    sources = _discretisation(problem, changes, scalars, limit)
    sources |= _theory(problem, wall, scalars, responses) | _field(problem, wall, scalars, responses)
    sources["solver"] = {name: _last_update(problem, steps[-1]) for name in scalars if _moves(name)}
    whole = {} if changes is None else {n: limit * change for n, change in changes.whole.items()}
    if slopes is not None:
        bounds = ("solver", "opened faces") if wall is None or _misplaced_inside(problem, wall) else ("solver",)
        sources = {name: at_displacement(found, slopes, bounds=name in bounds) for name, found in sources.items()}
        whole = at_displacement(whole, slopes)
    errors = {name: _sum(name, value, sources, whole, method) for name, value in answers.items()}
    moved, answer = scalars.get("displacement", 0.0), responses.get("all", {}).get("displacement")
    response = None if answer is None or moved == 0.0 else abs(answer / moved)
    if singular:
        response = math.inf
    return Estimates(errors, response, condition, richer.loads)


def default_quantity(problem: Problem, scalars: Scalars, target: Target, ending: Ending | None) -> str:
    """The scalar that counts as the answer unless the scene says otherwise: the pressure difference where the path
    controls the volume, the load where it ends at a displacement, the field's energy or the pull around a shell that is
    held, else the displacement."""
    if ending is not None:
        return ending.answer(scalars)
    if target.volume is not None:
        return "pressure_difference"
    if problem.held:
        return "field_energy" if "field_energy" in scalars else "pressure_top"
    return "displacement" if scalars["displacement"] > STILL * problem.scales.length else "stretch"


def _straight(problem: Problem) -> Callable[[Callable[[], None]], None]:
    """A function that calls another while the elements have the present geometry."""

    def call(function: Callable[[], None]) -> None:
        mesh, order = problem.mesh, problem.domain.sizes.order
        mesh.Curve(order)
        try:
            function()
        finally:
            mesh.Curve(order + 1)

    def now(function: Callable[[], None]) -> None:
        function()

    return now if problem.domain.base is not None else call  # a new mesh has its geometry from two deformations


def _sum(name: str, value: float, sources: dict[str, Scalars], whole: Scalars, method: str) -> ErrorEstimate:
    parts = {source: abs(errors[name] / value) for source, errors in sources.items() if name in errors}
    if name in whole:
        parts |= _not_beyond(parts, DISCRETE, abs(whole[name] / value))
    wall = sum(errors.get(name, 0.0) for source, errors in sources.items() if source in WALL)
    parts |= _not_beyond(parts, WALL, abs(wall / value))
    return ErrorEstimate(sum(parts.values()), name, method, parts)


def _not_beyond(parts: Scalars, sources: Sequence[str], together: float) -> Scalars:
    """Parts of known signs that cancel, as those of geometry and ambient on coarse meshes, scaled down to
    ``CANCELLING`` times what they change ``together``."""
    found = {source: parts[source] for source in sources if source in parts}
    apart, most = sum(found.values()), CANCELLING * together
    return {source: part * most / apart for source, part in found.items()} if apart > most else {}


def _method(problem: Problem, changes: Changes | None, *, singular: bool, adrift: bool) -> str:
    order, left_out = problem.domain.sizes.order, []
    if changes is None:
        left_out.append("more than that the mesh does not resolve this state")
    if singular:
        left_out.append("what errors of the loads do, at a state whose tangent is singular,")
    if adrift and changes is not None:
        left_out.append("what the load is off by at the displacement where the path ends")
    if problem.domain.rims and not problem.plan.bending and not problem.domain.is_flat:
        left_out.append("bending at held edges")
    if problem.plan.extent == "given":
        left_out.append("the shell's own field")
    method = f"order {order} against {order + 1}, and theory"
    return method + "".join(f"; {one} is NOT included" for one in left_out)


# -- discretisation


def _discretisation(
    problem: Problem, changes: Changes | None, scalars: Scalars, limit: float
) -> dict[str, Scalars]:
    if changes is None:  # the mesh does not resolve the state: nothing of it is certain
        return {"shell": dict(scalars)}
    if problem.system.potential is None:
        found = {"shell": changes.shell, "geometry": changes.geometry}
    else:
        ambient = {name: limit * change for name, change in changes.ambient.items()}
        found = {"shell": changes.shell, "geometry": changes.geometry, "ambient": ambient}
        if problem.plan.coupling == "once":  # Newton's method finds what the coupling left out as well
            found = {"ambient and coupling": {name: limit * change for name, change in changes.whole.items()}}
    return {source: errors for source, errors in found.items() if any(errors.values())}


def _beyond(problem: Problem) -> float:
    """All orders' change over that of the next one. Around an edge at which the normal of a conductor turns by an
    angle, pi at a rim, the potential goes like r^a, a = pi / (pi + angle), and the error falls as order^(-4 a): the
    change from one order to the next is a known part of it. Dielectric and permeable edges are less singular."""
    order = problem.domain.sizes.potential_order
    angle = math.pi if problem.domain.open else problem.domain.facets.sharpest(problem.domain.normal)
    if angle <= SHARP_ANGLE or problem.plan.extent != "surroundings":
        return 1.0
    return float(1.0 / (1.0 - (order / (order + 1)) ** (4 * math.pi / (math.pi + angle))))


# -- theory


def _bent(problem: Problem, scalars: Scalars) -> bool:
    """Does the shell move by bending more than by stretching?"""
    moved = scalars.get("displacement", 0.0) / problem.scales.length
    return problem.plan.bending and abs(scalars["stretch"] - 1.0) < BENT * moved


def _moves(name: str) -> bool:
    """Is it where the shell is?"""
    return name in ("displacement", "stretch", "axial_stretch", "volume_ratio") or name.startswith("u_")


def _theory(
    problem: Problem, wall: Wall | None, scalars: Scalars, responses: dict[str, Scalars]
) -> dict[str, Scalars]:
    found = _of_bending(problem, scalars, responses.get("all", {})) if problem.plan.bending else {}
    if wall is None or _bent(problem, scalars):
        return found
    elastic = wall.elastic(law_of(problem))
    grown = responses.get("all", {})
    missed = {name: -elastic * grown.get(name, 0.0) for name in scalars}
    if "elastic_energy" in missed:
        missed["elastic_energy"] += wall.energy(law_of(problem)) * scalars["elastic_energy"]
    if "pressure" in problem.system.unknowns and "pressure_difference" in scalars:
        missed["pressure_difference"] = elastic * scalars["pressure_difference"]
    field = problem.system.physics.field
    if field is not None and "voltage_jump" in scalars:
        pull = responses.get("field", {})
        missed = {name: value + wall.electric * pull.get(name, 0.0) for name, value in missed.items()}
    return found | {"thickness": {name: value for name, value in missed.items() if value}}


def _of_bending(problem: Problem, scalars: Scalars, responses: Scalars) -> dict[str, Scalars]:
    """What normals that stay normal leave out of the compliance, as an error of the loads."""
    bent = Bent(problem)
    moved = {name: responses.get(name, value) for name, value in scalars.items() if _moves(name)}
    if "elastic_energy" in scalars:
        moved["elastic_energy"] = scalars["elastic_energy"]  # at a load it is as much larger as the compliance
    parts = {"shear": bent.shear, "curling": bent.curling}
    return {source: {name: part * value for name, value in moved.items()} for source, part in parts.items() if part}


# -- field


def _field(
    problem: Problem, wall: Wall | None, scalars: Scalars, responses: dict[str, Scalars]
) -> dict[str, Scalars]:
    ambient, plan = problem.scene.ambient, problem.plan
    if ambient is None or plan.extent != "surroundings":
        return {}
    found, pull = {}, responses.get("field", {})
    own, rims = _own(problem, scalars), _rims(problem)
    if wall is not None:
        found["opened faces" if plan.opened else "closed faces"] = _faces(problem, wall, scalars, responses, own)
    elif not plan.opened:
        off = CLOSED_FACES * _thickness(problem) / _width(problem)
        found["closed faces"] = {name: off * (pull.get(name, 0.0) + own[name]) for name in scalars}
    if rims:
        found["rims"] = {name: rims * (pull.get(name, 0.0) + own[name]) for name in scalars}
    if ambient.outer != "grounded" and not plan.sizes.beyond and plan.sizes.box is None:
        reach = reach_of(problem.scene, ambient) * max(1.0, scalars.get("stretch_max", 1.0))
        off = _missed_far_away(problem, reach)
        found["far field"] = {name: off * (STEEPER * pull.get(name, 0.0) + own[name]) for name in scalars}
    return found


def _faces(
    problem: Problem, wall: Wall, scalars: Scalars, responses: dict[str, Scalars], own: Scalars
) -> Scalars:
    state = State(problem)
    pulled, pull = state.field_pressures(), responses.get("field", {})
    steep = _steepness(sum(pulled), scalars, responses)
    opened = bool(problem.plan.opened)
    off, place = (wall.face(steep), wall.place(steep)) if opened else (2 * [CLOSED_FACES * wall.thin])
    borne = abs(problem.scales.stress * wall.pressure(law_of(problem)))
    off *= min(1.0, sum(map(abs, pulled)) / borne) if borne > 0.0 else 1.0
    missed = {name: -off * pull.get(name, 0.0) - place * own[name] for name in scalars}
    if opened and _misplaced_inside(problem, wall):
        through, aside = THROUGH * wall.thin**2, ASIDE * wall.thin**3
        tractions = dict(zip(("pressure_top", "pressure_bottom"), state.field_tractions(), strict=True))
        for name in scalars:
            of_it = tractions.get(name, abs(own[name]))
            missed[name] = abs(missed[name]) + through * (of_it + abs(pull.get(name, 0.0)))
            missed[name] += aside * sum(tractions.values()) * _lever(state, name)
    return missed


def _misplaced_inside(problem: Problem, wall: Wall) -> bool:
    """Does the field go through the wall, in a way that a shell has not exactly?"""
    field = problem.system.physics.field
    if field is None or field.matter.contrast is None:
        return False
    return not wall.tube or field.varying is not None or bool(field.bodies)


def _lever(state: State, name: str) -> float:
    """From tractions to a force or torque, in m^2 or m^3 (plane strain: m, m^2); 0 for what is neither."""
    if name.startswith("force"):
        return state.area
    return state.area * state.problem.scales.length if name.startswith("torque") else 0.0


def _thickness(problem: Problem) -> float:
    """Over the size of the shell."""
    return float(problem.scene.shell.thickest / problem.scales.length)


def _width(problem: Problem) -> float:
    """What the distance of the faces counts against: the radius of a curved shell, the narrowest of a flat one."""
    shape = problem.scene.shell.shape
    return shape.narrowest / shape.size if problem.domain.is_flat else problem.domain.curvature_radius


def _rims(problem: Problem) -> float:
    """What the sides of a conductor at its rims are worth to the field; where it goes through the shell, less."""
    field = problem.system.physics.field
    if not problem.domain.open or field is None or field.matter.contrast is not None:
        return 0.0
    shape = problem.scene.shell.shape
    return RIMS * problem.scene.shell.thickest / shape.narrowest


def _missed_far_away(problem: Problem, reach: float) -> float:
    field, unknowns = problem.system.lagrangian.field, problem.system.unknowns
    if field is None or "phi" not in unknowns:
        return 0.0
    return field.missed_far_away({"phi": unknowns.field("phi")}, reach)


def _steepness(pull: float, scalars: Scalars, responses: dict[str, Scalars]) -> float:
    """-d ln (pull of the field) / d ln (radius) as the shell grows; 2 where it cannot be told, as of a charged sphere
    at a voltage."""
    grown = responses.get("all", {})
    if pull == 0.0 or not grown.get("stretch"):
        return CHARGED
    both = grown["pressure_top"] + grown["pressure_bottom"]
    slope = -(both / pull) / (grown["stretch"] / scalars["stretch"])
    return min(max(slope, -STEEPEST), STEEPEST)


def _own(problem: Problem, scalars: Scalars) -> Scalars:
    """What an error of the field does to the numbers of the field itself; nothing to those that are given."""
    given = State(problem).given
    return {name: value if name.startswith(OF_FIELD) and name not in given else 0.0 for name, value in scalars.items()}


def _last_update(problem: Problem, step: StepRecord) -> float:
    """The last update of the step, in m."""
    return step.iterations[-1].update * problem.scales.length if step.iterations else 0.0
