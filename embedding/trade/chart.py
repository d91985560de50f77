"""The picture of a trade: error against CPU time on logarithmic axes, the front as a line, every rung by its choice."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from embedding.view.rendering import require_packages

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from embedding.trade.measuring import Trade

COLOURS = {
    "plan": "#22222a", "order": "#2f78a8", "mesh": "#3fa58a", "order and mesh": "#8fb8a8", "reduction": "#8b2f4b",
    "shell theory": "#c8553d", "faces": "#d8973c", "coupling": "#7a5ba8", "far field": "#b07aa1",
    "reference": "#9a9aa6",
}  # fmt: skip
SIZE, DPI = (7.2, 4.8), 130
NAMED = ("order and mesh",)
"""Rungs of these choices are named only on the front: there are many of them."""
BESIDE = (((5, 4), "left"), ((5, -9), "left"), ((-5, 4), "right"), ((-5, -9), "right"))
"""Where a name may stand beside its point, in typographic points, and which part of it is there; the first is best."""


def trade_plot(trade: Trade, output: str | os.PathLike[str]) -> None:
    """Draw a trade into the PNG file ``output``.

    Raises:
        RenderError: matplotlib is not installed.
        OSError: ``output`` cannot be written.
    """
    figure_of(trade).savefig(output, dpi=DPI, format="png")


def figure_of(trade: Trade) -> Figure:
    """The chart as a figure of matplotlib.

    Raises:
        RenderError: matplotlib is not installed.
    """
    require_packages()
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, layout="constrained")
    axes = figure.add_subplot()
    axes.set(xscale="log", yscale="log", xlabel="CPU time over that of the plan", ylabel=f"error of {trade.quantity}")
    axes.grid(color="#e4e4ea", which="major")
    axes.spines[["top", "right"]].set_visible(False)
    shown = [row for row in trade.rows if row.done and math.isfinite(row.error) and row.error > 0.0]
    on_front = [row for row in trade.front if row in shown]
    axes.plot([trade.cost(row) for row in on_front], [row.error for row in on_front], color="#b8b8c4", zorder=1)
    for of, colour in COLOURS.items():
        rows = [row for row in shown if row.of == of]
        if rows:
            costs, errors = [trade.cost(row) for row in rows], [row.error for row in rows]
            axes.scatter(costs, errors, color=colour, label=of, zorder=2)
    axes.set_title(trade.scene.name.replace("_", " "), loc="left")
    axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    named = [row for row in shown if row in on_front or row.of not in NAMED]
    figure.draw_without_rendering()  # until then nothing has its place
    _name(axes, [(row.rung, (trade.cost(row), row.error)) for row in named])
    return figure


def _name(axes: Any, points: Sequence[tuple[str, tuple[float, float]]]) -> None:
    """Write names beside their points, each where it covers least of other names and of the axis."""
    from matplotlib.transforms import Bbox

    taken = [axes.yaxis.get_tightbbox()]

    def covered(label: Any) -> float:
        common = (Bbox.intersection(label.get_window_extent(), other) for other in taken)
        return sum(box.width * box.height for box in common if box is not None)

    for text, place in points:
        labels = [
            axes.annotate(text, place, offset, textcoords="offset points", ha=side, fontsize=7, color="#44444c")
            for offset, side in BESIDE
        ]
        best = min(labels, key=covered)
        taken.append(best.get_window_extent())
        for label in labels:
            if label is not best:
                label.remove()
