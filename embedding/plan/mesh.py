"""Element sizes, where the meshed space ends, and the bodies in it."""

from __future__ import annotations

import math

from embedding.geometry.bodies import Body as MeshedBody
from embedding.geometry.domain import MeshSizes
from embedding.plan.allowance import Allowance
from embedding.plan.decisions import Decision
from embedding.plan.effects import Effects
from embedding.plan.far_field import choose_far_field, shell_reach
from embedding.plan.field import ROOM
from embedding.scene import Ambient, Body, BoxBody, CylinderBody, HalfSpace, Scene, SphereBody
from embedding.scene.checks_electrodes import one_conductor

SHELL_SIZE = {"3d": 0.4, "axisymmetric": 0.2, "plane-strain": 0.2}
FLAT_SIZE = 0.35
AT_RIMS = {"3d": 0.25, "axisymmetric": 0.05, "plane-strain": 0.05}
"""Elements along a rim or a conductor's sharp edge, where the field is singular, over those on the rest of it."""

BULGE = 0.5
"""A straight side of so much of the root of the room to the end of space, both in radii, stays within 3 per cent of it
on a sphere."""


def choose_sizes(
    scene: Scene, reduction: str, effects: Effects, allowance: Allowance, *, meshed: bool
) -> tuple[MeshSizes, tuple[Decision, ...]]:
    """The mesh of ``scene`` in ``reduction``; ``meshed`` says whether the space around the shell is."""
    chosen, size = scene.discretisation, scene.shell.shape.size
    flat = reduction == "3d" and not meshed and scene.shell.shape.curvature_radius is None
    default = (FLAT_SIZE if flat else SHELL_SIZE[reduction]) * min(1.0, 2 * scene.shell.shape.narrowest / size)
    shell = chosen.shell_size / size if chosen.shell_size else default
    edges = tuple((edge, length / size) for edge, length in chosen.edge_size.items())
    origin = "stated by the scene" if chosen.shell_size else f"default of {reduction}"
    room = _room(scene, scene.ambient, effects, allowance) if scene.ambient is not None and meshed else math.inf
    if (fits := max(room, BULGE * math.sqrt(room))) < shell:
        shell, origin = fits, "to fit into the room between the shell and the end of space"
    radius = scene.shell.shape.curvature_radius
    bend = None if radius is None else shell * size / radius
    across = "element over radius of curvature" if bend is not None else ""
    decisions = [Decision("mesh on the shell", f"{shell:.3g} x size", origin, bend, across)]
    if scene.ambient is None or not meshed:
        return MeshSizes(shell, shell, 0.0, chosen.grading, chosen.order, edges), tuple(decisions)
    if not edges:
        edges, decided = _at_edges(scene, reduction, shell)
        decisions += decided
    box, radius, beyond, end = _end(scene, scene.ambient, effects, allowance)
    decisions += end
    far = chosen.ambient_size / size if chosen.ambient_size else radius / 2
    origin = "stated by the scene" if chosen.ambient_size else "half the ambient's radius"
    reason = f"{origin}; grading {chosen.grading:g}"
    decisions.append(Decision("mesh far away", f"{far:.3g} x size", reason, far / radius, "element over that radius"))
    bodies = tuple(_meshed(body, size) for body in scene.ambient.bodies)
    sizes = MeshSizes(shell, far, radius, chosen.grading, chosen.order, edges, beyond=beyond, box=box, bodies=bodies)
    return sizes, tuple(decisions)


def _room(scene: Scene, ambient: Ambient, effects: Effects, allowance: Allowance) -> float:
    """Between the shell and the sphere or circle where the meshed space ends; infinite where it does not, or not around
    all of the shell."""
    if ambient.box is not None:
        return math.inf
    room = choose_far_field(scene, ambient, effects, allowance).radius - shell_reach(scene, ambient)
    return room if room > 0.0 else math.inf


def rim_size(scene: Scene, sizes: MeshSizes) -> float | None:
    """Size of the elements along the rims, in shell sizes, None for a closed shell."""
    shape = scene.shell.shape
    if shape.closed:
        return None
    return min((sizes.along(edge) for edge in shape.edges), default=sizes.shell)


def _at_edges(
    scene: Scene, reduction: str, shell: float
) -> tuple[tuple[tuple[str, float], ...], tuple[Decision, ...]]:
    """Smaller elements along the edges at which the field is singular, that leave room for opened faces."""
    shape = scene.shell.shape
    kinks = shape.kinks if shape.closed and one_conductor(scene) else ()
    names, where = (kinks, "sharp edges") if shape.closed else (shape.edges, "rims")
    if not names:
        return (), ()
    size, reason = AT_RIMS[reduction] * shell, "the field is singular there"
    if scene.model.interface != "closed":
        size = max(size, 1.2 * ROOM * scene.shell.thickest / shape.size)
        reason += "; no smaller than three thicknesses, for opened faces"
    size = min(shell, size)
    finer = Decision(f"mesh at {where}", f"{size:.3g} x size", reason, size / shell, "element over those elsewhere")
    return tuple((edge, size) for edge in names), (finer,)


def _end(
    scene: Scene, ambient: Ambient, effects: Effects, allowance: Allowance
) -> tuple[tuple[float, ...] | None, float, bool, tuple[Decision, ...]]:
    """The box, or the radius of the ball, in which the meshed space ends; and whether a mapped region follows."""
    if ambient.box is None:
        end = choose_far_field(scene, ambient, effects, allowance)
        return None, end.radius, end.beyond, end.decisions
    box = tuple(edge / scene.shell.shape.size for edge in ambient.box)
    shown = " x ".join(f"{edge:.3g}" for edge in box)
    reason = "stated by the scene; potential prescribed on it"
    return box, math.hypot(*box), False, (Decision("ambient", f"box of half edges {shown}", reason),)


def _meshed(body: Body, size: float) -> MeshedBody:
    solid = not body.is_conductor

    def scaled(vector: tuple[float, float, float]) -> tuple[float, float, float]:
        x, y, z = (c / size for c in vector)
        return x, y, z

    match body:
        case SphereBody():
            return MeshedBody("sphere", scaled(body.centre), radius=body.radius / size, solid=solid)
        case CylinderBody():
            radius, length = body.radius / size, body.length / size
            return MeshedBody("cylinder", scaled(body.centre), radius=radius, length=length, solid=solid)
        case BoxBody():
            return MeshedBody("box", scaled(body.centre), size=scaled(body.size), solid=solid)
        case HalfSpace():
            return MeshedBody("half-space", level=body.level / size, solid=solid)
