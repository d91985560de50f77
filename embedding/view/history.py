"""A chart of a run: the pressures on both faces and the stretch over the accepted steps."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from embedding.archive import Archive, open_archive
from embedding.errors import ArchiveError
from embedding.view.labels import prefixed
from embedding.view.rendering import require_packages

SIZE = (8.0, 6.4)  # inches
DPI = 160
INK = "#22222a"
PRESSURES = {
    "pressure_top": ("top face, mean $p_t$", "#c8553d", "o"),
    "pressure_bottom": ("bottom face, mean $p_b$", "#2f6690", "s"),
}
STRETCHES = {
    "stretch_max": ("largest", "#9a7bb0", "^"),
    "stretch": ("mean", "#3d405b", "o"),
    "stretch_min": ("smallest", "#6d9a8b", "v"),
}


def history_plot(archive: str | os.PathLike[str], output: str | os.PathLike[str]) -> Path:
    """Draw p_t, p_b and the stretch of every accepted step into the PNG file ``output``, and return its path.

    Raises:
        RenderError: matplotlib or pyvista is not installed; the message says how to install them.
        ArchiveError: the archive cannot be read, or it has no accepted step.
        OSError: ``output`` cannot be written.
    """
    require_packages()
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    opened = open_archive(archive)
    if not len(opened):
        raise ArchiveError(f"{opened.path}: no step was accepted, so there is nothing to plot")
    figure = Figure(figsize=SIZE, dpi=DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    above, below = figure.subplots(2, 1, sharex=True)
    above.set_title(opened.run["name"].replace("_", " "), fontsize=15, color=INK, loc="left", pad=10)
    largest = max(float(np.abs(opened.scalars[name]).max()) for name in PRESSURES)
    factor, unit = prefixed(largest, "Pa")
    _draw(above, opened, PRESSURES, factor)
    above.set_ylabel(f"pressure [{unit}]", fontsize=12, color=INK)
    _draw(below, opened, {name: how for name, how in STRETCHES.items() if name in opened.scalars}, 1.0)
    below.set_ylabel("stretch", fontsize=12, color=INK)
    below.set_xlabel("accepted step", fontsize=12, color=INK)
    below.xaxis.get_major_locator().set_params(integer=True)
    _mark_stages(opened, above, below)
    figure.savefig(output, facecolor="white", format="png")
    return Path(output)


def _draw(axes: Any, archive: Archive, curves: dict[str, tuple[str, str, str]], factor: float) -> None:
    steps = np.arange(1, len(archive) + 1)
    for name, (words, colour, marker) in curves.items():
        axes.plot(
            steps, factor * archive.scalars[name], color=colour, marker=marker, markersize=4.5, linewidth=1.8,
            label=words,
        )  # fmt: skip
    axes.ticklabel_format(useOffset=False)
    axes.grid(color="#e4e4ea", linewidth=0.8)
    axes.tick_params(colors=INK, labelsize=10.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(frameon=False, fontsize=11, labelcolor=INK)


def _mark_stages(archive: Archive, above: Any, below: Any) -> None:
    """A dotted line where a stage ends and the next begins, and the names of the stages if there are
    several."""
    stages = [step.stage for step in archive.steps]
    begins = [number for number, stage in enumerate(stages) if number == 0 or stage != stages[number - 1]]
    if len(begins) == 1:
        return
    for begin, end in zip(begins, [*begins[1:], len(stages)], strict=True):
        middle = (max(begin, 1) + end) / 2
        above.text(
            middle, 1.015, stages[begin], transform=above.get_xaxis_transform(), ha="center", va="bottom",
            fontsize=10.5, color="#77777f",
        )  # fmt: skip
        for axes in (above, below) if end < len(stages) else ():
            axes.axvline(end, color="#9a9aa5", linewidth=1.0, linestyle=":")
