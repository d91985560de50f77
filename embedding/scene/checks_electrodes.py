"""Cross checks of electrodes: the field and the permittivity they need, the rims and far ends they cannot have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from embedding.errors import Problem
from embedding.scene.checks_field import applied, axes_of
from embedding.scene.messages import choice
from embedding.scene.part import known

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def one_conductor(scene: Scene) -> bool:
    """Is the whole shell at one potential, because the scene says so or gives both faces the same voltage?"""
    faces = scene.faces
    if known(faces.both) is not None:
        return True
    top, bottom = known(faces.top), known(faces.bottom)
    if top is None or bottom is None or top.where or bottom.where:
        return False
    return top.voltage is not None and top.voltage == bottom.voltage


def inside_only(scene: Scene) -> bool:
    """Is only the field inside the shell modelled? If the scene leaves it open: where two electrodes meet at a rim, as
    the field outside would be infinite there, and where it does not matter but for that."""
    stated = scene.model.surroundings
    if scene.ambient is None or stated == "meshed":
        return False
    return stated == "none" or (_to_the_rim(scene) and not any(_needs_surroundings(scene)))


def _to_the_rim(scene: Scene) -> bool:
    """Do two electrodes at different potentials reach the rim of an open shell?"""
    top, bottom = known(scene.faces.top), known(scene.faces.bottom)
    if scene.shell.shape.closed or top is None or bottom is None or one_conductor(scene):
        return False
    return not top.where and not bottom.where


def _needs_surroundings(scene: Scene) -> Iterator[str]:
    """Paths of what makes a field outside the shell, or needs one."""
    ambient = scene.ambient
    if ambient is None:
        return
    if ambient.field == "magnetic":
        yield "ambient.field"
    if applied(scene):
        yield "ambient.line_currents" if ambient.line_currents else "ambient.applied_field"
    if ambient.bodies:
        yield "ambient.bodies"
    if known(scene.faces.both) is not None:
        yield "faces.both"


def _need_an_electric_field(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None:
        reason = 'an electrode needs a field around the shell: add [ambient] with field = "electric"'
    elif scene.ambient.field == "magnetic":
        reason = 'an electrode is not allowed when ambient.field is "magnetic"'
    else:
        return
    for name in scene.faces.electrodes:
        yield Problem(f"faces.{name}", reason)


def _where(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    allowed = tuple(dict.fromkeys(shape.faces))
    for name, electrode in scene.faces.electrodes.items():
        if name == "both" and electrode.where:
            yield Problem("faces.both.where", "not allowed: the whole shell is one conductor")
            return
        for number, face in enumerate(electrode.where):
            path = f"faces.{name}.where.{number}"
            if not allowed:
                yield Problem(path, f'"{face}" is not allowed: a shape of kind "{shape.kind}" has no named faces')
            elif face not in allowed:
                yield Problem(path, choice(face, allowed))
    top, bottom = known(scene.faces.top), known(scene.faces.bottom)
    if top is not None and bottom is not None and set(top.where) != set(bottom.where):
        yield Problem("faces.bottom.where", "not allowed: two electrodes must cover the same faces, those of faces.top")


def _permittivity(scene: Scene) -> Iterator[Problem]:
    """Without a permittivity the shell must be a conductor."""
    if scene.ambient is None or scene.ambient.field != "electric" or one_conductor(scene):
        return
    electrodes, path = scene.faces.electrodes, "shell.relative_permittivity"
    if known(scene.shell.relative_permittivity) is not None or scene.shell.carried:
        return
    if not electrodes:
        reason = 'needed when ambient.field is "electric" and no face is an electrode'
    elif any(electrode.where for electrode in electrodes.values()):
        reason = "needed because the electrodes do not cover all of the shell"
    elif len(electrodes) == 1:
        path = "faces.bottom" if "top" in electrodes else "faces.top"
        reason = "without shell.relative_permittivity both faces must be electrodes at the same voltage"
        yield Problem(path, f"missing voltage: {reason}; give the voltage here, or the permittivity")
        return
    elif any(known(electrode.voltage) is None for electrode in electrodes.values()):
        reason = "needed because the faces may be at different voltages; faces.both makes the shell one conductor"
    else:
        voltages = f"{electrodes['top'].voltage} V on top and {electrodes['bottom'].voltage} V on the bottom"
        reason = f"needed because the faces are at different voltages, {voltages}"
    yield Problem(path, f"missing: {reason}")


def _charge_in_the_plane(scene: Scene) -> Iterator[Problem]:
    """In two dimensions the potential of a charge grows with the logarithm of the distance."""
    ambient = scene.ambient
    if ambient is None or axes_of(scene) == 3 or ambient.outer != "free-space" or inside_only(scene):
        return
    if any(body.kind == "half-space" for body in ambient.bodies):
        return
    conductors = [body for body in ambient.bodies if body.is_conductor]
    sources = (*scene.faces.electrodes.values(), *conductors) if ambient.field == "electric" else conductors
    if any(known(source.charge) != 0.0 for source in sources):
        long = "an infinite cylinder" if scene.shell.shape.closed else "what is infinitely long"
        with_them = "electrodes" if scene.faces.electrodes else "conductors"
        reason = 'its potential has no zero at infinity; use "grounded"'
        message = f'"free-space" is not allowed around {long} with {with_them}: {reason}'
        yield Problem("ambient.outer", message)


def _at_the_rim(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or not _to_the_rim(scene) or inside_only(scene):
        return
    where = "where two electrodes meet at the rim, the field around the shell is infinite"
    margin = "leave a margin with faces.top.where and faces.bottom.where"
    if scene.model.surroundings == "meshed":
        message = f'"meshed" is not allowed: {where}; {margin}, or use "auto"'
        yield Problem("model.surroundings", message)
    else:
        others = ", ".join(_needs_surroundings(scene))
        yield Problem("faces.top", f"not allowed up to the rim together with {others}: {where}; {margin}")


def _inside_only(scene: Scene) -> Iterator[Problem]:
    if known(scene.ambient) is None or scene.model.surroundings != "none":
        return
    pinned = 'with model.surroundings = "none", which leaves only the field between two electrodes'
    for path in _needs_surroundings(scene):
        yield Problem(path, f"not allowed {pinned}")
    for name in ("top", "bottom"):
        if known(getattr(scene.faces, name)) is None and known(scene.faces.both) is None:
            yield Problem(f"faces.{name}", f"missing: needed {pinned}")
    if known(scene.shell.relative_permittivity) is None:
        yield Problem("shell.relative_permittivity", f"missing: needed {pinned}")
    if scene.faces.both is None and one_conductor(scene):
        yield Problem("faces.top.voltage", f"must differ from that of the bottom {pinned}")


ELECTRODE_CHECKS = (
    _need_an_electric_field,
    _where,
    _permittivity,
    _charge_in_the_plane,
    _at_the_rim,
    _inside_only,
)
