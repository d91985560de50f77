"""The balance of energies along a path: the work of loads, supports and sources against what is stored.

Equilibria on the way from rest store exactly the work done on them. What is recorded at the steps tells the work up to
the error of a rule for integrals along the path: of second order in the steps for the trapezoidal rule, of fourth for
cubic curves. A residual that does not fall so is a defect of the equilibria. See docs/post.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.post.conductors import conductors
from embedding.post.faces import Face
from embedding.post.integrals import closed, enclosed
from embedding.post.measure import Measure
from embedding.post.patches import Patch
from embedding.post.path import apart, cubic, explicit, trapezoidal
from embedding.post.probe import Source, opened
from embedding.post.space import Space
from embedding.post.table import PostError, Table
from embedding.scene import Scene

Floats = npt.NDArray[np.float64]
SAME_LOAD = 1e-9
NOTES = (
    "residual: stored less work, by the trapezoidal rule; path_error: how far that rule is from cubic curves through"
    " the steps, unknown after a stage of one step; residual_cubic: stored less work by those curves",
)


@dataclass(frozen=True)
class Contribution:
    """Work as the integral of ``force`` d ``place`` over the steps, the state of rest first."""

    name: str
    force: Floats
    place: Floats


def energy_balance(archive: Source) -> Table:
    """Stored energy and work at every step, J (plane strain: J/m), counted from the state of rest.

    Columns: ``elastic_energy``; ``field_energy``, that of the field and its matter at given charges; ``stored``, their
    sum; ``work_loads`` (dead loads and moments), ``work_pressure``, ``work_supports``, ``work_sources`` (voltages
    on charges), each where there is such a thing, and ``work``, their sum, by the trapezoidal rule; ``work_explicit``,
    with the forces at the beginning of each step, off by terms of first order; ``work_cubic``; ``residual``,
    ``residual_explicit``, ``residual_cubic``, stored less work; ``path_error``, the sum over the steps of how far the
    trapezoidal rule is from the cubic curves, nan after a stage with too few steps to tell. A run that does not begin
    at rest (prestretched, magnetised, from the state of another run) is counted from its first step.

    Raises:
        PostError: no step, or work that the archive does not tell: of applied fields, of forces that follow an edge, of
            moments on edges in space, of the published variant of pressures, of a free tube; or no equilibria.
        ArchiveError: the archive cannot be read.
    """
    run = opened(archive)
    scene = run.scene_object()
    _refuse(run, scene)
    contributions = _contributions(run, scene)
    stages = _stages(run, scene)
    if _at_rest(scene) and run.start != "neighbour":
        stages = [stages[0], *stages]
        first = 1
    else:
        contributions = [Contribution(one.name, one.force[1:], one.place[1:]) for one in contributions]
        first = 0
    columns = _stored(run)
    start = 0.0 if first else columns["stored"][0]
    works = {rule.__name__: np.zeros(len(stages)) for rule in (trapezoidal, explicit, cubic)}
    away = np.zeros(len(stages) - 1)
    for one in contributions:
        increments = {name: _by_stages(name, one, stages) for name in works}
        for name, values in increments.items():
            works[name][1:] += np.cumsum(values)
        away += _by_stages("apart", one, stages)
        done = _from_first(np.cumsum(increments["trapezoidal"]), first)
        columns[f"work_{one.name}"] = columns.get(f"work_{one.name}", 0.0) + done
    columns["work"] = works["trapezoidal"][first:]
    columns |= {f"work_{name}": works[name][first:] for name in ("explicit", "cubic")}
    columns["residual"] = columns["stored"] - start - columns["work"]
    columns |= {f"residual_{n}": columns["stored"] - start - columns[f"work_{n}"] for n in ("explicit", "cubic")}
    columns["path_error"] = _from_first(np.cumsum(away), first)
    unit = "J/m" if Space.of(run).reduction == "plane-strain" else "J"
    known: dict[str, npt.NDArray[np.generic]] = {
        "step": np.arange(1, len(run) + 1),
        "factor_mechanical": run.scalars["factor_mechanical"],
        "factor_field": run.scalars["factor_field"],
    }
    return Table(known | columns, dict.fromkeys(columns, unit), NOTES)


RULES = {rule.__name__: rule for rule in (trapezoidal, explicit, cubic, apart)}


def _stages(run: Archive, scene: Scene) -> list[int]:
    """The number of every step's stage. Stages may share a name: one ends where its loads are first met."""
    numbers, number, path = [], 0, scene.path
    for step in run.steps:
        while number + 1 < len(path) and path[number].name != step.stage:
            number += 1
        numbers.append(number)
        stage = path[number]
        gaps = step.factor_mechanical - stage.mechanical, step.factor_field - stage.field
        ends_at_loads = stage.until is None and stage.volume_ratio is None
        if ends_at_loads and max(map(abs, gaps)) <= SAME_LOAD and number + 1 < len(path):
            number += 1
    return numbers


def _by_stages(rule: str, one: Contribution, stages: list[int]) -> Floats:
    """Increments of the work; a path may have a kink where a stage begins, and no curve goes across it."""
    ends = [0, *(i for i in range(1, len(stages) - 1) if stages[i + 1] != stages[i]), len(stages) - 1]
    pieces = [slice(begin, end + 1) for begin, end in zip(ends[:-1], ends[1:], strict=True)]
    return np.concatenate([RULES[rule](one.force[piece], one.place[piece]) for piece in pieces])


def _from_first(summed: Floats, first: int) -> Floats:
    return summed if first else np.concatenate([[0.0], summed])


def _refuse(run: Archive, scene: Scene) -> None:
    loads = scene.loads
    if scene.ambient is not None and "field_energy" not in run.scalars:
        raise PostError(f"{run.path}: the energy of a field is not recorded where a field is applied or given")
    if any((decision.topic, decision.choice) == ("coupling", "once") for decision in run.plan.decisions):
        raise PostError(f"{run.path}: with the field solved once no state is in equilibrium with its own field")
    if any(edge.kind == "follower" for edge in loads.edge_tractions):
        raise PostError(f"{run.path}: the work of forces that follow an edge is not recorded")
    if loads.edge_moments and "load_work" not in run.scalars:
        raise PostError(f"{run.path}: the work of moments on edges in space is not recorded")
    if loads.variant == "as-published":
        raise PostError(f'{run.path}: loads.variant = "as-published" does not do the work of pressures')
    if getattr(scene.shell.shape, "axial", "held") == "free":
        raise PostError(f"{run.path}: the work of pressures on the ends of a free tube is not recorded")


def _at_rest(scene: Scene) -> bool:
    """Does the path begin without stress and without field? Magnets and electrets have theirs from the start."""
    shell = scene.shell
    bodies = () if scene.ambient is None else scene.ambient.bodies
    magnets = [*shell.carried.values(), *(getattr(body, "remanence", None) for body in bodies)]
    still = all(magnet is None or magnet == (0.0, 0.0, 0.0) for magnet in magnets)
    return still and getattr(shell.shape, "axial_stretch", 1.0) == 1.0


def _stored(run: Archive) -> dict[str, Floats]:
    scalars = run.scalars
    stored = {"elastic_energy": scalars["elastic_energy"]}
    if "field_energy" in scalars:
        pairs = [one.voltage * one.charge for one in conductors(run)]
        stored["field_energy"] = sum(pairs, np.zeros(len(run))) - scalars["field_energy"]
    return stored | {"stored": sum(stored.values(), np.zeros(len(run)))}


def _contributions(run: Archive, scene: Scene) -> list[Contribution]:
    scalars = run.scalars
    found = [_contribution("sources", one.voltage, one.charge) for one in conductors(run)]
    if "load_work" in scalars:
        found.append(_contribution("loads", scalars["factor_mechanical"], scalars["load_work"]))
    if "support_work" in scalars:
        found.append(_contribution("supports", scalars["support_work"], scalars["factor_mechanical"]))
    pressure = _pressure(run, scene)
    return [*found, *([] if pressure is None else [pressure])]


def _contribution(name: str, force: Floats, place: Floats, rest: float = 0.0) -> Contribution:
    """With the state of rest before the steps."""
    return Contribution(name, np.concatenate([[0.0], force]), np.concatenate([[rest], place]))


def _pressure(run: Archive, scene: Scene) -> Contribution | None:
    """Pressures on the volume that a closed shell encloses, or that an open one sweeps over."""
    difference, loads = run.scalars["pressure_difference"], scene.loads
    uniform = isinstance(loads.pressure_top, float) and isinstance(loads.pressure_bottom, float)
    rest = Patch.of(run, "shell", 0, deformed=False)
    if uniform and not np.any(difference):
        return None
    if uniform and "volume_ratio" in run.scalars and closed(rest):
        mid = Face("bottom", rest, rest, np.arange(len(rest.nodes)))
        volume = float(enclosed(mid, Measure(rest)).sum())
        return _contribution("pressure", difference, volume * run.scalars["volume_ratio"], volume)
    if uniform:
        return _contribution("pressure", difference, np.cumsum(_swept(run, None)))
    if "outside" in run.blocks:
        raise PostError(f"{run.path}: the work of a varying pressure is not told apart from that of the field")
    last = run.block("shell")
    factor = run.scalars["factor_mechanical"]
    profile = (last.field("p_b") - last.field("p_t")) / factor[-1] if factor[-1] else 0.0 * last.field("p_b")
    return _contribution("pressure", factor, np.cumsum(_swept(run, np.asarray(profile, float))))


def _swept(run: Archive, profile: Floats | None) -> Floats:
    """Volume that the mid-surface sweeps over in every step, towards the top, times a nodal ``profile``.

    Between two steps points move straight and evenly; the area vector is then quadratic on the way, and Simpson's rule
    exact.
    """
    before = np.zeros_like(run.block("shell", 0).points)
    swept = []
    for step in range(len(run)):
        patch = Patch.of(run, "shell", step, deformed=False)
        now = np.asarray(patch.block.field("u", step), float)
        moved = now - before
        whole = 0.0
        for share, weight in ((0.0, 1 / 6), (0.5, 4 / 6), (1.0, 1 / 6)):
            whole += weight * _flux(patch, patch.block.points + before + share * moved, moved, profile)
        swept.append(whole)
        before = now
    return np.array(swept)


def _flux(patch: Patch, nodes: Floats, moved: Floats, profile: Floats | None) -> float:
    """The integral of ``moved`` along the normal over the surface through ``nodes``."""
    there = replace(patch, placed=nodes)
    measure = Measure(there)
    face = Face("bottom", there, patch, np.arange(len(nodes)))
    density = np.einsum("cpx,cpx->cp", measure.at_points(moved), face.normals(measure))
    return float(measure.by_cell(density if profile is None else density * measure.at_points(profile)).sum())
