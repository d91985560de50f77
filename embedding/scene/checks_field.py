"""Cross checks of the field: which shapes, electrodes and material constants it needs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.part import known

if TYPE_CHECKING:
    from embedding.scene.ambient import Electrode
    from embedding.scene.scene import Scene


def _coupled_shape(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    if known(scene.ambient) is not None and not shape.surroundable:
        reason = "this version couples only a sphere or an infinite-cylinder to a field"
        yield Problem("ambient", f'not allowed around a shape of kind "{shape.kind}": {reason}')


def _ambient_radius(scene: Scene) -> Iterator[Problem]:
    radius = known(scene.ambient.radius) if scene.ambient is not None else None
    if radius is None:
        return
    outside = scene.shell.shape.size + scene.shell.thickest / 2
    if radius <= outside:
        reason = f"must be greater than {outside} m, the size of the shell plus half its thickness"
        yield Problem("ambient.radius", f"{radius} m is not allowed: {reason}")


def _electrodes_need_electric_field(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None:
        reason = 'an electrode needs a field around the shell: add [ambient] with field = "electric"'
    elif scene.ambient.field == "magnetic":
        reason = 'an electrode is not allowed when ambient.field is "magnetic"'
    else:
        return
    for name in _electrodes(scene):
        yield Problem(f"faces.{name}", reason)


def _permeability(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.ambient.field != "magnetic":
        return
    if known(scene.shell.relative_permeability) is None:
        yield Problem("shell.relative_permeability", 'missing: needed when ambient.field is "magnetic"')


def _permittivity(scene: Scene) -> Iterator[Problem]:
    """Without a permittivity the shell must be a conductor: both faces at the same voltage."""
    if scene.ambient is None or scene.ambient.field != "electric":
        return
    electrodes = _electrodes(scene)
    if known(scene.shell.relative_permittivity) is not None:
        return
    if len(electrodes) == 1:
        bare = "bottom" if "top" in electrodes else "top"
        reason = "without shell.relative_permittivity both faces must be electrodes at the same voltage"
        yield Problem(f"faces.{bare}", f"missing voltage: {reason}; give the voltage here, or the permittivity")
    elif not electrodes:
        reason = 'needed when ambient.field is "electric" and no face is an electrode'
        yield Problem("shell.relative_permittivity", f"missing: {reason}")
    elif electrodes["top"].voltage != electrodes["bottom"].voltage:
        voltages = f"{electrodes['top'].voltage} V on top and {electrodes['bottom'].voltage} V on the bottom"
        reason = f"needed because the faces are at different voltages, {voltages}"
        yield Problem("shell.relative_permittivity", f"missing: {reason}")


def _electrodes(scene: Scene) -> dict[str, Electrode]:
    faces = {"top": known(scene.faces.top), "bottom": known(scene.faces.bottom)}
    return {name: electrode for name, electrode in faces.items() if electrode is not None}


def _charged_cylinder(scene: Scene) -> Iterator[Problem]:
    """In two dimensions the potential of a charge grows with the logarithm of the distance."""
    if scene.ambient is None or scene.shell.shape.reductions != ("plane-strain",):
        return
    if scene.ambient.field == "electric" and scene.ambient.outer == "free-space" and _electrodes(scene):
        reason = 'its potential has no zero at infinity; use "grounded"'
        message = f'"free-space" is not allowed around an infinite cylinder with electrodes: {reason}'
        yield Problem("ambient.outer", message)


def _axial_field(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.shell.shape.reductions != ("plane-strain",):
        return
    axial = scene.ambient.uniform_field[2]
    if axial != 0.0:
        unit = "V/m" if scene.ambient.field == "electric" else "A/m"
        message = f"{axial} {unit} is not allowed: must be 0 along the axis of an infinite cylinder"
        yield Problem("ambient.applied_field.2", message)


FIELD_CHECKS = (
    _coupled_shape,
    _ambient_radius,
    _electrodes_need_electric_field,
    _permeability,
    _permittivity,
    _charged_cylinder,
    _axial_field,
)
