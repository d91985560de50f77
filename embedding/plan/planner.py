"""From a scene to a plan: reduction, theory, field, interface, mesh; decided before anything is meshed."""

from __future__ import annotations

from dataclasses import replace

from embedding.geometry.domain import MeshSizes
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import AT_POINTS
from embedding.plan.coupling import choose_coupling
from embedding.plan.decisions import Decision, Extent, Plan
from embedding.plan.field import choose_extent, choose_interface, describe_potential
from embedding.plan.mesh import choose_sizes
from embedding.plan.symmetry import choose_reduction, odd_planes
from embedding.plan.theory import choose_locking, choose_theory
from embedding.scene import Scene


def explain(scene: Scene) -> Plan:
    """What will be modelled for ``scene``, what is left out, and why; meshes and solves nothing.

    Raises:
        SceneError: the scene asks for something that no plan can give; all reasons at once.
    """
    reduction, first = choose_reduction(scene)
    odd = odd_planes(scene, reduction)
    extent, field = choose_extent(scene)
    sizes, mesh = choose_sizes(scene, reduction.name, meshed=extent == "surroundings")
    opened: tuple[str, ...] = ()
    if extent == "surroundings":
        opened, faces = choose_interface(scene, _rim_size(scene, sizes))
        field = (*describe_potential(scene), faces)
    theory = choose_theory(scene)
    bending = theory.choice == "bending"
    points = _loaded_points(scene, reduction) if bending else ()
    if points:
        sizes = replace(sizes, points=points)
        reason = "the moment under a force grows with the logarithm of the distance"
        mesh = (*mesh, Decision("mesh at point loads", f"{sizes.shell / AT_POINTS:.3g} x size", reason))
    coupling = choose_coupling(scene)
    between = (coupling,) if coupling else ()
    rest = (_loads(scene), *_rigid(scene, reduction), *between, *field, *mesh, _order(scene, extent))
    locking = choose_locking(scene) if bending else None
    decisions = (first, theory, *([locking] if locking else []), *rest)
    cured = locking is not None and locking.choice == "cured"
    rung = coupling.choice if coupling else "joint"
    return Plan(reduction, sizes, opened, odd, decisions, bending, cured, rung, extent)


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


def _loads(scene: Scene) -> Decision:
    variant = scene.loads.variant
    if variant != "embedding-aware":
        return Decision("face pressures", variant, "pinned by the scene; the consistent form is embedding-aware")
    varying = ", ".join(scene.loads.pressure_fields)
    reason = f"{varying} vary: their gradient is felt" if varying else "uniform pressures"
    if scene.shell.shape.edges:
        reason += f"; the rim is {scene.loads.rim}"
    return Decision("face pressures", variant, reason)


def _rigid(scene: Scene, reduction: Reduction) -> tuple[Decision, ...]:
    if scene.supports or not scene.shell.shape.closed or len(reduction.planes) == reduction.dimension:
        return ()
    reason = "free rigid motions are held by a uniform dead force; its size is recorded (held_force)"
    return (Decision("rigid motion", "held", reason),)


def _rim_size(scene: Scene, sizes: MeshSizes) -> float | None:
    """Size of the elements along the rims, None for a closed shell."""
    shape = scene.shell.shape
    if shape.closed:
        return None
    return min((sizes.along(edge) for edge in shape.edges), default=sizes.shell)


def _order(scene: Scene, extent: Extent) -> Decision:
    order = scene.discretisation.order
    reason = "polynomial order of shell and geometry"
    if extent == "surroundings":
        reason += f"; the potential has order {order + 1}, without which a soft membrane creases"
    return Decision("order", str(order), reason)
