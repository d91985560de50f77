"""Charts of a study: lines over one parameter with families and panels, contour maps over two, in units people read."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from embedding.scene.units import unit_factor
from embedding.studies.errors import StudyError, require
from embedding.studies.record import DONE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from embedding.studies.result import StudyResult

INK, FAINT = "#22222a", "#e4e4ea"
COLOURS = ("#1f3b73", "#2f78a8", "#3fa58a", "#d8973c", "#c8553d", "#8b2f4b")
PANEL, MAP = (4.0, 3.8), (5.6, 4.4)
"""Sizes of a panel of lines and of a map, inches."""
DPI = 130
LEVELS = 9


@dataclass(frozen=True)
class Axis:
    """What is drawn along an axis: a column of the table, what to call it, and in which unit.

    ``label`` is the column's name by default, ``unit`` its SI unit with a prefix that suits the numbers.
    """

    column: str
    label: str = ""
    unit: str = ""
    log: bool = False

    def values(self, result: StudyResult) -> npt.NDArray[np.float64]:
        """The column (n,) in the unit of the axis.

        Raises:
            StudyError: there is no such column, or no numbers are in it.
        """
        column = np.array(self._column(result), dtype=float)
        return self._shown(result)[0] * column

    def text(self, result: StudyResult) -> str:
        """What stands at the axis: ``voltage [kV]``."""
        unit, label = self._shown(result)[1], self.label or self.column.replace("_", " ")
        return f"{label} [{unit}]" if unit else label

    def value_text(self, result: StudyResult, value: float) -> str:
        """What stands beside a line: ``thickness = 0.5 mm``."""
        unit, label = self._shown(result)[1], self.label or self.column.replace("_", " ")
        return f"{label} = {value:.4g} {unit}".rstrip()

    def _column(self, result: StudyResult) -> list[float]:
        columns = result.columns()
        if self.column not in result.units or self.column not in columns:
            there = ", ".join(name for name in result.units if name in columns)
            raise StudyError(f"{self.column}: the table has no numbers of that name; it has {there}")
        return columns[self.column]

    def _shown(self, result: StudyResult) -> tuple[float, str]:
        """The factor from SI, and the unit."""
        column = np.array(self._column(result), dtype=float)
        si = result.units[self.column]
        if not self.unit or si == "1":
            from embedding.view.labels import prefixed  # the pictures behind it are slow to load

            largest = float(np.nanmax(np.abs(column), initial=0.0))
            return (1.0, "") if si == "1" else prefixed(largest, si)
        try:
            return 1.0 / float(unit_factor(self.unit, si)), self.unit.replace("^2", "²").replace("^3", "³")
        except ValueError as error:
            raise StudyError(f"{self.column}: {error}") from error


def lines(
    result: StudyResult,
    x: Axis,
    y: Axis,
    *,
    family: Axis | None = None,
    panels: Axis | None = None,
    reference: Axis | None = None,
) -> Figure:
    """Lines of ``y`` over ``x``: one for each value of ``family``, in one panel for each value of ``panels``.

    A line that the study could not follow, as beyond a pull-in, ends with a cross at its last case that is done.
    The column ``reference`` is dotted, its label said once.

    Raises:
        StudyError: a column does not exist, or matplotlib is missing.
    """
    panel = np.zeros(len(result.rows)) if panels is None else panels.values(result)
    places = np.unique(panel)
    figure, axes = figure_of(len(places), PANEL, shared=True)
    for one, place in zip(axes, places, strict=True):
        draw_lines(one, result, x, y, family=family, reference=reference, where=panel == place)
        if panels is not None:
            one.set_title(panels.value_text(result, place), fontsize=11, color=INK)
    for one in axes[1:]:
        one.set_ylabel("")
        if (legend := one.get_legend()) is not None:
            legend.remove()
    return figure


def draw_lines(
    axes: Axes,
    result: StudyResult,
    x: Axis,
    y: Axis,
    *,
    family: Axis | None = None,
    reference: Axis | None = None,
    where: npt.NDArray[np.bool_] | None = None,
) -> None:
    """The lines of one panel, see `lines`, on ``axes`` of matplotlib; of the rows ``where`` (n,), by default all."""
    across, up = x.values(result), y.values(result)
    dotted = None if reference is None else reference.values(result)
    kind = np.zeros(len(across)) if family is None else family.values(result)
    shown = np.ones(len(across), dtype=bool) if where is None else where
    done = np.array([row.status == DONE for row in result.rows])
    members = np.unique(kind[shown])
    for number, (colour, member) in enumerate(zip(_colours(len(members)), members, strict=True)):
        here = np.flatnonzero(shown & (kind == member))
        here = here[np.argsort(across[here], kind="stable")]
        label = None if family is None else family.value_text(result, member)
        _line(axes, across[here], up[here], done[here], colour, label)
        if reference is not None and dotted is not None:
            known = (reference.label or reference.column) if number == len(members) - 1 else None
            axes.plot(across[here], dotted[here], ":", color="black", linewidth=1.6, label=known, zorder=3)
    _label(axes, result, x, y)
    if family is not None or reference is not None:
        axes.legend(frameon=False, fontsize=9, labelcolor=INK)


def contours(
    result: StudyResult,
    x: Axis,
    y: Axis,
    z: Axis,
    *,
    levels: Sequence[float] | None = None,
    reference: Axis | None = None,
) -> Figure:
    """A map of ``z`` over ``x`` and ``y``: filled, with labelled contours, and a dot for each case that is done.

    Cases without the number leave a hole. ``levels`` are in the unit of ``z``. The contours of the column
    ``reference`` are dotted.

    Raises:
        StudyError: a column does not exist, there is no value for some pair of x and y, or matplotlib is missing.
    """
    across, up, height = gridded(result, x, y, z)
    figure, axes = figure_of(1, MAP)
    one = axes[0]
    _label(one, result, x, y)  # before labels are placed along lines
    chosen = _levels(height, z.log) if levels is None else np.array(levels)
    values = np.ma.masked_invalid(height)
    from matplotlib.colors import LogNorm
    from matplotlib.patheffects import withStroke

    norm = LogNorm(chosen[0], chosen[-1]) if z.log else None
    filled = one.contourf(across, up, values, chosen, cmap="viridis", norm=norm, extend="both", alpha=0.9)
    drawn = one.contour(across, up, values, chosen, colors="white", linewidths=1.1)
    if reference is not None:
        known = gridded(result, x, y, reference)[2]
        one.contour(across, up, known, chosen, colors="black", linestyles="dotted", zorder=3)
        one.plot([], [], ":", color="black", label=reference.label or reference.column)
        one.legend(loc="upper center", bbox_to_anchor=(0.5, 1.1), frameon=False, fontsize=9, labelcolor=INK)
    there = np.isfinite(height)
    mesh = np.meshgrid(across, up)
    one.plot(mesh[0][there], mesh[1][there], ".", color="white", markersize=3, alpha=0.7)
    bar = figure.colorbar(filled, ax=one, format=lambda level, _: f"{level:.4g}")
    bar.set_label(z.text(result), color=INK)
    figure.draw_without_rendering()  # places of labels are those of the final layout
    # Lines are not cut for their labels: on logarithmic axes matplotlib would cut them beside the line.
    for label in one.clabel(drawn, inline=False, fontsize=9, fmt=lambda level: f"{level:.4g}", zorder=4):
        label.set_path_effects([withStroke(linewidth=3.0, foreground=INK)])
    one.grid(False)
    return figure


def gridded(
    result: StudyResult, x: Axis, y: Axis, z: Axis
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Different values of ``x`` (n,) and ``y`` (m,), and ``z`` (m, n) at them, in the units of the axes.

    Raises:
        StudyError: a column does not exist, or a pair of x and y has no case, or several.
    """
    across, up, height = x.values(result), y.values(result), z.values(result)
    columns, column = np.unique(across, return_inverse=True)
    rows, row = np.unique(up, return_inverse=True)
    places = row * len(columns) + column
    if sorted(places.tolist()) != list(range(len(rows) * len(columns))):
        raise StudyError(f"a map over {x.column} and {y.column} needs one case for each pair of their values")
    table = np.empty(len(places))
    table[places] = height
    return columns, rows, table.reshape(len(rows), len(columns))


def save(figure: Figure, path: str | os.PathLike[str], format: str | None = None) -> Path:
    """Write a chart as "png", "pdf" or "svg", by default by the name of the file."""
    figure.savefig(path, facecolor="white", format=format)
    return Path(path)


def figure_of(
    panels: int, size: tuple[float, float] = PANEL, *, shared: bool = False
) -> tuple[Figure, list[Axes]]:
    """An empty figure with axes side by side, each of ``size`` in inches; ``shared``: with the same limits.

    Raises:
        StudyError: matplotlib is missing.
    """
    require("matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(size[0] * panels, size[1]), dpi=DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = list(figure.subplots(1, panels, sharex=shared, sharey=shared, squeeze=False)[0])
    for one in axes:
        one.grid(color=FAINT, linewidth=0.8)
        one.tick_params(colors=INK, labelsize=10)
        for side in ("top", "right"):
            one.spines[side].set_visible(False)
    return figure, axes


def _label(axes: Axes, result: StudyResult, x: Axis, y: Axis) -> None:
    """Names, units and scales of both axes; logarithmic ones have plain numbers at 1, 2 and 5."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xlabel(x.text(result), color=INK)
    axes.set_ylabel(y.text(result), color=INK)
    for axis, where, scale in ((x, axes.xaxis, axes.set_xscale), (y, axes.yaxis, axes.set_yscale)):
        scale("log" if axis.log else "linear")
        if axis.log:
            decades = np.ptp(np.log10(axis.values(result)))
            where.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if decades < 2.5 else (1.0,)))
            where.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            where.set_minor_formatter(NullFormatter())


def _line(axes: Axes, x: Any, y: Any, done: Any, colour: Any, label: str | None) -> None:
    """One line through what is there, with a cross where the next case is not."""
    there = done & np.isfinite(y)
    axes.plot(x[there], y[there], "-o", color=colour, linewidth=1.8, markersize=3.5, label=label)
    ends = np.flatnonzero(there)
    if len(ends) and ends[-1] + 1 < len(x):
        axes.plot(x[ends[-1]], y[ends[-1]], "x", color=colour, markersize=9, markeredgewidth=2.0)


def _colours(count: int) -> list[Any]:
    from matplotlib import colormaps

    if count <= len(COLOURS):
        return [COLOURS[round(i)] for i in np.linspace(0, len(COLOURS) - 1, count)]
    return [colormaps["viridis"](part) for part in np.linspace(0.0, 0.9, count)]


def _levels(height: npt.NDArray[np.float64], log: bool) -> npt.NDArray[np.float64]:
    """Round levels between the smallest and the largest value."""
    from matplotlib.ticker import LogLocator, MaxNLocator

    low, high = float(np.nanmin(height)), float(np.nanmax(height))
    locator = LogLocator(subs=(1.0, 2.0, 5.0), numticks=20) if log else MaxNLocator(LEVELS)
    return np.array(locator.tick_values(low, high))
