"""Thickness, density and law of a scene's shell on a mesh, where they vary or faces differ from the rest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from ngsolve import BND, CF, ET, ElementId, GridFunction, IfPos, IntegrationRule, SurfaceL2

from embedding.errors import Problem, SceneError
from embedding.geometry.domain import Domain
from embedding.scene import Scales, Scene
from embedding.scene.shell import Region
from embedding.scene.surface_fields import ThicknessField
from embedding.shell.laws import Law, law_of, piecewise
from embedding.solving.expressions import over_surface

T = TypeVar("T")


def thickness_on(scene: Scene, domain: Domain, scales: Scales) -> Any:
    """Thickness in shell sizes: a number, or a coefficient function where it varies.

    Raises:
        SceneError: an expression is not positive everywhere on the mesh.
    """

    def scaled(thickness: float | ThicknessField) -> Any:
        if isinstance(thickness, ThicknessField):
            return over_surface(thickness, domain.reduction, scales) / scales.length
        return thickness / scales.length

    parts = [(r, scaled(r.thickness)) for r in scene.shell.regions if r.thickness is not None]
    thickness = pick(domain, parts, scaled(scene.shell.thickness))
    if not isinstance(thickness, float):
        _refuse_negative(scene, domain, thickness)
    return thickness


def density_on(scene: Scene, domain: Domain) -> Any:
    """Density in kg/m^3: a number, or a coefficient function where regions have their own."""
    parts = [(region, region.density) for region in scene.shell.regions if region.density is not None]
    return pick(domain, parts, scene.shell.density or 0.0)


def law_on(scene: Scene, domain: Domain, scales: Scales) -> Law:
    """The law of the shell, in one piece or several."""
    parts = [(r, law_of(r.material, scales.stress)) for r in scene.shell.regions if r.material is not None]
    return pick(domain, parts, law_of(scene.shell.material, scales.stress), piecewise)


def _choose(indicator: Any, inside: Any, outside: Any) -> Any:
    return IfPos(indicator, CF(inside), CF(outside))


def pick(
    domain: Domain, parts: list[tuple[Region, T]], rest: T, choose: Callable[[Any, T, T], T] = _choose
) -> T:
    """``rest``, replaced on each region by its part."""
    for region, part in parts:
        rest = choose(indicator(domain, region.faces), part, rest)
    return rest


def indicator(domain: Domain, faces: tuple[str, ...]) -> GridFunction:
    """+1 on the ``faces`` of the shell, -1 on the others."""
    field = GridFunction(SurfaceL2(domain.mesh, order=0, definedon=domain.shell))
    field.vec[:] = -1.0
    for name in faces:
        for element in domain.face(name).Elements():
            field.vec[field.space.GetDofNrs(ElementId(BND, element.nr))[0]] = 1.0
    return field


def _refuse_negative(scene: Scene, domain: Domain, thickness: Any) -> None:
    points = domain.mesh.MapToAllElements(
        IntegrationRule(ET.TRIG if domain.mesh.dim == 3 else ET.SEGM, 2 * domain.sizes.order), domain.shell
    )
    smallest = float(np.min(thickness(points))) * scene.shell.shape.size
    if not smallest > 0.0:
        path = next(iter(scene.shell.thickness_fields))
        message = f"{smallest:.3g} m is not allowed: must be greater than 0 everywhere"
        raise SceneError([Problem(f"shell.{path}", message)])
