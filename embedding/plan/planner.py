"""From a scene to a plan: reduction, theory, field, interface, mesh; decided before anything is meshed."""

from __future__ import annotations

from dataclasses import replace

from embedding.geometry.domain import MeshSizes
from embedding.geometry.reduction import Reduction
from embedding.geometry.sizes import AT_POINTS
from embedding.plan.coupling import choose_coupling
from embedding.plan.decisions import Decision, Plan
from embedding.plan.far_field import choose_far_field
from embedding.plan.symmetry import choose_reduction, odd_planes
from embedding.plan.theory import choose_locking, choose_theory
from embedding.scene import Scene

SHELL_SIZE = {"3d": 0.4, "axisymmetric": 0.2, "plane-strain": 0.2}
FLAT_SIZE = 0.35


def explain(scene: Scene) -> Plan:
    """What will be modelled for ``scene``, what is left out, and why; meshes and solves nothing.

    Raises:
        SceneError: the scene asks for something that no plan can give; all reasons at once.
    """
    reduction, first = choose_reduction(scene)
    odd = odd_planes(scene, reduction)
    opened, faces = _interface(scene)
    sizes, mesh = _sizes(scene, reduction.name)
    theory = choose_theory(scene)
    bending = theory.choice == "bending"
    points = _loaded_points(scene, reduction) if bending else ()
    if points:
        sizes = replace(sizes, points=points)
        reason = "the moment under a force grows with the logarithm of the distance"
        mesh = (*mesh, Decision("mesh at point loads", f"{sizes.shell / AT_POINTS:.3g} x size", reason))
    coupling = choose_coupling(scene)
    between = (coupling,) if coupling else ()
    rest = (_loads(scene), *_rigid(scene, reduction), *between, *_field(scene), *faces, *mesh, _order(scene))
    locking = choose_locking(scene) if bending else None
    decisions = (first, theory, *([locking] if locking else []), *rest)
    cured = locking is not None and locking.choice == "cured"
    return Plan(reduction, sizes, opened, odd, decisions, bending, cured, coupling.choice if coupling else "joint")


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


def _field(scene: Scene) -> tuple[Decision, ...]:
    if scene.ambient is None:
        return (Decision("ambient", "none", "the scene has no field: nothing around the shell is meshed"),)
    if _conductor(scene):
        jump = Decision("potential", "continuous", "both faces are electrodes at one potential: no jump to solve for")
    else:
        jump = Decision("potential", "with a jump", "the faces may differ: the jump is an unknown on the shell")
    moving = Decision("field", "moves with the shell", "the ambient follows the faces")
    return moving, jump


def _interface(scene: Scene) -> tuple[tuple[str, ...], tuple[Decision, ...]]:
    if scene.ambient is None:
        return (), ()
    ratio = scene.shell.thickest / scene.shell.shape.size
    if scene.model.interface == "closed":
        reason = f"pinned by the scene; first order in the thickness, about {1.6 * ratio:.1e} of the field's load"
        return (), (Decision("interface", "closed", reason),)
    reason = "faces at their true places: second order in the thickness"
    if scene.model.interface == "auto" and _conductor(scene):
        reason += "; the bottom face bounds a space without a field, where its place is not felt"
        return ("t",), (Decision("interface", "opened at the top", reason),)
    return ("t", "b"), (Decision("interface", "opened", reason),)


def _conductor(scene: Scene) -> bool:
    """Are both faces of the closed shell electrodes at one potential? Then there is no field inside."""
    top, bottom = scene.faces.top, scene.faces.bottom
    return top is not None and bottom is not None and top.voltage == bottom.voltage


def _sizes(scene: Scene, reduction: str) -> tuple[MeshSizes, tuple[Decision, ...]]:
    chosen, size = scene.discretisation, scene.shell.shape.size
    flat = reduction == "3d" and scene.ambient is None and scene.shell.shape.curvature_radius is None
    default = (FLAT_SIZE if flat else SHELL_SIZE[reduction]) * min(1.0, 2 * scene.shell.shape.narrowest / size)
    shell = chosen.shell_size / size if chosen.shell_size else default
    edges = tuple((edge, length / size) for edge, length in chosen.edge_size.items())
    origin = "stated by the scene" if chosen.shell_size else f"default of {reduction}"
    decisions = [Decision("mesh on the shell", f"{shell:.3g} x size", origin)]
    if scene.ambient is None:
        return MeshSizes(shell, shell, 0.0, chosen.grading, chosen.order, edges), tuple(decisions)
    end = choose_far_field(scene, scene.ambient)
    decisions += end.decisions
    far = chosen.ambient_size / size if chosen.ambient_size else end.radius / 2
    origin = "stated by the scene" if chosen.ambient_size else "half the ambient's radius"
    decisions.append(Decision("mesh far away", f"{far:.3g} x size", f"{origin}; grading {chosen.grading:g}"))
    sizes = MeshSizes(shell, far, end.radius, chosen.grading, chosen.order, beyond=end.beyond)
    return sizes, tuple(decisions)


def _order(scene: Scene) -> Decision:
    order = scene.discretisation.order
    reason = "polynomial order of shell and geometry"
    if scene.ambient is not None:
        reason += f"; the potential has order {order + 1}, without which a soft membrane creases"
    return Decision("order", str(order), reason)
