"""Two archives beside each other: the same scene, the same steps, the same fields?"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from embedding.archive import Archive
from embedding.post.measure import Measure
from embedding.post.patches import Patch
from embedding.post.probe import Source, opened
from embedding.post.table import PostError, Table

Floats = npt.NDArray[np.float64]
TOLERANCE = 1e-6
SAME_LOAD = 1e-9
NOISE = 1e-12  # of the largest scalar of the same unit
COLUMNS = ("kind", "name", "unit", "max", "rms", "relative", "step")


@dataclass(frozen=True)
class Comparison:
    """What two archives have in common and how far they are apart.

    ``scene``: fields of the scene that differ, as (path, in the first, in the second). ``only`` holds the names of
    quantities that one of them lacks. ``table`` has a row for each common scalar and field: the largest difference and
    the root mean square, in its unit; the largest difference ``relative`` to the largest value in either; the ``step``
    of the first where it is largest. ``factors`` says at how many common load factors they were compared.
    """

    scene: tuple[tuple[str, str, str], ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]
    table: Table
    factors: int
    tolerance: float

    @property
    def same(self) -> bool:
        """Are there common steps, and no difference in them above the tolerance?"""
        relative = self.table["relative"].astype(float)
        return self.factors > 0 and bool(np.all(relative <= self.tolerance))


def compare(first: Source, second: Source, *, tolerance: float = TOLERANCE) -> Comparison:
    """Compare two archives step by step and field by field.

    Steps are matched by load factors and stage, in the order of the paths; where the second has no step at a load of
    the first, that one is left out. Fields are compared at the nodes of the first, at the same places of the undeformed
    body; those of another mesh are interpolated by its own high-order cells. Their root mean square is that over the
    deformed first and its steps. A scalar or a field far below the largest of its unit is rounding, and does not count.

    Raises:
        PostError: one of them has no step, or a tolerance that is negative or no number.
        ArchiveError: one of them cannot be read.
    """
    if not tolerance >= 0.0:
        raise PostError(f"a tolerance is 0 or more, not {tolerance:g}")
    one, other = opened(first), opened(second)
    pairs = _matched(one, other)
    rows = [*_scalar_rows(one, other, pairs), *_field_rows(one, other, pairs)]
    columns: dict[str, npt.NDArray[Any]] = {
        name: np.array([row[number] for row in rows], dtype=object if number < 3 else None)
        for number, name in enumerate(COLUMNS)
    }
    names, others = _names(one), _names(other)
    only = tuple(sorted(names - others)), tuple(sorted(others - names))
    return Comparison(_scene_differences(one, other), only, Table(columns), len(pairs), tolerance)


def _names(archive: Archive) -> set[str]:
    fields = {f"{block}.{field}" for block in archive.blocks for field in archive.block(block).fields}
    return set(archive.scalars) | fields


def _scene_differences(one: Archive, other: Archive) -> tuple[tuple[str, str, str], ...]:
    first, second = (_flat(archive.scene_table()) for archive in (one, other))
    paths = dict.fromkeys([*first, *second])
    absent = "absent"
    return tuple(
        (path, str(first.get(path, absent)), str(second.get(path, absent)))
        for path in paths
        if first.get(path, absent) != second.get(path, absent)
    )


def _flat(value: Any, path: str = "") -> dict[str, Any]:
    """Every number and text of nested tables by its path: "shell.shape.radius"."""
    if isinstance(value, dict):
        items = [(str(key), item) for key, item in value.items()]
    elif isinstance(value, list) and any(isinstance(item, dict) for item in value):
        items = [(str(number), item) for number, item in enumerate(value)]
    else:
        return {path: value}
    return {name: leaf for key, item in items for name, leaf in _flat(item, f"{path}.{key}" if path else key).items()}


def _matched(one: Archive, other: Archive) -> list[tuple[int, int]]:
    """Pairs of steps at the same load, in the order of both paths."""
    pairs, begin = [], 0
    for number, step in enumerate(one.steps):
        for later in range(begin, len(other)):
            candidate = other.steps[later]
            apart = step.factor_mechanical - candidate.factor_mechanical, step.factor_field - candidate.factor_field
            if step.stage == candidate.stage and max(map(abs, apart)) <= SAME_LOAD:
                pairs.append((number, later))
                begin = later + 1
                break
    return pairs


def _scalar_rows(one: Archive, other: Archive, pairs: list[tuple[int, int]]) -> list[tuple[Any, ...]]:
    rows, units = [], one.scalar_units
    largest_of: dict[str, float] = {}
    for name, values in one.scalars.items():
        largest_of[units[name]] = max(largest_of.get(units[name], 0.0), float(np.nanmax(np.abs(values), initial=0.0)))
    for name, values in one.scalars.items():
        if name not in other.scalars or not pairs or name.startswith("factor_"):
            continue
        a, b = (array[[pair[which] for pair in pairs]] for which, array in enumerate((values, other.scalars[name])))
        gaps = np.where(np.isnan(a) & np.isnan(b), 0.0, np.abs(a - b))
        gaps[np.isnan(gaps)] = math.inf  # known to one of them only
        size = float(np.nanmax(np.abs([a, b]), initial=0.0))
        where = int(np.argmax(gaps))
        rms = float(np.sqrt(np.mean(gaps**2)))
        largest = float(gaps[where])
        relative = 0.0 if size < NOISE * largest_of[units[name]] else _relative(largest, size)
        rows.append(("scalar", name, units[name], largest, rms, relative, pairs[where][0] + 1))
    return rows


def _relative(gap: float, size: float) -> float:
    return gap / size if size and gap < math.inf else (0.0 if gap == 0.0 else math.inf)


def _field_rows(one: Archive, other: Archive, pairs: list[tuple[int, int]]) -> list[tuple[Any, ...]]:
    rows: list[tuple[str, str, _Difference]] = []
    for block in one.blocks:
        if block not in other.blocks or not pairs:
            continue
        names = [name for name in one.block(block).fields if name in other.block(block).units]
        found = {name: _Difference() for name in names}
        for number, partner in pairs:
            a, b = (Patch.of(run, block, step) for run, step in ((one, number), (other, partner)))
            _add(found, a, b, number)
        units = one.block(block).units
        rows += [(f"{block}.{name}", units[name], found[name]) for name in names]
    largest_of: dict[str, float] = {}
    for _, unit, difference in rows:
        largest_of[unit] = max(largest_of.get(unit, 0.0), difference.size)
    return [("field", name, unit, *difference.row(NOISE * largest_of[unit])) for name, unit, difference in rows]


class _Difference:
    """The difference of one field, gathered over the steps."""

    def __init__(self) -> None:
        self.largest, self.size, self.square, self.measure, self.step = 0.0, 0.0, 0.0, 0.0, 1

    def add(self, a: Floats, b: Floats, patch: Patch, measure: Measure, step: int) -> None:
        apart = a - b
        known = np.isfinite(apart.reshape(len(apart), -1)).all(axis=1)
        gap = np.where(known, np.abs(apart.reshape(len(apart), -1)).max(axis=1), 0.0)
        if gap.max(initial=0.0) > self.largest:
            self.largest, self.step = float(gap.max()), step + 1
        self.size = max(self.size, float(np.nanmax(np.abs(a), initial=0.0)), float(np.nanmax(np.abs(b), initial=0.0)))
        self.square += float(measure.by_cell(measure.at_points(gap) ** 2).sum())
        self.measure += float(measure.by_cell(1.0).sum())

    def row(self, noise: float) -> tuple[float, float, float, int]:
        """Largest, root mean square, relative, step; of a field that is all below ``noise`` none is relative."""
        rms = math.sqrt(self.square / self.measure) if self.measure else 0.0
        relative = 0.0 if self.size < noise else _relative(self.largest, self.size)
        return self.largest, rms, relative, self.step


def _add(found: dict[str, _Difference], a: Patch, b: Patch, step: int) -> None:
    """The fields of one pair of steps, at the nodes of ``a``."""
    measure = Measure(a)
    same = a.block.points.shape == b.block.points.shape and np.allclose(
        a.block.points, b.block.points, rtol=0.0, atol=1e-9 * float(np.abs(a.block.points).max())
    )
    still = Patch(b.block, b.step, b.space, b.cells, b.fills, deformed=False)
    at = None if same else still.find(a.block.points)
    for name, difference in found.items():
        values = np.asarray(a.block.field(name, a.step), float)
        others = np.asarray(b.block.field(name, b.step), float) if at is None else b.values(name, at)
        if values.shape == others.shape:
            difference.add(values, others, a, measure, step)
