"""The balance of energies over the last step, from what the steps recorded.

Equilibria store exactly the work that is done on them. Of a step that work is known between two bounds, with the forces
at its beginning and those at its end; the trapezoidal rule lies half way. So the energy that is stored may be off that
rule by half the distance of the bounds, as long as forces grow or fall along the step; a quarter of it is what a force
leaves that grows from nothing like the third power of the way. The whole path, with the error
of its rules, is :mod:`embedding.post.balance`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from embedding.scene import HalfSpace, Scene
from embedding.solving.events import StepRecord
from embedding.solving.problem import Problem
from embedding.solving.solution import Check

PART, ROUNDING, NOTHING = 0.25, 1e-9, 1e-14
"""The most that a step may be off, over the distance of the bounds; and what counts as rounding, of the energies and of
that of a strain of one."""
TOLD = "stored energy less work over the last step, over what the forces' change makes uncertain in the work"


def last_step(problem: Problem, steps: Sequence[StepRecord]) -> Check | None:
    """The check of the last step; None where the steps do not tell all of the work, or there is none before it in the
    same stage."""
    if len(steps) < 2 or steps[-1].stage != steps[-2].stage or not _all_told(problem.scene):
        return None
    before, after = steps[-2], steps[-1]
    pairs = _pairs(problem, before, after)
    if pairs is None:
        return None
    works = [(first * way, last * way) for first, last, way in pairs]
    mean, spread = sum(0.5 * (a + b) for a, b in works), sum(abs(b - a) for a, b in works)
    stored = _stored(after) - _stored(before)
    lengths = 1 if problem.reduction.name == "plane-strain" else 2
    natural = problem.scales.stress * problem.scene.shell.thickest * problem.scales.length**lengths
    floor = max(ROUNDING * max(abs(_stored(after)), abs(stored), abs(mean)), NOTHING * natural)
    off = abs(stored - mean) / max(spread, 2 * floor)
    return Check("energies", off, "", f"<= {PART:g}", off <= PART, TOLD)


def _all_told(scene: Scene) -> bool:
    """Do the scalars of a step tell all forces and where they went?"""
    loads, ambient = scene.loads, scene.ambient
    if not (isinstance(loads.pressure_top, float) and isinstance(loads.pressure_bottom, float)):
        return False
    if loads.variant == "as-published" or any(edge.kind == "follower" for edge in loads.edge_tractions):
        return False
    if getattr(scene.shell.shape, "axial", "held") == "free":
        return False
    return ambient is None or not any(isinstance(body, HalfSpace) for body in ambient.bodies)


def _pairs(problem: Problem, before: StepRecord, after: StepRecord) -> list[tuple[float, float, float]] | None:
    """Force before, force after and the way it went, of everything that does work; None where one is not recorded."""
    a, b = before.scalars, after.scalars
    sources = _sources(a)
    if problem.scene.ambient is not None and not ("field_energy" in a and sources):
        return None  # a field is applied, carried or given
    found = [(a[voltage], b[voltage], b[charge] - a[charge]) for voltage, charge in sources]
    if "load_work" in a:
        found.append((before.factor_mechanical, after.factor_mechanical, b["load_work"] - a["load_work"]))
    if "support_work" in a:
        way = after.factor_mechanical - before.factor_mechanical
        found.append((a["support_work"], b["support_work"], way))
    if a["pressure_difference"] or b["pressure_difference"]:
        if "volume_ratio" not in a or not problem.domain.closed:
            return None
        lengths = 2 if problem.reduction.name == "plane-strain" else 3
        volume = problem.system.lagrangian.reference_volume * problem.scales.length**lengths
        way = volume * (b["volume_ratio"] - a["volume_ratio"])
        found.append((a["pressure_difference"], b["pressure_difference"], way))
    return found or None


def _sources(scalars: Mapping[str, float]) -> list[tuple[str, str]]:
    """The names of voltage and charge of every conductor."""
    suffixes = [name.removeprefix("voltage") for name in scalars if name.split("_")[0] == "voltage"]
    return [(f"voltage{one}", f"charge{one}") for one in suffixes if f"charge{one}" in scalars]


def _stored(step: StepRecord) -> float:
    """Elastic energy, and that of the field at given charges."""
    scalars, sources = step.scalars, _sources(step.scalars)
    field = sum(scalars[voltage] * scalars[charge] for voltage, charge in sources) - scalars.get("field_energy", 0.0)
    return scalars["elastic_energy"] + field
