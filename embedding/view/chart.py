"""The look that all charts share: figures without a display, axes, grids and where the words stand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from embedding.view.rendering import require_packages

DPI = 160
INK, GREY, GRID = "#22222a", "#77777f", "#e4e4ea"
COLOURS = ("#2f6690", "#c8553d", "#6d9a8b", "#9a7bb0", "#d9a441", "#3d405b")
"""Of curves, in this order."""
MARKERS = ("o", "s", "^", "v", "D", "P")


def new_figure(width: float, height: float, rows: int = 1) -> tuple[Any, list[Any]]:
    """A white figure of so many inches, and its axes from top to bottom, which share their x axis.

    Raises:
        RenderError: matplotlib is missing.
    """
    require_packages("matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = list(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])
    for one in axes:
        dressed(one)
    return figure, axes


def dressed(axes: Any) -> None:
    """Give axes the common look."""
    axes.ticklabel_format(useOffset=False)
    axes.grid(color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(colors=INK, labelsize=10.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def titled(axes: Any, title: str) -> None:
    """A title at the left, the underscores of a name as spaces."""
    axes.set_title(title.replace("_", " "), fontsize=15, color=INK, loc="left", pad=10)


def named(axes: Any, x: str, y: str) -> None:
    """Names of the axes."""
    axes.set_xlabel(x, fontsize=12, color=INK)
    axes.set_ylabel(y, fontsize=12, color=INK)


def legend(axes: Any, **options: Any) -> None:
    """A legend without a frame."""
    axes.legend(frameon=False, fontsize=11, labelcolor=INK, **options)


def saved(figure: Any, output: str | Path) -> Path:
    """Write a figure as a PNG file."""
    figure.savefig(output, facecolor="white", format="png")
    return Path(output)
