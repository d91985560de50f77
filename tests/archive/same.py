"""Are two archives the same to the last bit, but for the seconds they took?"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from embedding.archive import Archive


def assert_same(one: Archive, other: Archive) -> None:
    """Every number of the two: steps with their Newton history, meshes, fields, what a run goes on from, the end."""
    assert len(one) == len(other) > 0
    for a, b in zip(one.steps, other.steps, strict=True):
        assert_equal(vars(replace(a, wall_seconds=0.0)), vars(replace(b, wall_seconds=0.0)), f"step {a.number}")
    assert one.blocks == other.blocks
    for name in one.blocks:
        for step in range(len(one)):
            mine, its = one.block(name, step), other.block(name, step)
            np.testing.assert_array_equal(mine.points, its.points)
            np.testing.assert_array_equal(mine.cells, its.cells)
            assert mine.fields == its.fields
            for field in mine.fields:
                what = f"{field} of {name} at step {step + 1}"
                np.testing.assert_array_equal(mine.field(field), its.field(field), what)
    assert_equal(one.origins(), other.origins(), "origins")
    assert_equal(one.checkpoint(), other.checkpoint(), "checkpoint")
    assert one.result == other.result
    assert one.error == other.error
    assert one.cuts == other.cuts
    assert_equal(*([vars(check) for check in archive.health] for archive in (one, other)), "health")
    points = ([vars(point) for point in archive.critical_points] for archive in (one, other))
    assert_equal(*(list(found) for found in points), "critical points")


def assert_equal(one: Any, other: Any, what: str) -> None:
    """Equal tables, lists, arrays and numbers; nan equals nan."""
    assert type(one) is type(other), what
    if isinstance(one, dict):
        assert one.keys() == other.keys(), what
        for key in one:
            assert_equal(one[key], other[key], f"{what}: {key}")
    elif isinstance(one, (list, tuple)):
        assert len(one) == len(other), what
        for number, (a, b) in enumerate(zip(one, other, strict=True)):
            assert_equal(a, b, f"{what}: {number}")
    elif isinstance(one, (float, np.ndarray)):
        np.testing.assert_array_equal(one, other, what)
    else:
        assert one == other, what
