"""A scene made ready to solve: planned, scaled, meshed, with its coupled system of equations."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.coupling.physics import Physics
from embedding.coupling.system import System
from embedding.errors import Problem as SceneProblem
from embedding.errors import SceneError
from embedding.geometry.domain import Domain, build
from embedding.geometry.reduction import Reduction
from embedding.plan.decisions import Plan
from embedding.scene import InfiniteCylinder, Scales, Scene
from embedding.scene.checks_loads import needs_bending
from embedding.solving.field import field_on
from embedding.solving.loads import mechanical_loads
from embedding.solving.shell import law_on, thickness_on
from embedding.solving.supports import held_by_supports
from embedding.timing import part

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Block:
    """A part of the mesh that results are shown on: ``codim`` 1 is the shell, 0 a side of the ambient. Its fields are
    evaluated inside the context that ``within`` makes."""

    name: str
    region: Any
    codim: int
    within: Callable[[], AbstractContextManager[None]] = nullcontext


class Problem:
    """Everything about one solve that does not change while it runs, on the mesh of ``domain`` or a new one.

    Raises:
        SceneError: the scene states something that this version cannot model.
    """

    def __init__(self, scene: Scene, plan: Plan, domain: Domain | None = None) -> None:
        refuse_unmodelled(scene, plan)
        self.scene, self.plan, self.scales = scene, plan, Scales.of(scene)
        self.reduction: Reduction = plan.reduction
        with part("meshing"):
            self.domain: Domain = domain or build(scene.shell.shape, plan.reduction, plan.sizes)
        self.system = System(self.domain, physics_of(scene, plan, self.scales, self.domain), scene.solver.linear)

    @property
    def mesh(self) -> Any:
        """The NGSolve mesh; its coordinates are dimensionless."""
        return self.domain.mesh

    @property
    def held(self) -> bool:
        """Is there a field, and nothing of the shell can move?"""
        return self.system.potential is not None and not self.system.unknowns.trace.free.any()

    @cached_property
    def blocks(self) -> dict[str, Block]:
        """The parts of the mesh that carry fields."""
        blocks = {"shell": Block("shell", self.domain.shell, 1)}
        for side in ("outside", "inside") if self.domain.has_ambient else ():
            blocks[side] = Block(side, self.mesh.Materials(self.domain.materials(side)), 0, self.domain.in_ambient)
        return blocks

    def embed(self, points: Array) -> Array:
        """Mesh points (n, d) as positions (n, 3) in m."""
        return self.scales.length * self.reduction.embed(np.asarray(points))

    def embed_vector(self, values: Array) -> Array:
        """Vectors with mesh components (n, d) as vectors (n, 3); units are kept."""
        return self.reduction.embed(np.asarray(values))


def refuse_unmodelled(scene: Scene, plan: Plan) -> None:
    """Refuse combinations that are valid statements but not modelled by this version."""
    shape = scene.shell.shape
    open_tube = isinstance(shape, InfiniteCylinder) and shape.axial == "free"
    problems = [] if plan.bending else list(needs_bending(scene))
    if open_tube and scene.ambient is not None:
        problems.append(SceneProblem("shell.shape.axial", '"free" is not allowed with an ambient: use "held"'))
    controlled = any(stage.volume_ratio is not None for stage in scene.path)
    if open_tube and controlled:
        problems.append(SceneProblem("path", 'volume_ratio is not allowed with axial = "free": prescribe pressures'))
    if controlled and scene.loads.variant == "as-published":
        reason = 'volume_ratio is not allowed with loads.variant = "as-published": prescribe pressures'
        problems.append(SceneProblem("path", reason))
    if problems:
        raise SceneError(problems)


def physics_of(scene: Scene, plan: Plan, scales: Scales, domain: Domain) -> Physics:
    """The dimensionless statement of ``scene`` on the mesh of ``domain``.

    Raises:
        SceneError: a load or a support stands where the shell is not.
    """
    shape = scene.shell.shape
    cylinder = shape if isinstance(shape, InfiniteCylinder) else None
    held = held_by_supports(scene, domain, scales)
    return Physics(
        law=law_on(scene, domain, scales),
        thickness=thickness_on(scene, domain, scales),
        loads=mechanical_loads(scene, domain, scales),
        supports=held.components,
        axial_free=cylinder is not None and cylinder.axial == "free",
        axial_stretch=cylinder.axial_stretch if cylinder is not None else 1.0,
        volume_controlled=any(stage.volume_ratio is not None for stage in scene.path),
        opened=plan.opened,
        field=field_on(scene, plan, scales, domain),
        prescribed=held.prescribed,
        clamped=held.clamped,
        bending=plan.bending,
        locking_cured=plan.locking_cured,
    )
