"""The field in a plane through the ambient: the meridian plane, the cross-section, or a cut through a 3D
result."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive.reader import Archive, ArchivedBlock
from embedding.post.integrals import closed
from embedding.post.patches import Patch
from embedding.view.colours import Limits, colour_limits
from embedding.view.surface import AXES, magnitude
from embedding.view.tessellation import Tessellation

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
SIDES = ("outside", "inside")
FIELD_FREE = 1e-3  # a side whose field is weaker than this part of the other's is left out
BRIGHT = 0.995  # of the area is within the range of colours: a rim with an infinite field must not hide all else
ROUND = 20_000  # triangles in a plane from which on its edge looks round
ASIDE = 1e-4  # a cut in a mirror plane runs this far beside it, relative to the ambient: in it, cells have no inside


@dataclass(frozen=True)
class Section:
    """Triangles (cells, 3) on points (n, 3) of a plane, with scalar ``values`` (n,) and the field
    ``vectors`` (n, 3)."""

    points: Floats
    triangles: Integers
    values: Floats
    vectors: Floats

    @property
    def strength(self) -> float:
        """Largest length of a vector."""
        return float(np.linalg.norm(self.vectors, axis=1).max(initial=0.0))


def vector_field(block: ArchivedBlock) -> str:
    """Name of the field strength on a block of the ambient: "E" or "H"."""
    return "H" if "H" in block.units else "E"


def sections(archive: Archive, field: str, step: int) -> dict[str, Section]:
    """The deformed plane of every side of the ambient, coloured by ``field`` (the length of a vector).

    Axisymmetric: the meridian half plane y = 0, x >= 0; 3D: the same half plane; plane strain: the whole
    plane z = 0.
    """
    return {side: _section(archive, side, field, step) for side in SIDES if side in archive.blocks}


def planes_with_field(archive: Archive, field: str, step: int, radius: float) -> list[Section]:
    """The planes of :func:`sections` within a ``radius`` of the origin, those without field left out.

    Around an open shell the two sides go over into each other: they are one plane there, so that lines go on.
    """
    planes = [cropped(plane, radius) for plane in sections(archive, field, step).values()]
    strongest = max(plane.strength for plane in planes)
    planes = [plane for plane in planes if plane.strength >= FIELD_FREE * strongest]
    return planes if closed(Patch.of(archive, "shell", step, deformed=False)) else [joined(planes)]


def joined(planes: Sequence[Section]) -> Section:
    """Several planes as one."""
    starts = np.cumsum([0, *(len(plane.points) for plane in planes)])
    triangles = [plane.triangles + start for plane, start in zip(planes, starts, strict=False)]
    parts = ([getattr(plane, name) for plane in planes] for name in ("points", "values", "vectors"))
    points, values, vectors = (np.concatenate(part) for part in parts)
    return Section(points, np.concatenate(triangles), values, vectors)


def field_limits(planes: Sequence[Section], noise: float) -> tuple[Limits, bool]:
    """The range of colours of planes, and whether there are larger values: far above, of a small part of the area.

    What is below ``noise`` cannot be told from zero.
    """
    values, areas = [], []
    for plane in planes:
        corners = plane.points[plane.triangles]
        areas.append(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1))
        values.append(plane.values[plane.triangles].mean(axis=1))
    value, area = np.concatenate(values), np.concatenate(areas)
    order = np.argsort(value)
    share = np.cumsum(area[order]) / area.sum()
    high = float(value[order][min(int(np.searchsorted(share, BRIGHT)), len(value) - 1)])
    limits = colour_limits([plane.values for plane in planes], from_zero=True, noise=noise)
    return ((limits[0], high), True) if 2 * high < limits[1] and high > limits[0] else (limits, False)


def _section(archive: Archive, side: str, field: str, step: int) -> Section:
    block, reduction, mirrors = archive.block(side, step), archive.run["reduction"], list(archive.run["mirrors"])
    moved = block.points + block.field("u", step)
    cells, cut = block.cells, 0.0
    if reduction == "3d":
        cut = ASIDE * float(np.abs(moved).max()) if "y" in mirrors else 0.0
        heights = moved[cells, 1]
        cells = cells[(heights.min(axis=1) <= cut) & (heights.max(axis=1) >= cut)]
    fine = Tessellation(cells, block.cell_type, block.order, max(block.order, 2) if reduction == "3d" else 6)
    points = fine.values(moved)
    values = magnitude(fine.values(block.field(field, step)))
    vectors = fine.values(block.field(vector_field(block), step))
    if reduction == "3d":
        section = half_plane(_sliced(points, fine.simplices, values, vectors, cut), "x" in mirrors)
        mirrors = [plane for plane in mirrors if plane == "z"]
    else:
        section = Section(points, fine.simplices, values, vectors)
    return mirrored(section, mirrors, archive.run.get("odd_mirrors", ()))


def _sliced(points: Floats, tetrahedra: Integers, values: Floats, vectors: Floats, cut: float) -> Section:
    """The plane y = ``cut`` through tetrahedra, moved into y = 0."""
    import pyvista

    kind = np.full(len(tetrahedra), pyvista.CellType.TETRA, np.uint8)
    grid = pyvista.UnstructuredGrid(np.insert(tetrahedra, 0, 4, axis=1).ravel(), kind, points)
    grid.point_data["values"], grid.point_data["vectors"] = values, vectors
    section = _section_of(grid.slice(normal="y", origin=(0.0, cut, 0.0)))
    return replace(section, points=section.points * (1.0, 0.0, 1.0))


def half_plane(section: Section, is_half: bool) -> Section:
    """The part with x >= 0 of a section in the plane y = 0; nothing is to be done if it ``is_half``
    already."""
    if is_half:
        return section
    return _section_of(section_mesh(section).clip(normal="-x", origin=(0.0, 0.0, 0.0)))


def cropped(section: Section, radius: float) -> Section:
    """The part of a section within ``radius`` of the origin."""
    mesh = section_mesh(section)
    while mesh.n_cells < ROUND:
        mesh = mesh.subdivide(1, subfilter="linear")
    mesh.point_data["distance"] = np.linalg.norm(mesh.points, axis=1)
    return _section_of(mesh.clip_scalar(scalars="distance", value=radius, invert=True))


def _section_of(mesh: Any) -> Section:
    triangles = np.asarray(mesh.triangulate().faces, np.int64).reshape(-1, 4)[:, 1:]
    return Section(np.asarray(mesh.points, float), triangles, np.asarray(mesh["values"]), np.asarray(mesh["vectors"]))


def section_mesh(section: Section) -> Any:
    """The section as a pyvista mesh with the point data "values" and "vectors"."""
    import pyvista

    mesh = pyvista.PolyData(section.points, np.insert(section.triangles, 0, 3, axis=1).ravel())
    mesh.point_data["values"], mesh.point_data["vectors"] = section.values, section.vectors
    return mesh


def mirrored(section: Section, planes: Sequence[str], odd: Sequence[str]) -> Section:
    """The section together with its mirror images; across ``odd`` planes the potential changes sign."""
    for plane in planes:
        flip = np.ones(3)
        flip[AXES.index(plane)] = -1
        sign = -1.0 if plane in odd else 1.0
        section = replace(
            section,
            points=np.concatenate([section.points, section.points * flip]),
            triangles=np.concatenate([section.triangles, section.triangles[:, ::-1] + len(section.points)]),
            values=np.tile(section.values, 2),
            vectors=np.concatenate([section.vectors, sign * section.vectors * flip]),
        )
    return section
