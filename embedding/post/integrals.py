"""Integrals over the shell and the space around it at every step: area, volume, force, torque, charge, energy.

They are taken from the fields of the archive alone, so that they check the scalars that the solver recorded by other
ways (residuals of its discrete equations), and say how much an archive can be trusted. Every integral has an
``..._error`` beside it, in its own unit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.archive.units import PER_LENGTH
from embedding.post.conductors import at_infinity, capacitances
from embedding.post.faces import Face
from embedding.post.measure import Measure, estimated
from embedding.post.patches import FACES, Patch
from embedding.post.probe import Source, opened
from embedding.post.space import AXES, Space, centre_of_outer
from embedding.post.table import Table, stacked
from embedding.scene import Ambient, Scene

Floats = npt.NDArray[np.float64]
OUTER = 0.99  # from which part of the largest radius on a facet lies on the outer boundary
NOTES = (
    "errors: what changes when cells and fields are read one order lower, cell by cell in size; of what passes through"
    " a surface, at least its difference from an integral over the cells beside it, and of an open shell that from what"
    " the solver recorded; float32 adds 1e-7 of the parts",
)


def integrals(archive: Source, *, steps: Sequence[int] | None = None) -> Table:
    """One row a step of integrals over the deformed body (mirror images and the full turn included; plane strain: per
    metre), each with its error:

    * ``area`` of the mid-surface, m^2; ``volume`` that a closed one encloses, m^3;
    * ``force_x`` ..., ``torque_x`` ... (about the origin) of all pressures and tangential tractions on both faces,
      mechanical ones included, N and N m; components that symmetry makes zero are left out;
    * electric: ``charge_top``, ``charge_bottom``, the flux of the flux density out of each face, C; magnetic:
      ``flux_top``, ``flux_bottom``, Wb;
    * ``capacitance``, ``capacitance_body0`` ..., recorded charge over recorded voltage of each conductor, F (of poles
      ``permeance_body0`` ..., H); the error of the shell's is how far the charges above are from the recorded one;
    * ``field_energy`` of the space around and inside the shell (not of its material nor of bodies), with what is beyond
      the mesh of free space, J; left out with an applied field, whose own energy is infinite.

    Raises:
        PostError: no step was accepted.
        ArchiveError: the archive cannot be read, or it has no such step.
    """
    run = opened(archive)
    rows = [_row(run, step) for step in (range(len(run)) if steps is None else map(run.index, steps))]
    names = [name for name in rows[0].columns if name not in KNOWN]
    plane = Space.of(run).reduction == "plane-strain"
    return Table(stacked(rows).columns, {name: _unit(name, plane) for name in names}, NOTES)


KNOWN = ("step", "factor_mechanical", "factor_field")


def _row(run: Archive, step: int) -> Table:
    parts = {**_of_the_shell(run, step), **_of_the_faces(run, step)}
    if "outside" in run.blocks:
        parts |= _of_the_space(run, step)
    faces = [parts[name][0] for name in ("charge_top", "charge_bottom") if name in parts]
    if not closed(Patch.of(run, "shell", step)):
        parts = _with_rims(run, step, parts)
    parts |= capacitances(run, step, sum(faces) if faces else math.nan)
    columns = {
        "step": np.array([step + 1]),
        "factor_mechanical": np.array([run.steps[step].factor_mechanical]),
        "factor_field": np.array([run.steps[step].factor_field]),
    }
    for name, (value, error) in parts.items():
        columns |= {name: np.array([value]), f"{name}_error": np.array([error])}
    return Table(columns)


def _with_rims(run: Archive, step: int, parts: dict[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Integrals of an open shell with errors that know of its rims.

    The field is infinite there, and what polynomials change by from one order to the next does not tell how far they
    are from it: errors are at least the differences from what the solver recorded, where that is the same quantity.
    """
    recorded = {name: float(values[step]) for name, values in run.scalars.items()}
    least = {}
    if "charge" in recorded and "charge_top" in parts:
        apart = abs(parts["charge_top"][0] + parts["charge_bottom"][0] - recorded["charge"])
        least = dict.fromkeys(("charge_top", "charge_bottom"), apart)
    loads = run.scene_object().loads
    if loads.pressure_top == loads.pressure_bottom == 0.0:  # else the recorded ones, of the field, are only a part
        both = [name for name in parts if name in recorded and name.startswith(("force_", "torque_"))]
        least |= {name: abs(parts[name][0] - recorded[name]) for name in both}
    return {name: (value, _at_least(error, least.get(name, 0.0))) for name, (value, error) in parts.items()}


def _unit(name: str, plane: bool) -> str:
    stem = name.removesuffix("_error").split("_")[0]
    units = {
        "area": ("m^2", "m"), "volume": ("m^3", "m^2"), "capacitance": ("F", "F/m"), "permeance": ("H", "H/m"),
    }  # fmt: skip
    one = {"force": "N", "torque": "N m", "charge": "C", "flux": "Wb", "field": "J"}.get(stem)
    if one is not None:
        return PER_LENGTH[one] if plane else one
    return units[stem][plane]


def closed(shell: Patch) -> bool:
    """Does the whole mid-surface, mirror images included, have no rim?

    A node at the end of the meshed part must lie on the axis or in a mirror plane.
    """
    from embedding.post.cells import boundary_facets

    ends = np.unique(boundary_facets(shell.cells, shell.block.cell_type, shell.block.order))
    points, space = shell.block.points[ends], shell.space
    near = 1e-6 * float(np.abs(shell.block.points).max())
    held = np.zeros(len(points), bool)
    for plane in space.mirrors:
        held |= np.abs(points[:, AXES.index(plane)]) < near
    if space.reduction == "axisymmetric":
        held |= points[:, 0] < near
    return bool(held.all())


def _of_the_shell(run: Archive, step: int) -> dict[str, tuple[float, float]]:
    shell = Patch.of(run, "shell", step)
    found = {"area": estimated(shell, lambda measure: measure.by_cell(1.0))}
    if closed(shell):
        mid = Face("top", shell, shell, np.arange(len(shell.nodes)))
        found["volume"] = estimated(shell, lambda measure: enclosed(mid, measure))
    return found


def enclosed(mid: Face, measure: Measure) -> Floats:
    """By cells, the volume behind a closed mid-surface (plane strain: per length), by Gauss's theorem."""
    share = len(mid.patch.space.axes) if mid.patch.space.reduction == "plane-strain" else 3
    return measure.by_cell(np.einsum("cpx,cpx->cp", measure.points, mid.normals(measure)) / share)


def _of_the_faces(run: Archive, step: int) -> dict[str, tuple[float, float]]:
    """Force and torque on both faces together."""
    space = Space.of(run)
    faces = [face for face in (Face.of(run, name, step) for name in ("top", "bottom")) if len(face.patch.cells)]
    shown = {"3d": (0, 1, 2), "plane-strain": (0, 1), "axisymmetric": (2,)}[space.reduction]
    turning = {"3d": (0, 1, 2), "plane-strain": (2,), "axisymmetric": ()}[space.reduction]
    forces = [axis for axis in shown if AXES[axis] not in space.mirrors]
    torques = [axis for axis in turning if set(space.mirrors) <= {AXES[axis]}]
    return {f"force_{AXES[axis]}": _resultant(faces, axis, turns=False) for axis in forces} | {
        f"torque_{AXES[axis]}": _resultant(faces, axis, turns=True) for axis in torques
    }


def _resultant(faces: Sequence[Face], axis: int, *, turns: bool) -> tuple[float, float]:
    """One component of the force on both faces, or of its torque about the origin."""
    value = error = 0.0
    for face in faces:

        def density(measure: Measure, face: Face = face) -> Floats:
            traction = face.traction(measure)
            return measure.by_cell((np.cross(measure.points, traction) if turns else traction)[..., axis])

        one, off = estimated(face.patch, density)
        value, error = value + one, error + off
    return value, error


@dataclass(frozen=True)
class Medium:
    """What fills the two sides: absolute permittivity or permeability by block, and how the field is called."""

    constants: dict[str, float]
    strength: str
    electric: bool

    @staticmethod
    def of(run: Archive) -> Medium:
        """The medium that the scene of an archive states."""
        ambient = _ambient(run.scene_object())
        vacuum, electric = run.scales.permittivity, ambient.field == "electric"
        constants = {"outside": vacuum * ambient.contrast, "inside": vacuum * ambient.inside_contrast}
        return Medium(constants, "E" if electric else "H", electric)


def _ambient(scene: Scene) -> Ambient:
    if scene.ambient is None:
        raise RuntimeError("this scene has no field")
    return scene.ambient


def _of_the_space(run: Archive, step: int) -> dict[str, tuple[float, float]]:
    medium, space = Medium.of(run), Space.of(run)
    found = {}
    if not space.odd or set(space.odd) - set(space.mirrors):
        for name in ("top", "bottom"):
            found[f"{'charge' if medium.electric else 'flux'}_{name}"] = _through(Face.of(run, name, step), medium)
    scene = run.scene_object()
    applied = _ambient(scene)
    if not any(applied.uniform_field) and applied.varying_field is None and not applied.line_currents:
        found["field_energy"] = _energy(run, step, medium)
    return found


def _through(face: Face, medium: Medium) -> tuple[float, float]:
    """What leaves the shell through a face, and its error."""
    constant = medium.constants[FACES[face.name]]
    value, error = estimated(face.patch, lambda m: constant * m.by_cell(face.through(m, medium.strength)))
    return value, _at_least(error, abs(value + constant * _beside(face.patch, medium.strength)))


def _beside(surface: Patch, field: str, weight: Floats | None = None) -> float:
    """A second way to the flux of a field without divergence out of the block of a ``surface``, times another field.

    It is the integral of the field times the gradient of what is the nodal ``weight`` (default: 1) on the surface and 0
    at all other nodes, over the cells that touch it.
    """
    block = surface.block
    touching = np.isin(block.cells, surface.cells).any(axis=1)
    measure = Measure(Patch(block, surface.step, surface.space, block.cells[touching], True))
    on_it, nodes = np.zeros(len(block.points)), np.unique(surface.cells)
    on_it[nodes] = 1.0 if weight is None else weight[nodes]
    strength = measure.at_points(block.field(field, surface.step))
    return float(measure.by_cell(np.einsum("cpx,cpx->cp", strength, measure.gradient(on_it))).sum())


def _at_least(error: float, difference: float) -> float:
    return float(np.nanmax([error, difference]))


def _energy(run: Archive, step: int, medium: Medium) -> tuple[float, float]:
    sides = [Patch.of(run, side, step) for side in medium.constants]
    pairs = [_stored(patch, medium) for patch in sides]
    if _ambient(run.scene_object()).outer == "free-space":
        pairs.append(_beyond(sides[0], medium, centre_of_outer(run), at_infinity(run, step)))
    return sum(value for value, _ in pairs), sum(error for _, error in pairs)


def _stored(patch: Patch, medium: Medium) -> tuple[float, float]:
    """The energy of one side of the meshed space."""
    half, strength = 0.5 * medium.constants[patch.block.name], patch.block.field(medium.strength, patch.step)
    return estimated(patch, lambda m: half * m.by_cell((m.at_points(strength) ** 2).sum(axis=2)))


def _beyond(outside: Patch, medium: Medium, centre: Floats, infinity: float) -> tuple[float, float]:
    """The energy beyond the outer boundary around ``centre``: half of its flux times the potential less that at
    ``infinity`` (Green's identity)."""
    boundary = outside.boundary
    radius = np.linalg.norm(boundary.nodes - centre, axis=1)
    outer = boundary.part((radius[boundary.cells] > OUTER * radius.max()).all(axis=1))
    if not len(outer.cells):
        return 0.0, math.nan
    strength = outer.block.field(medium.strength, outer.step)
    potential = np.asarray(outer.block.field("phi", outer.step), float) - infinity

    half = 0.5 * medium.constants["outside"]

    def energy(measure: Measure) -> Floats:
        away = measure.points - centre
        outward = measure.normals * np.sign(np.einsum("cpx,cpx->cp", measure.normals, away))[..., None]
        through = np.einsum("cpx,cpx->cp", measure.at_points(strength), outward)
        return half * measure.by_cell(through * measure.at_points(potential))

    value, error = estimated(outer, energy)
    return value, _at_least(error, abs(value - half * _beside(outer, medium.strength, potential)))
