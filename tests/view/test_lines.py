"""Field lines follow the field, keep their distance and end only where the field does."""

from __future__ import annotations

import numpy as np

from embedding.view.lines import Raster, field_lines


def plane(size: int) -> tuple[np.ndarray, np.ndarray]:
    rows, columns = np.mgrid[0:size, 0:size].astype(float)
    return columns - size / 2, rows - size / 2


def test_lines_of_a_uniform_field_are_straight_and_evenly_spaced() -> None:
    vectors = np.zeros((80, 100, 2))
    vectors[..., 1] = 3.0
    lines = field_lines(Raster(vectors), 10.0)
    places = sorted(float(line[0, 0]) for line in lines)
    for line in lines:
        np.testing.assert_allclose(line[:, 0], line[0, 0])
        assert np.ptp(line[:, 1]) > 78
    assert 9 <= len(lines) <= 11
    assert np.diff(places).min() >= 9.9


def test_lines_of_a_charge_reach_from_its_hole_to_the_border() -> None:
    x, y = plane(160)
    distance = np.hypot(x, y)
    there = (distance > 20) & (distance < 70)
    vectors = np.where(there[..., None], np.stack([x, y], axis=2) / np.maximum(distance, 1)[..., None] ** 2, 0.0)
    lines = field_lines(Raster(vectors), 12.0)
    assert 8 <= len(lines) <= 2 * np.pi * 20 / 12 + 1
    for line in lines:
        radii = np.linalg.norm(line - 80, axis=1)
        assert radii.min() < 22.5
        assert radii.max() > 67.5
        angles = np.unwrap(np.arctan2(line[:, 1] - 80, line[:, 0] - 80))
        assert np.ptp(angles) < 0.05
    ends = np.concatenate([line[[0, -1]] for line in lines])
    assert np.linalg.norm(ends[:, None] - ends[None], axis=2)[~np.eye(len(ends), dtype=bool)].min() > 5


def test_where_none_may_start_lines_still_go() -> None:
    """As beside an axis, to which lines come near that start elsewhere."""
    x, y = plane(100)
    vectors = np.stack([x + 70, y], axis=2)  # out of a point beside the plane
    edge = np.zeros((100, 100), bool)
    edge[:, :10] = True
    lines = field_lines(Raster(vectors), 8.0, edge)
    assert len(lines) > 3
    for line in lines:
        assert line[:, 0].max() >= 10
        assert line[:, 0].min() < 1 or np.abs(line[[0, -1], 1] - 49.5).max() > 48, "it ends at the border only"


def test_no_field_no_lines() -> None:
    assert field_lines(Raster(np.zeros((20, 20, 2))), 5.0) == []


def test_a_vortex_ends() -> None:
    x, y = plane(40)
    lines = field_lines(Raster(np.stack([-y, x], axis=2)), 8.0)
    assert lines
