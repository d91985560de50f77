"""Cross checks: what is right field by field and still cannot be one scene. All findings are collected."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from embedding.errors import Problem
from embedding.scene.messages import nearest, quoted
from embedding.scene.part import Unavailable

if TYPE_CHECKING:
    from embedding.scene.scene import Scene


def cross_problems(scene: Scene) -> tuple[Problem, ...]:
    """Everything that does not fit together; checks on fields that are themselves wrong are left out."""
    found: list[Problem] = []
    for check in CHECKS:
        try:
            found += check(scene)
        except Unavailable:
            continue
    return tuple(found)


def axisymmetry_problems(scene: Scene) -> tuple[Problem, ...]:
    """Loads that are not symmetric about the z axis; empty if an axisymmetric reduction may carry them all."""
    return tuple(_unsymmetric_vectors(scene)) + tuple(_unsymmetric_pressures(scene))


def _edges(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for number, support in enumerate(scene.supports):
        yield from _edge(f"supports.{number}.where", support.where, (*shape.edges, "surface"), shape.kind)
    for number, load in enumerate(scene.loads.edge_tractions):
        yield from _edge(f"loads.edge_tractions.{number}.edge", load.edge, shape.edges, shape.kind)


def _edge(path: str, name: str, allowed: tuple[str, ...], kind: str) -> Iterator[Problem]:
    if name in allowed:
        return
    if not allowed:
        yield Problem(path, f'"{name}" is not allowed: a shape of kind "{kind}" has no edges')
        return
    guess = nearest(name, allowed)
    hint = f'; did you mean "{guess}"?' if guess else ""
    yield Problem(path, f'"{name}" is not allowed: must be {quoted(allowed)} for a shape of kind "{kind}"{hint}')


def _thickness(scene: Scene) -> Iterator[Problem]:
    radius, thickness = scene.shell.shape.curvature_radius, scene.shell.thickness
    if radius is not None and thickness / 2 >= radius:
        yield Problem(
            "shell.thickness",
            f"{thickness} m is not allowed: half of it must be less than shell.shape.radius = {radius} m, "
            "or the inner face crosses the centre of curvature",
        )


def _coupled_shape(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    if scene.ambient is not None and not shape.closed:
        yield Problem(
            "ambient",
            f'not allowed around a shape of kind "{shape.kind}": this version couples only closed shells '
            "(sphere, infinite-cylinder) to a field",
        )


def _ambient_radius(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.ambient.radius is None:
        return
    outside = scene.shell.shape.size + scene.shell.thickness / 2
    if scene.ambient.radius <= outside:
        yield Problem(
            "ambient.radius",
            f"{scene.ambient.radius} m is not allowed: must be greater than {outside} m, "
            "the size of the shell plus half its thickness",
        )


def _faces_need_ambient(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None:
        for name in _electrodes(scene):
            yield Problem(f"faces.{name}", 'an electrode needs a field around it: add [ambient] with field = "electric"')


def _magnetic(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.ambient.field != "magnetic":
        return
    for name in _electrodes(scene):
        yield Problem(f"faces.{name}", 'an electrode is not allowed when ambient.field is "magnetic"')


def _permeability(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.ambient.field != "magnetic":
        return
    if scene.shell.relative_permeability is None:
        yield Problem("shell.relative_permeability", 'missing: needed when ambient.field is "magnetic"')


def _permittivity(scene: Scene) -> Iterator[Problem]:
    """Without a permittivity the shell must be one conductor: both faces at the same voltage."""
    if scene.ambient is None or scene.ambient.field != "electric" or scene.shell.relative_permittivity is not None:
        return
    voltages = _electrodes(scene)
    if len(voltages) == 1:
        bare = "bottom" if "top" in voltages else "top"
        yield Problem(
            f"faces.{bare}",
            "missing voltage: without shell.relative_permittivity the shell is a conductor and both faces need the "
            "same voltage; give the voltage here, or the permittivity",
        )
    elif not voltages:
        yield Problem(
            "shell.relative_permittivity",
            'missing: needed when ambient.field is "electric" and no face carries an electrode',
        )
    elif voltages["top"] != voltages["bottom"]:
        yield Problem(
            "shell.relative_permittivity",
            f"missing: needed because the faces are at different voltages, {voltages['top']} V on top and "
            f"{voltages['bottom']} V on the bottom",
        )


def _electrodes(scene: Scene) -> dict[str, float]:
    faces = {"top": scene.faces.top, "bottom": scene.faces.bottom}
    return {name: electrode.voltage for name, electrode in faces.items() if electrode is not None}


def _charged_cylinder(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or "plane-strain" not in scene.shell.shape.reductions:
        return
    if scene.ambient.field == "electric" and scene.ambient.outer == "free-space" and _electrodes(scene):
        yield Problem(
            "ambient.outer",
            '"free-space" is not allowed around an infinite cylinder with electrodes: its potential has no zero at '
            'infinity; use "grounded" with ambient.radius',
        )


def _reduction(scene: Scene) -> Iterator[Problem]:
    shape, reduction = scene.shell.shape, scene.model.reduction
    if reduction != "auto" and reduction not in shape.reductions:
        yield Problem(
            "model.reduction",
            f'"{reduction}" is not allowed: must be {quoted(("auto", *shape.reductions))} for a shape of kind "{shape.kind}"',
        )


def _pinned_axisymmetry(scene: Scene) -> Iterator[Problem]:
    if scene.model.reduction == "axisymmetric":
        yield from _unsymmetric_vectors(scene)


def _pinned_axisymmetry_pressures(scene: Scene) -> Iterator[Problem]:
    if scene.model.reduction == "axisymmetric":
        yield from _unsymmetric_pressures(scene)


def _unsymmetric_vectors(scene: Scene) -> Iterator[Problem]:
    vectors: list[tuple[str, Any]] = [("loads.body_force", scene.loads.body_force)]
    vectors += [(f"loads.edge_tractions.{n}.traction", t.traction) for n, t in enumerate(scene.loads.edge_tractions)]
    if scene.ambient is not None:
        vectors.append(("ambient.applied_field", scene.ambient.applied_field))
    for path, vector in vectors:
        if vector[0] != 0.0 or vector[1] != 0.0:
            yield Problem(path, f'{list(vector)} is not allowed: the x and y components must be 0 when model.reduction is "axisymmetric"')


def _unsymmetric_pressures(scene: Scene) -> Iterator[Problem]:
    """Compare each varying pressure with itself after a turn about the z axis, at a few points."""
    size = scene.shell.shape.size
    for name, pressure in scene.loads.pressure_fields.items():
        try:
            values = [
                [float(pressure(r * size * math.cos(a), r * size * math.sin(a), z * size)) for a in (0.3, 1.4, 2.9, 4.6)]
                for r, z in ((0.4, 0.9), (0.8, -0.6), (0.97, 0.2))
            ]
        except (ArithmeticError, ValueError, TypeError):
            continue  # not defined everywhere: reported by the check of its values
        scale = max(abs(value) for circle in values for value in circle)
        if any(max(circle) - min(circle) > 1e-9 * scale for circle in values):
            yield Problem(
                f"loads.{name}.expression",
                f'{pressure.expression} is not allowed: must depend on x and y through x**2 + y**2 only when model.reduction is "axisymmetric"',
            )


def _pressure_values(scene: Scene) -> Iterator[Problem]:
    for name, pressure in scene.loads.pressure_fields.items():
        for point in scene.shell.shape.sample_points():
            if not _finite(pressure, point):
                where = ", ".join(f"{axis} = {value:.3g}" for axis, value in zip("xyz", point, strict=True))
                yield Problem(f"loads.{name}.expression", f"{pressure.expression} is not allowed: no finite real value at {where}")
                break


def _finite(pressure: Any, point: tuple[float, float, float]) -> bool:
    try:
        return math.isfinite(pressure(*point))
    except (ArithmeticError, ValueError, TypeError):  # TypeError: a root of a negative number is complex
        return False


def _plane_strain(scene: Scene) -> Iterator[Problem]:
    if scene.shell.shape.reductions != ("plane-strain",):
        return
    if scene.loads.body_force[2] != 0.0:
        yield Problem("loads.body_force.2", f"{scene.loads.body_force[2]} N/m^3 is not allowed: must be 0 along the axis of an infinite cylinder")
    for name, pressure in scene.loads.pressure_fields.items():
        if "z" in pressure.parsed.variables:
            yield Problem(f"loads.{name}.expression", f"{pressure.expression} is not allowed: must not depend on z along an infinite cylinder")


def _plane_strain_field(scene: Scene) -> Iterator[Problem]:
    if scene.ambient is None or scene.shell.shape.reductions != ("plane-strain",):
        return
    axial = scene.ambient.applied_field[2]
    if axial != 0.0:
        unit = "V/m" if scene.ambient.field == "electric" else "A/m"
        yield Problem("ambient.applied_field.2", f"{axial} {unit} is not allowed: must be 0 along the axis of an infinite cylinder")


def _volume_control(scene: Scene) -> Iterator[Problem]:
    shape = scene.shell.shape
    for number, stage in enumerate(scene.path):
        if stage.volume_ratio is None:
            continue
        path = f"path.{number}.volume_ratio"
        if not shape.closed:
            yield Problem(path, f'not allowed for a shape of kind "{shape.kind}": only closed shells (sphere, infinite-cylinder) enclose a volume')
        for name in scene.loads.pressure_fields:
            yield Problem(path, f"not allowed while loads.{name} varies over the surface: volume control needs uniform pressures")


CHECKS = (
    _thickness, _permittivity, _permeability, _edges, _plane_strain, _pressure_values, _coupled_shape, _ambient_radius,
    _charged_cylinder, _plane_strain_field, _faces_need_ambient, _magnetic, _volume_control, _reduction,
    _pinned_axisymmetry, _pinned_axisymmetry_pressures,
)  # fmt: skip
