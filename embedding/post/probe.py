"""Probes: the potential and the field at points of the space that moves with the shell, and on the shell itself."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive, open_archive
from embedding.post.faces import half_thickness
from embedding.post.locate import Found
from embedding.post.patches import SIDES, Patch, side_named
from embedding.post.space import Places, Space, centre_of_outer
from embedding.post.table import PostError, Table, stacked

Floats = npt.NDArray[np.float64]
Source = Archive | str | os.PathLike[str]
MOST_POINTS = 1_000_000
"""Of a line."""
OFF = 1e-3  # how far beside the mid-surface, relative to the size of the shell, a material point counts as on it
TOUCHING = 1e-4  # the same of a point in space: closer than a mesh knows where its surface is
IN_SHELL, IN_BODY, BEYOND = "in the shell", "in a body, or where no field is meshed", "beyond the meshed space"
BETWEEN, OTHER_SIDE = "on the interface: name the side", "not on this side"
NOT_ON_SHELL = "not on the shell"


def opened(archive: Source) -> Archive:
    """An archive, also from its path. Raises PostError if no step was accepted."""
    found = archive if isinstance(archive, Archive) else open_archive(archive)
    if not len(found):
        raise PostError(f"{found.path}: no step was accepted")
    return found


def probe(
    archive: Source,
    points: npt.ArrayLike,
    *,
    fields: Sequence[str] | None = None,
    side: str | None = None,
    steps: Sequence[int] | None = None,
) -> Table:
    """Fields of the ambient at ``points`` (n, 3) in m of the deformed configuration, which do not move.

    One row for every step and point: ``step`` (from 1), ``factor_mechanical``, ``factor_field``, ``point``, ``x``,
    ``y``, ``z``, ``where`` and the ``fields`` (default: all but the motion), a vector as its components and its
    length. The values are those of the archive's high-order cells, float32; where the run used mirror planes or an
    axis, the point may lie anywhere in space. ``steps`` counts from 0 as the archive does (default: all).

    ``where`` is "outside" or "inside"; or it says why there is nan: the point is in the shell, in a body, or beyond
    the meshed space. A point of the interface belongs to two sides, and gets values if ``side`` says which
    ("outside" or "top", "inside" or "bottom"); with a ``side``, a point within the thickness of the shell is read on
    that face.

    Raises:
        PostError: no step, nothing meshed around the shell, or a wrong side.
        ArchiveError: the archive cannot be read, or it has no such field or step.
    """
    run = opened(archive)
    names = SIDES if side is None else (side_named(run, side),)
    side_named(run, names[0])
    places = Space.of(run).folded(_points(points))
    wanted = _wanted(run, names[0], fields)
    return _over_steps(
        run, points, steps, lambda step: _ambient_rows(run, names, step, places, wanted), wanted, names[0]
    )


def probe_shell(
    archive: Source,
    points: npt.ArrayLike,
    *,
    fields: Sequence[str] | None = None,
    side: str | None = None,
    steps: Sequence[int] | None = None,
) -> Table:
    """Fields of the shell at material points, followed over the steps: ``points`` (n, 3) in m of the undeformed
    mid-surface.

    Columns as :func:`probe` has them, with ``fields`` of the shell (default: all but the motion, "u"). With a ``side``
    come the fields of the ambient on that face instead. ``where`` is "shell" or the side; a point that is farther from
    the mid-surface than a thousandth of the shell's size has nan.

    Raises:
        PostError: no step, or a wrong side.
        ArchiveError: the archive cannot be read, or it has no such field or step.
    """
    run = opened(archive)
    block = "shell" if side is None else side_named(run, side)
    wanted = _wanted(run, block, fields)
    places = Space.of(run).folded(_points(points))
    return _over_steps(run, points, steps, lambda step: _shell_rows(run, block, step, places, wanted), wanted, block)


def line(
    archive: Source,
    start: Sequence[float],
    end: Sequence[float],
    *,
    count: int = 101,
    fields: Sequence[str] | None = None,
    side: str | None = None,
    steps: Sequence[int] | None = None,
) -> Table:
    """:func:`probe` at ``count`` points evenly spaced from ``start`` to ``end``, with the ``distance`` from there."""
    if not 2 <= count <= MOST_POINTS:
        raise PostError(f"a line has at least 2 points and at most {MOST_POINTS}, not {count}")
    begin, stop = _points([start])[0], _points([end])[0]
    table = probe(
        archive, np.linspace(begin, stop, count), fields=fields, side=side, steps=steps
    )
    columns = dict(table.columns)
    place = np.column_stack([columns[axis] for axis in "xyz"])
    before = {name: columns.pop(name) for name in ("step", "factor_mechanical", "factor_field", "point")}
    columns = before | {"distance": np.linalg.norm(place - begin, axis=1)} | columns
    return Table(columns, table.units | {"distance": "m"}, table.notes)


def _points(points: npt.ArrayLike) -> Floats:
    array = np.atleast_2d(np.asarray(points, float))
    if array.ndim != 2 or array.shape[1] != 3 or not np.isfinite(array).all():
        raise PostError("points have three finite coordinates each, in m")
    return array


def _wanted(archive: Archive, block: str, fields: Sequence[str] | None) -> tuple[str, ...]:
    there = archive.block(block, -1)
    if fields is None:
        return tuple(name for name in there.fields if name != "u")
    for name in fields:
        there.field(name)  # raises the error that lists what there is
    return tuple(fields)


def _over_steps(
    run: Archive, points: npt.ArrayLike, steps: Sequence[int] | None, rows: Any, wanted: Sequence[str], block: str
) -> Table:
    """The rows of all steps, with what is known of each step before them."""
    where = _points(points)
    tables = []
    for number in range(len(run)) if steps is None else map(run.index, steps):
        words, values = rows(number)
        known: dict[str, npt.NDArray[Any]] = {
            "step": np.full(len(where), number + 1),
            "factor_mechanical": np.full(len(where), run.steps[number].factor_mechanical),
            "factor_field": np.full(len(where), run.steps[number].factor_field),
            "point": np.arange(1, len(where) + 1),
            **{axis: where[:, column] for column, axis in enumerate("xyz")},
            "where": np.array(words, dtype=object),
        }
        for name in wanted:
            known |= _columns(name, values[name])
        tables.append(Table(known))
    table = stacked(tables)
    units = {axis: "m" for axis in "xyz"}
    stored = run.block(block).units
    for name in wanted:
        units |= {column: stored[name] for column in table.columns if column == name or column.startswith(f"{name}_")}
    return Table(table.columns, units)


def _columns(name: str, values: Floats) -> dict[str, Floats]:
    """A scalar as one column, a vector as three and its length, anything else by number."""
    if values.ndim == 1:
        return {name: values}
    labels = "xyz" if values.shape[1] == 3 else [str(number + 1) for number in range(values.shape[1])]
    columns = {f"{name}_{label}": values[:, column] for column, label in enumerate(labels)}
    return columns | ({name: np.linalg.norm(values, axis=1)} if values.shape[1] == 3 else {})


def _ambient_rows(
    run: Archive, sides: Sequence[str], step: int, places: Places, wanted: Sequence[str]
) -> tuple[list[str], dict[str, Floats]]:
    """For every point the word for where it is, and the values of the fields."""
    patches = {name: Patch.of(run, name, step) for name in sides}
    found = {name: patch.find(places.points) for name, patch in patches.items()}
    words = np.full(len(places.points), "", dtype=object)
    hits = np.stack([one.hit for one in found.values()])
    shell = Patch.of(run, "shell", step)
    apart = _distance(shell, places.points, hits.sum(axis=0) != 1)
    half = max(half_thickness(run, shell), OFF * run.scales.length)
    if len(sides) == 1:
        found[sides[0]] = _on_face(patches[sides[0]], places.points, found[sides[0]], apart <= half * (1 + OFF))
        hits = np.stack([found[sides[0]].hit])
    words[hits.any(axis=0) & (apart <= TOUCHING * run.scales.length) & (len(sides) > 1)] = BETWEEN
    missed = ~hits.any(axis=0)
    words[missed] = _reasons(run, patches, places.points[missed], apart[missed] <= half)
    values = {name: _empty(patches[sides[0]], name, len(words)) for name in wanted}
    for side in sides:
        take = found[side].hit & (words == "")
        words[take] = side
        for name in wanted:
            rows = Found(found[side].cell[take], found[side].place[take], found[side].distance[take])
            values[name][take] = places.rows(take).unfolded(name, patches[side].values(name, rows))
    return words.tolist(), values


def _on_face(patch: Patch, points: Floats, found: Found, near: npt.NDArray[np.bool_]) -> Found:
    """Points in the shell are read on the nearest face: their cells are looked for a little inside the block."""
    missing = np.flatnonzero(near & ~found.hit)
    if not len(missing):
        return found
    face = patch.boundary
    at = face.where(face.find(points[missing]))
    again = patch.find(at)
    cell, place, distance = found.cell.copy(), found.place.copy(), found.distance.copy()
    cell[missing], place[missing], distance[missing] = again.cell, again.place, again.distance
    return Found(cell, place, distance)


def _shell_rows(
    run: Archive, block: str, step: int, places: Places, wanted: Sequence[str]
) -> tuple[list[str], dict[str, Floats]]:
    rest = Patch.of(run, "shell", step, deformed=False)
    found = rest.find(places.points)
    on = found.distance <= OFF * run.scales.length
    words = np.where(on, block, NOT_ON_SHELL).astype(object)
    patch = rest
    if block != "shell":
        moved = rest.where(found) + rest.values("u", found)
        patch = Patch.of(run, block, step).boundary
        found = patch.find(moved)
    values = {}
    for name in wanted:
        read = places.unfolded(name, patch.values(name, found))
        read[~on] = np.nan
        values[name] = read
    return words.tolist(), values


def _distance(shell: Patch, points: Floats, asked: npt.NDArray[np.bool_]) -> Floats:
    """Distance of points from the deformed mid-surface; infinite where it is not ``asked`` for and not small."""
    from scipy.spatial import cKDTree

    apart = np.full(len(points), np.inf)
    widest = float(np.ptp(shell.corners, axis=1).max())
    close = np.asarray(cKDTree(shell.nodes).query(points)[0]) <= widest
    if (asked | close).any():
        apart[asked | close] = shell.find(points[asked | close]).distance
    return apart


def _reasons(run: Archive, patches: dict[str, Patch], points: Floats, in_shell: npt.NDArray[np.bool_]) -> list[str]:
    """Why points were not found in any of the blocks."""
    centre = centre_of_outer(run)
    outer = max(float(np.linalg.norm(patch.nodes - centre, axis=1).max()) for patch in patches.values())
    if len(patches) == 1:
        others = [Patch.of(run, side, next(iter(patches.values())).step) for side in SIDES if side not in patches]
        elsewhere = np.any([other.find(points).hit for other in others], axis=0)
        outer = max(outer, *(float(np.linalg.norm(other.nodes - centre, axis=1).max()) for other in others))
    else:
        elsewhere = np.zeros(len(points), bool)
    far = np.linalg.norm(points - centre, axis=1) > 0.999 * outer
    words = np.where(far, BEYOND, np.where(in_shell, IN_SHELL, np.where(elsewhere, OTHER_SIDE, IN_BODY)))
    return [str(word) for word in words]


def _empty(patch: Patch, name: str, count: int) -> Floats:
    shape = patch.block.field(name, patch.step).shape[1:]
    return np.full((count, *shape), np.nan)
