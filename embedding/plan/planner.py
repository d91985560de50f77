"""From a scene to a plan: reduction, theory, field, interface, mesh; decided before anything is meshed."""

from __future__ import annotations

import math
from dataclasses import replace

from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import AT_POINTS, MeshSizes
from embedding.plan.allowance import Allowance
from embedding.plan.coupling import choose_coupling
from embedding.plan.decisions import Decision, Extent, Plan
from embedding.plan.effects import Effects
from embedding.plan.field import choose_extent, choose_interface, describe_potential
from embedding.plan.mesh import choose_sizes, rim_size
from embedding.plan.meshable import refuse_what_cannot_be_meshed
from embedding.plan.response import BEYOND
from embedding.plan.symmetry import choose_reduction, odd_planes
from embedding.plan.theory import choose_locking, choose_theory, judge_thinness
from embedding.scene import NeoHookean, Scene
from embedding.scene.checks_electrodes import one_conductor

OF_SPACE: dict[Extent, tuple[str, ...]] = {
    "none": ("interface", "coupling", "far_field", "surroundings"),
    "given": ("interface", "far_field", "surroundings"),
    "inside": ("interface", "far_field"),
    "surroundings": (),
}
"""Choices of the model that say nothing where so much of the field is modelled."""
WITHOUT: dict[Extent, str] = {
    "none": "no field is modelled",
    "given": "nothing around the shell is meshed",
    "inside": "nothing around the shell is meshed",
    "surroundings": "space ends at a grounded boundary",
}


def explain(scene: Scene) -> Plan:
    """What will be modelled for ``scene``, what is left out, and why; meshes and solves nothing.

    Raises:
        SceneError: the scene asks for something that no plan can give; all reasons at once.
    """
    effects, allowance = Effects(scene), Allowance.of(scene)
    reduction, first = choose_reduction(scene)
    odd = odd_planes(scene, reduction)
    extent, field = choose_extent(scene, effects, allowance)
    sizes, mesh = choose_sizes(scene, reduction.name, effects, allowance, meshed=extent == "surroundings")
    refuse_what_cannot_be_meshed(scene, sizes)
    opened: tuple[str, ...] = ()
    if extent == "surroundings":
        opened, faces = choose_interface(scene, rim_size(scene, sizes), effects, allowance)
        field = (*field, *describe_potential(scene), faces)
    theory = choose_theory(scene, effects, allowance)
    bending = theory.choice == "bending"
    points = _loaded_points(scene, reduction) if bending else ()
    if points:
        sizes = replace(sizes, points=points)
        reason = "the moment under a force grows with the logarithm of the distance"
        finer = f"{sizes.shell / AT_POINTS:.3g} x size"
        mesh = (*mesh, Decision("mesh at point loads", finer, reason, 1 / AT_POINTS, "element over those elsewhere"))
    coupling = choose_coupling(scene, extent, effects, allowance)
    between = (coupling,) if coupling else ()
    loads = _loads(scene, effects, allowance)
    mesh = (*mesh, _order(scene, extent, sizes, allowance))
    rest = (loads, *_rigid(scene, reduction), *field, *between, *mesh, *_unused(scene, extent))
    locking = choose_locking(scene) if bending else None
    thin = judge_thinness(scene, effects, allowance, bending=bending)
    decisions = (first, *_closed_form(effects), theory, thin, *([locking] if locking else []), *rest)
    cured = locking is not None and locking.choice == "cured"
    rung = coupling.choice if coupling else "joint"
    return Plan(reduction, sizes, opened, odd, decisions, bending, cured, rung, extent)


def _closed_form(effects: Effects) -> tuple[Decision, ...]:
    """Is there nothing to solve for but a few numbers? Of a thin neo-Hookean shell the stretch is known beforehand."""
    if not effects.loading.homogeneous:
        return ()
    scene, known = effects.scene, effects.loading.answer
    alone = scene.ambient is None or (scene.ambient.outer == "free-space" and _at_voltage(scene))
    sure = alone and known is not BEYOND and isinstance(scene.shell.material, NeoHookean)
    value = f", {known.stretch:.5g} if it is thin" if sure else ""
    kind = effects.loading.form
    reason = f"a {kind} under the same load everywhere: one equation gives its stretch{value}; solved all the same"
    return (Decision("solution", "the same everywhere", reason),)


def _at_voltage(scene: Scene) -> bool:
    """Is the shell one conductor whose potential is given?"""
    top = scene.faces.top
    return one_conductor(scene) and top is not None and top.voltage is not None


def _loaded_points(scene: Scene, reduction: Reduction) -> tuple[tuple[float, ...], ...]:
    """Where point loads act on the meshed part of a surface, in shell sizes."""
    if reduction.dimension == 2:
        return ()
    size = scene.shell.shape.size
    mirrored = [axis in reduction.planes for axis in "xyz"]
    images = (
        tuple(abs(x) / size if folded else x / size for x, folded in zip(load.at, mirrored, strict=True))
        for load in scene.loads.point_loads
    )
    return tuple(dict.fromkeys(images))


def _loads(scene: Scene, effects: Effects, allowance: Allowance) -> Decision:
    """How face pressures act, and what their mean is worth, which squeezes the wall; it costs nothing to keep."""
    loads, number, measure = scene.loads, effects.mean_pressure, "effect of the mean of both pressures on the answer"
    felt = [f"the gradient of {', '.join(loads.pressure_fields)}"] if loads.pressure_fields else []
    felt += [f"the rim, which is {loads.rim}"] if scene.shell.shape.edges else []
    where = f"their mean is felt by {' and by '.join(felt)}" if felt else "their mean is not felt by a closed wall"
    if loads.variant != "embedding-aware":
        where = f"pinned by the scene; the consistent form is embedding-aware; {where}"
    return Decision("face pressures", loads.variant, where, number, measure, allowance.threshold)


def _rigid(scene: Scene, reduction: Reduction) -> tuple[Decision, ...]:
    if scene.supports or not scene.shell.shape.closed or len(reduction.planes) == reduction.dimension:
        return ()
    reason = "free rigid motions are held by a uniform dead force; its size is recorded (held_force)"
    return (Decision("rigid motion", "held", reason),)


def _unused(scene: Scene, extent: Extent) -> tuple[Decision, ...]:
    """The choices that the scene pins for a field that is not there, or that ends otherwise."""
    names = list(OF_SPACE[extent])
    if extent == "surroundings" and scene.ambient is not None and scene.ambient.outer == "grounded":
        names.append("far_field")
    pinned = [f"model.{name}" for name in names if getattr(scene.model, name) != "auto"]
    if not pinned:
        return ()
    reason = f"pinned by the scene, and without effect: {WITHOUT[extent]}"
    return (Decision("not used", ", ".join(pinned), reason),)


def _order(scene: Scene, extent: Extent, sizes: MeshSizes, allowance: Allowance) -> Decision:
    """The order of the polynomials, and what they leave of an arc of an angle as an element has: 2 (angle / 4)^(p + 1)
    / (p + 1)! of its radius at most, interpolated in Chebyshev's points."""
    order, radius = scene.discretisation.order, scene.shell.shape.curvature_radius
    reason = "polynomial order of shell and geometry"
    if extent == "surroundings":
        reason += f"; the potential has order {order + 1}, without which a soft membrane creases"
    if radius is None:
        return Decision("order", str(order), f"{reason}; all are exact for flat elements")
    angle = sizes.shell * scene.shell.shape.size / radius
    left = 2 * (angle / 4) ** (order + 1) / math.factorial(order + 1)
    measure = "what it leaves of the arc of an element, over its radius"
    return Decision("order", str(order), reason, left, measure, allowance.threshold)
