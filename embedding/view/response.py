"""Response curves: any scalar of a run against any other, stable states solid, unstable ones dashed, limit points
marked."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, open_archive
from embedding.errors import ArchiveError
from embedding.view import chart
from embedding.view.labels import prefixed, scalar_label

Floats = npt.NDArray[np.float64]
SIZE = (7.6, 5.4)
LOADS = ("voltage", "voltage_jump", "pressure_difference", "factor_mechanical", "factor_field")
SAME = 1e-9
STYLES: dict[str, dict[str, Any]] = {
    "stable": {"color": chart.COLOURS[0], "linestyle": "-"},
    "unstable": {"color": chart.COLOURS[1], "linestyle": (0, (4, 2.2))},
    "stability not known": {"color": chart.GREY, "linestyle": "-"},
}
CRITICAL: dict[str, dict[str, Any]] = {
    "limit": {"marker": "D", "color": chart.INK, "markersize": 7.5},
    "bifurcation": {"marker": "*", "color": chart.INK, "markersize": 13},
    "turning": {"marker": "D", "color": chart.INK, "markersize": 7.5, "markerfacecolor": "white"},
}
WORDS = {"turning": "largest or least load"}


@dataclass(frozen=True)
class Response:
    """Two scalars along a path: ``x`` and ``y`` at the steps and at the critical points between them, in SI units.

    ``pieces`` are the runs of points of one kind of ``STYLES``; ``critical`` holds (kind, x, y).
    """

    names: tuple[str, str]
    units: tuple[str, str]
    steps: Floats
    pieces: tuple[tuple[str, Floats], ...]
    critical: tuple[tuple[str, float, float], ...]

    @staticmethod
    def of(archive: Archive, x: str | None = None, y: str | None = None) -> Response:
        """The curve of scalar ``y`` over ``x``; "step" is the number of the step.

        Default: the load that changes most, over the mean stretch of a closed shell or the displacement of an open one.

        Raises:
            ArchiveError: no such scalar; the message lists those there are.
        """
        names = x or _answer(archive), y or _load(archive)
        steps = np.column_stack([_scalar(archive, name) for name in names])
        points, kinds, critical = _with_critical(archive, names, steps)
        if names[1] in LOADS and not critical:
            critical = _turns(steps)
        units = tuple("1" if name == "step" else archive.scalar_units[name] for name in names)
        return Response(names, (units[0], units[1]), steps, tuple(_pieces(points, kinds)), tuple(critical))


def response_plot(
    archive: str | os.PathLike[str], output: str | os.PathLike[str], *, x: str | None = None, y: str | None = None
) -> Path:
    """Draw scalar ``y`` over ``x`` along the path into the PNG file ``output``, and return its path.

    States that were found stable are solid, unstable ones dashed, those whose stability is not known grey. Limit and
    bifurcation points are marked.

    Raises:
        RenderError: matplotlib is not installed; the message says how to install it.
        ArchiveError: the archive cannot be read, or it has no accepted step or no such scalar.
        OSError: ``output`` cannot be written.
    """
    opened = open_archive(archive)
    return chart.saved(response_figure(opened, x, y), Path(output))


def response_figure(archive: Archive, x: str | None = None, y: str | None = None) -> Any:
    """The figure of :func:`response_plot`, not yet saved."""
    if not len(archive):
        raise ArchiveError(f"{archive.path}: no step was accepted, so there is nothing to plot")
    response = Response.of(archive, x, y)
    figure, (axes,) = chart.new_figure(*SIZE)
    sizes = np.abs(response.steps).max(axis=0)
    scales = [prefixed(float(size), unit) for size, unit in zip(sizes, response.units, strict=True)]
    factors = np.array([factor for factor, _ in scales])
    told: set[str] = set()
    for kind, points in response.pieces:
        axes.plot(
            *(factors * points).T, linewidth=2.2, zorder=2, label=None if kind in told else kind, **STYLES[kind]
        )
        told.add(kind)
    axes.plot(*(factors * response.steps).T, "o", color=chart.INK, markersize=3.2, zorder=3, label="accepted steps")
    for kind, *place in response.critical:
        words = None if kind in told else WORDS.get(kind, f"{kind} point")
        axes.plot(*(factors * place), linestyle="none", zorder=4, label=words, **CRITICAL[kind])
        told.add(kind)
    chart.titled(axes, archive.run["name"])
    chart.named(axes, *(scalar_label(name, unit) for name, (_, unit) in zip(response.names, scales, strict=True)))
    chart.legend(axes)
    return figure


def _scalar(archive: Archive, name: str) -> Floats:
    if name == "step":
        return np.arange(1.0, len(archive) + 1)
    if name not in archive.scalars:
        there = ", ".join(["step", *archive.scalars])
        raise ArchiveError(f"{archive.path}: no scalar {name!r}; there are {there}")
    return archive.scalars[name]


def _load(archive: Archive) -> str:
    """The load that is worked with: the first of ``LOADS`` that changes in the last stage, or at all."""
    stages = np.array([step.stage for step in archive.steps])
    for rows in (stages == stages[-1], np.ones(len(stages), bool)):
        for name in LOADS:
            values = archive.scalars.get(name, np.zeros(len(stages)))[rows]
            if np.ptp(values) > SAME * float(np.abs(values).max(initial=0.0)):
                return name
    return "factor_mechanical"


def _answer(archive: Archive) -> str:
    return "stretch" if "volume_ratio" in archive.scalars else "displacement"


def _with_critical(
    archive: Archive, names: tuple[str, str], steps: Floats
) -> tuple[Floats, list[str], list[tuple[str, float, float]]]:
    """The points of the path with the critical ones in their places, what kind the way to each next point is, and the
    critical points."""
    counts = archive.scalars.get("unstable_modes", np.full(len(steps), math.nan))
    points, kinds, critical = [steps[0]], [], []
    between: dict[int, list[Any]] = {}
    for point in archive.critical_points:
        between.setdefault(point.before_step, []).append(point)
    for number in range(1, len(steps)):
        before = counts[number - 1]
        for point in between.get(number + 1, ()):
            place = _at(point, names)
            if place is not None:
                points.append(np.array(place))
                kinds.append(_kind(before, point.unstable[0]))
                critical.append((point.kind, *place))
            before = math.nan if point.unstable[1] is None else point.unstable[1]
        points.append(steps[number])
        kinds.append(_kind(before, counts[number]))
    return np.array(points), kinds, critical


def _turns(steps: Floats) -> list[tuple[str, float, float]]:
    """Where a load that is not prescribed turns: the vertex of the parabola through three steps."""
    found = []
    for number in range(1, len(steps) - 1):
        before, here, after = steps[number - 1 : number + 2, 1]
        if (here - before) * (after - here) < 0:
            at = 0.5 * (before - after) / (before - 2 * here + after)
            x, y = (
                here + at * (after - before) / 2 + at**2 * (before - 2 * here + after) / 2
                for before, here, after in steps[number - 1 : number + 2].T
            )
            found.append(("turning", float(x), float(y)))
    return found


def _at(point: Any, names: tuple[str, str]) -> tuple[float, float] | None:
    """Where a critical point is in the plane of two scalars; None where it does not have them."""
    known = point.scalars | {"factor_mechanical": point.factor_mechanical, "factor_field": point.factor_field}
    if not all(name in known for name in names):
        return None
    return float(known[names[0]]), float(known[names[1]])


def _kind(begin: float | None, end: float | None) -> str:
    """Of the way between two points with so many unstable modes."""
    if begin is None or end is None or math.isnan(begin) or math.isnan(end):
        return "stability not known"
    return "stable" if begin == 0 and end == 0 else "unstable"


def _pieces(points: Floats, kinds: list[str]) -> list[tuple[str, Floats]]:
    """Runs of one kind, each with the point where it begins."""
    pieces, begin = [], 0
    for end in range(1, len(kinds) + 1):
        if end == len(kinds) or kinds[end] != kinds[begin]:
            pieces.append((kinds[begin], points[begin : end + 1]))
            begin = end
    return pieces if kinds else [("stable", points)]
