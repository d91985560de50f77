"""Charts of probes: fields along a line, or at points over the steps."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from embedding.errors import ArchiveError
from embedding.post import Table
from embedding.view import chart
from embedding.view.labels import label, prefixed

WIDTH, ROW = 7.6, 3.3
MOST = 5  # steps that are drawn of a line
KNOWN = ("step", "factor_mechanical", "factor_field", "point", "x", "y", "z", "distance", "where")


def probe_plot(table: Table, output: str | os.PathLike[str], *, title: str = "") -> Path:
    """Draw a table of ``embedding.post.probe``, ``probe_shell`` or ``line`` into the PNG file ``output``.

    Of a line the fields are drawn over the distance from its start, for at most five steps; of points over the load,
    a curve each. Vectors are shown by their length. Where there is no value there is a gap.

    Raises:
        RenderError: matplotlib is not installed; the message says how to install it.
        ArchiveError: there is nothing to draw.
        OSError: ``output`` cannot be written.
    """
    return chart.saved(probe_figure(table, title), Path(output))


def probe_figure(table: Table, title: str = "") -> Any:
    """The figure of :func:`probe_plot`, not yet saved."""
    names = shown(table)
    if not names:
        raise ArchiveError("the table has no field to draw")
    figure, axes = chart.new_figure(WIDTH, ROW * len(names) + 0.6, len(names))
    over = _over(table)
    for one, name in zip(axes, names, strict=True):
        unit = table.units.get(name, "1")
        known = np.abs(table[name][np.isfinite(table[name])])
        factor, unit = prefixed(float(known.max(initial=0.0)), unit)
        for number, (words, x, rows) in enumerate(over):
            style = {"marker": chart.MARKERS[number % len(chart.MARKERS)]} if "distance" not in table else {}
            colour = _colour(number, len(over), "distance" in table)
            curve = _broken(x[rows], factor * table[name][rows], table["where"][rows])
            one.plot(*curve, color=colour, linewidth=2.0, markersize=5, label=words, **style)
        one.set_ylabel(label(name, unit), fontsize=12, color=chart.INK)
    if title:
        chart.titled(axes[0], title)
    axes[-1].set_xlabel(_axis(table)[1], fontsize=12, color=chart.INK)
    if "distance" not in table:
        axes[-1].xaxis.get_major_locator().set_params(integer=True)
    if len(over) > 1:
        chart.legend(axes[0])
    return figure


def shown(table: Table) -> list[str]:
    """The scalars, and the lengths of vectors: columns that are no component of another one."""
    fields = [name for name in table.columns if name not in KNOWN]
    return [name for name in fields if not (name[-2:] in ("_x", "_y", "_z") and name[:-2] in fields)]


def _axis(table: Table) -> tuple[Any, str]:
    """What is drawn along x, and its name."""
    if "distance" in table:
        factor, unit = prefixed(float(table["distance"].max()), "m")
        return factor * table["distance"], f"distance along the line [{unit}]"
    return table["step"].astype(float), "accepted step"


def _over(table: Table) -> list[tuple[str, Any, Any]]:
    """The curves: their words, x, and the rows of the table that they consist of."""
    x, _ = _axis(table)
    if "distance" not in table:
        points = np.unique(table["point"])
        return [(_place(table, int(point)), x, table["point"] == point) for point in points]
    steps = np.unique(table["step"])
    chosen = steps[np.unique(np.linspace(0, len(steps) - 1, min(MOST, len(steps))).round().astype(int))]
    return [(f"step {step}", x, table["step"] == step) for step in chosen]


def _broken(x: Any, y: Any, where: Any) -> tuple[Any, Any]:
    """A curve with gaps where it goes from one side of the shell to the other."""
    breaks = np.flatnonzero(where[1:] != where[:-1]) + 1
    return np.insert(x, breaks, np.nan), np.insert(y, breaks, np.nan)


def _place(table: Table, point: int) -> str:
    row = int(np.flatnonzero(table["point"] == point)[0])
    size = float(max(np.abs(table[axis]).max() for axis in "xyz"))
    factor, unit = prefixed(size, "m")
    return "(" + ", ".join(f"{factor * table[axis][row]:.4g}" for axis in "xyz") + f") {unit}"


def _colour(number: int, count: int, graded: bool) -> Any:
    """Points have colours of their own; steps go from light to dark."""
    if not graded:
        return chart.COLOURS[number % len(chart.COLOURS)]
    from matplotlib import colormaps

    return colormaps["YlGnBu"](0.35 + 0.6 * (number + 1) / count)
