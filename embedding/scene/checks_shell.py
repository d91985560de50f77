"""Cross checks of a shell whose thickness or material is not the same everywhere."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.materials import StVenantKirchhoff
from embedding.scene.messages import choice
from embedding.scene.part import known

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def _thickness(scene: Scene) -> Iterator[Problem]:
    shell = scene.shell
    radius, thickness = shell.shape.curvature_radius, shell.thickest
    if radius is not None and thickness / 2 >= radius:
        yield Problem(
            "shell.thickness",
            f"{thickness} m is not allowed: half of it must be less than {_radius(scene)} = {radius} m, "
            "or the inner face crosses the centre of curvature",
        )


def _radius(scene: Scene) -> str:
    """What the smallest radius of curvature is called."""
    shape = scene.shell.shape
    same = (name for name in ("radius", "tube_radius") if getattr(shape, name, None) == shape.curvature_radius)
    return next((f"shell.shape.{name}" for name in same), "the shape's smallest radius of curvature")


def _faces(scene: Scene) -> Iterator[Problem]:
    shape, seen = scene.shell.shape, set[str]()
    allowed = tuple(dict.fromkeys(shape.faces))
    for number, region in enumerate(scene.shell.regions):
        for place, name in enumerate(region.faces):
            path = f"shell.regions.{number}.faces.{place}"
            if not allowed:
                yield Problem(path, f'"{name}" is not allowed: a shape of kind "{shape.kind}" has no named faces')
            elif name not in allowed:
                yield Problem(path, choice(name, allowed))
            elif name in seen:
                yield Problem(path, f'"{name}" is not allowed: it is part of another region')
            seen.add(name)


def _one_theory(scene: Scene) -> Iterator[Problem]:
    """Small strains and incompressibility are two theories of one shell; it can follow one of them."""
    small = isinstance(scene.shell.material, StVenantKirchhoff)
    for number, region in enumerate(scene.shell.regions):
        material = known(region.material)
        if material is not None and isinstance(material, StVenantKirchhoff) != small:
            reason = "incompressible laws and st-venant-kirchhoff cannot be mixed in one shell"
            path = f"shell.regions.{number}.material.law"
            yield Problem(path, f'"{material.law}" is not allowed beside "{scene.shell.material.law}": {reason}')


SHELL_CHECKS = (_thickness, _faces, _one_theory)
