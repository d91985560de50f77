"""The field in a plane, as a flat chart with axes: its strength in colours, field lines, and the shell's cut."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, open_archive
from embedding.errors import ArchiveError
from embedding.view import chart
from embedding.view.colours import FIELD_COLOURS
from embedding.view.labels import label, prefixed
from embedding.view.lines import Raster, field_lines
from embedding.view.picture import noise_of
from embedding.view.rendering import require_packages
from embedding.view.section import Section, field_limits, planes_with_field, section_mesh, vector_field
from embedding.view.surface import LINE, shell_surface
from embedding.view.tessellation import Tessellation

Floats = npt.NDArray[np.float64]
REACH, SPACING, RASTER = 2.4, 0.16, 0.1  # in sizes of the shell; spacing of the lines; raster over spacing
ALONG = {"plane-strain": (0, 1)}
HEIGHT = 6.2
SHELL_WIDTH = 2.6


def slice_plot(
    archive: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    step: int = -1,
    field: str | None = None,
    lines: bool = True,
    reach: float = REACH,
) -> Path:
    """Draw the ambient's ``field`` (default: the strength of the electric or magnetic field) of a step in a plane, with
    field ``lines`` and the shell, out to ``reach`` sizes of the shell, into the PNG file ``output``.

    The plane is the meridian plane y = 0 (3D and axisymmetric, the half with x >= 0) or the cross-section. No OpenGL is
    needed.

    Raises:
        RenderError: matplotlib or pyvista is not installed; the message says how to install them.
        ArchiveError: the archive cannot be read, has no such step or field, or nothing is meshed around the shell.
        OSError: ``output`` cannot be written.
    """
    opened = open_archive(archive)
    return chart.saved(slice_figure(opened, opened.index(step), field, lines, reach), Path(output))


def slice_figure(archive: Archive, step: int, field: str | None, lines: bool, reach: float) -> Any:
    """The figure of :func:`slice_plot`, not yet saved."""
    if "outside" not in archive.blocks:
        raise ArchiveError(f"{archive.path}: nothing is meshed around the shell, so there is no field to cut")
    require_packages()
    name = field or vector_field(archive.block("outside", step))
    axes_shown = ALONG.get(archive.run["reduction"], (0, 2))
    curves = shell_cut(archive, step)
    size = max(float(np.linalg.norm(curve, axis=1).max()) for curve in curves)
    planes = planes_with_field(archive, name, step, reach * size)
    return _drawn(archive, step, name, axes_shown, (curves, planes), size, lines)


def _drawn(
    archive: Archive, step: int, name: str, shown: tuple[int, int], parts: tuple[Any, Any], size: float, lines: bool
) -> Any:
    curves, planes = parts
    points = np.concatenate([plane.points for plane in planes])[:, shown]
    span = np.ptp(points, axis=0)
    figure, (axes,) = chart.new_figure(max(3.2, HEIGHT * span[0] / span[1]) + 1.9, HEIGHT + 0.7)
    metre, metres = prefixed(float(np.abs(points).max()), "m")
    unit = archive.block("outside", step).units[name]
    limits, brighter = field_limits(planes, noise_of(archive, unit))
    factor, unit = prefixed(max(map(abs, limits)), unit)
    for plane in planes:
        x, y = metre * plane.points[:, shown].T
        drawn = axes.tripcolor(
            x, y, plane.triangles, factor * plane.values, shading="gouraud", cmap=FIELD_COLOURS,
            vmin=factor * limits[0], vmax=factor * limits[1], rasterized=True,
        )  # fmt: skip
        for line in lines_in(plane, shown, SPACING * size) if lines and plane.strength > 0 else ():
            axes.plot(*(metre * line).T, color="#24385e", linewidth=0.9, solid_capstyle="round")
    for curve in curves:
        axes.plot(*(metre * curve[:, shown]).T, color=chart.INK, linewidth=SHELL_WIDTH, solid_capstyle="round")
    axes.set_aspect("equal")
    axes.grid(False)
    low, high = metre * points.min(axis=0), metre * points.max(axis=0)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    bar = figure.colorbar(drawn, ax=axes, shrink=0.75, pad=0.03, extend="max" if brighter else "neither")
    bar.set_label(label(name, unit), fontsize=12, color=chart.INK, labelpad=8)
    bar.outline.set_linewidth(0.6)
    chart.titled(axes, f"{archive.run['name']}, step {step + 1} of {len(archive)}")
    chart.named(axes, *(f"{'xyz'[axis]} [{metres}]" for axis in shown))
    return figure


def lines_in(section: Section, shown: tuple[int, int], spacing: float) -> list[Floats]:
    """Field lines of a plane section as points (n, 2) in m, ``spacing`` m apart."""
    import pyvista

    width = RASTER * spacing
    flat = section_mesh(section)
    flat.points = np.column_stack([section.points[:, shown], np.zeros(len(section.points))])
    low, high = np.asarray(flat.points).min(axis=0), np.asarray(flat.points).max(axis=0)
    columns, rows = (np.ceil((high - low) / width).astype(int) + 1)[:2]
    grid = pyvista.ImageData(dimensions=(columns, rows, 1), spacing=(width,) * 3, origin=(low[0], low[1], 0.0))
    vectors = np.asarray(grid.sample(flat, tolerance=1e-3 * width)["vectors"], float)[:, shown]
    edge = np.asarray(grid.points)[:, 0].reshape(rows, columns) < 0.25 * spacing
    no_starts = edge if shown == (0, 2) else None  # no lines on the edge of the half plane
    found = field_lines(Raster(vectors.reshape(rows, columns, 2)), 1 / RASTER, no_starts)
    return [low[:2] + width * line for line in found]


def shell_cut(archive: Archive, step: int) -> list[Floats]:
    """Where the plane of :func:`slice_plot` cuts the deformed shell: lines of points (n, 3)."""
    block = archive.block("shell", step)
    if block.cell_type != LINE:
        surface = shell_surface(archive, "u", step)
        return _cut_surface(surface.points, surface.triangles)
    fine = Tessellation(block.cells, block.cell_type, block.order, 8)
    moved = fine.values(block.points) + fine.values(block.field("u", step))
    pieces = [moved[pair] for pair in fine.simplices]
    for plane in archive.run["mirrors"]:
        flip = np.where(np.arange(3) == "xyz".index(plane), -1.0, 1.0)
        pieces += [piece * flip for piece in pieces]
    return pieces


def _cut_surface(points: Floats, triangles: npt.NDArray[np.int64]) -> list[Floats]:
    import pyvista

    mesh = pyvista.PolyData(points, np.insert(triangles, 0, 3, axis=1).ravel())
    beside = 1e-6 * float(np.abs(points).max())  # in the plane itself a mesh has edges, not cells
    cut = mesh.slice(normal="y", origin=(0.0, beside, 0.0)).clip(normal="-x", origin=(0.0, 0.0, 0.0))
    return [np.asarray(cell.points, float) for cell in cut.strip(join=True, max_length=1 << 20).cell]
