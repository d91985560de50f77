"""Cross checks of what the shell's material does to the field: constants that are needed, sources that fit it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.part import known

if TYPE_CHECKING:
    from embedding.scene.scene import Scene

KIND = {"remanence": "magnetic", "polarisation": "electric"}


def _permeability(scene: Scene) -> Iterator[Problem]:
    """A remanence without a permeability is that of a material as permeable as vacuum."""
    if scene.ambient is None or scene.ambient.field != "magnetic" or scene.shell.carried:
        return
    if known(scene.shell.relative_permeability) is None:
        yield Problem("shell.relative_permeability", 'missing: needed when ambient.field is "magnetic"')


def _carried(scene: Scene) -> Iterator[Problem]:
    ambient = known(scene.ambient)
    for path in scene.shell.carried:
        name = path.rpartition(".")[2]
        kind = KIND[name]
        if ambient is None:
            reason = f'a {name} needs a field around the shell: add [ambient] with field = "{kind}"'
            yield Problem(f"shell.{path}", reason)
        elif ambient.field != kind:
            yield Problem(f"shell.{path}", f'a {name} is not allowed when ambient.field is "{ambient.field}"')


def _saturation(scene: Scene) -> Iterator[Problem]:
    """What saturates is the magnetisation that a permeability above 1 induces."""
    shell = scene.shell
    electric = scene.ambient is not None and scene.ambient.field == "electric"
    parts = {"shell": shell} | {f"shell.regions.{i}": region for i, region in enumerate(shell.regions)}
    for path, part in parts.items():
        own = known(part.saturation)
        saturation = shell.saturation if own is None else own
        if known(saturation) is None:
            continue
        permeability = known(part.relative_permeability)
        given = permeability is not None
        permeability = permeability if given else known(shell.relative_permeability)
        if electric and own is not None:
            yield Problem(f"{path}.saturation", 'not allowed when ambient.field is "electric"')
        elif permeability is None and own is not None:
            reason = "must be greater than 1, as there is a saturation"
            yield Problem("shell.relative_permeability", f"missing: {reason}")
        elif permeability is not None and permeability <= 1.0 and (own is not None or given):
            reason = "must be greater than 1, as there is a saturation"
            owner = path if given else "shell"
            yield Problem(f"{owner}.relative_permeability", f"{permeability} is not allowed: {reason}")


MATTER_CHECKS = (_carried, _permeability, _saturation)
