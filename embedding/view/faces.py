"""The pressures p_t and p_b on the two faces of the shell, one against the other."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, open_archive
from embedding.view import chart
from embedding.view.colours import SHELL_COLOURS, colour_limits
from embedding.view.drawing import Canvas
from embedding.view.labels import prefixed
from embedding.view.rendering import require_rendering
from embedding.view.surface import LINE, shell_surface
from embedding.view.tessellation import Tessellation

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
FACES = {
    "p_t": ("top face, $p_t$", "#c8553d", 1.0),
    "p_b": ("bottom face, $p_b$", "#2f6690", -1.0),
}
PANEL = 4.6  # inches
EDGE = 0.004  # radius of the drawn edges, in sizes of the shell


def faces_plot(archive: str | os.PathLike[str], output: str | os.PathLike[str], *, step: int = -1) -> Path:
    """Draw the total pressures on both faces at a step into the PNG file ``output``, and return its path.

    Axisymmetric and plane strain: both over the arc length of the deformed meridian or cross-section. 3D: the deformed
    shell twice, seen from its top and from its bottom, each coloured by its own pressure on one scale.

    Raises:
        RenderError: drawing is impossible here; the message says what to install.
        ArchiveError: the archive cannot be read, or it has no such step.
        OSError: ``output`` cannot be written.
    """
    opened = open_archive(archive)
    return chart.saved(faces_figure(opened, opened.index(step)), Path(output))


def faces_figure(archive: Archive, step: int) -> Any:
    """The figure of :func:`faces_plot`, not yet saved."""
    title = f"{archive.run['name']}, step {step + 1} of {len(archive)}"
    if archive.block("shell", step).cell_type == LINE:
        return _along_the_curve(archive, step, title)
    require_rendering()
    return _side_by_side(archive, step, title)


def _along_the_curve(archive: Archive, step: int, title: str) -> Any:
    block = archive.block("shell", step)
    fine = Tessellation(block.cells, block.cell_type, block.order, 8)
    moved = fine.values(block.points) + fine.values(block.field("u", step))
    values = {name: fine.values(block.field(name, step)) for name in FACES}
    figure, (axes,) = chart.new_figure(7.6, 4.6)
    factor, unit = prefixed(max(float(np.abs(value).max()) for value in values.values()), "Pa")
    for number, curve in enumerate(chains(fine.simplices)):
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(moved[curve], axis=0), axis=1))])
        metre, metres = prefixed(float(along[-1]), "m")
        for name, (words, colour, _) in FACES.items():
            pressure = factor * values[name][curve]
            axes.plot(metre * along, pressure, color=colour, linewidth=2.2, label=None if number else words)
    chart.titled(axes, title)
    what = "meridian" if archive.run["reduction"] == "axisymmetric" else "cross-section"
    part = ", meshed part" if archive.run["mirrors"] else ""
    chart.named(axes, f"arc length along the deformed {what}{part} [{metres}]", f"pressure [{unit}]")
    chart.legend(axes)
    return figure


def chains(lines: Integers) -> list[Integers]:
    """Segments (n, 2) joined to curves: the nodes of each in order; one that closes begins and ends at the same."""
    beside: dict[int, list[int]] = {}
    for a, b in lines.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    left = {(min(a, b), max(a, b)) for a, b in lines.tolist()}
    ends = [node for node, others in beside.items() if len(others) == 1]
    curves = []
    for start in [*ends, *beside]:
        curve = [start]
        while True:
            onward = [n for n in beside[curve[-1]] if (min(n, curve[-1]), max(n, curve[-1])) in left]
            if not onward:
                break
            left.remove((min(onward[0], curve[-1]), max(onward[0], curve[-1])))
            curve.append(onward[0])
        if len(curve) > 1:
            curves.append(np.array(curve))
    return curves


def _side_by_side(archive: Archive, step: int, title: str) -> Any:
    """Two drawings of the shell and one colour bar."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    surfaces = {name: shell_surface(archive, name, step) for name in FACES}
    limits = colour_limits([surface.values for surface in surfaces.values()], from_zero=False, noise=1e-300)
    size = float(np.linalg.norm(surfaces["p_t"].points - surfaces["p_t"].centre, axis=1).max())
    up = _upwards(archive, step)
    drawings = {}
    for name, (_, _, side) in FACES.items():
        canvas = Canvas("sheet", size=(1500, 1500))
        canvas.shell(surfaces[name], limits, EDGE * size, quarter_cut=False)
        drawings[name] = canvas.draw(turned=side * up < 0)
    tallest = max(drawing.height / drawing.width for drawing in drawings.values())
    inches = 2 * PANEL + 1.6, max(3.0, PANEL * tallest + 1.1)
    figure = Figure(figsize=inches, dpi=chart.DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, 2)
    for axes, (name, (words, _, side)) in zip(panels, FACES.items(), strict=True):
        axes.imshow(drawings[name].pixels)
        axes.axis("off")
        axes.set_title(words if side > 0 else f"{words} (turned over)", fontsize=13, color=chart.INK)
    factor, unit = prefixed(max(map(abs, limits)), "Pa")
    colours = ScalarMappable(Normalize(factor * limits[0], factor * limits[1]), SHELL_COLOURS)
    bar = figure.colorbar(colours, ax=list(panels), shrink=0.75, pad=0.02)
    bar.set_label(f"pressure [{unit}]", fontsize=12, color=chart.INK, labelpad=8)
    bar.outline.set_linewidth(0.6)
    figure.suptitle(title.replace("_", " "), fontsize=15, color=chart.INK, x=0.02, ha="left")
    return figure


def _upwards(archive: Archive, step: int) -> float:
    """Does the top look along z (1) or against it (-1)?"""
    normals = archive.block("shell", step).field("normal", step)
    return 1.0 if float(normals[:, 2].mean()) >= 0.0 else -1.0
