"""Hinged roofs: the whole path by arc length with default settings, limit points and a snap-back on it."""

from __future__ import annotations

import numpy as np
import pytest

from problems import hinged_roof

FOUND = {"12.7 m": (2222.0, 513.5), "6.35 m": (585.0, -386.5)}
"""Limit loads in N of finer meshes, see the table in docs/benchmarks.md."""


@pytest.mark.parametrize("thickness", hinged_roof.CASES)
def test_the_published_path(thickness: str) -> None:
    path = hinged_roof.run(thickness)
    limits, known = hinged_roof.limit_loads(path), hinged_roof.published_limit_loads(thickness)
    assert limits == pytest.approx(known, rel=5e-3)
    assert limits == pytest.approx(FOUND[thickness], rel=1e-3)
    assert hinged_roof.distances(path, thickness).max() < 1e-2, "the table's four-node elements are 1 % off"
    assert path.solution.iterations <= 150
    unstable = path.solution["unstable_modes"]
    assert unstable.max() == 1.0 and unstable[0] == unstable[-1] == 0.0, "unstable between the limit points alone"
    if thickness == "6.35 m":
        assert np.diff(path.values["centre"]).min() < -0.5, "the crown moves up again on the way down"
        assert path.factors.min() < -0.12


@pytest.mark.slow
def test_convergence() -> None:
    """Half of the size at most: the limit loads have converged to four digits."""
    for thickness, known in FOUND.items():
        path = hinged_roof.run(thickness, "discretisation.shell_size=100 m")
        assert hinged_roof.limit_loads(path) == pytest.approx(known, rel=5e-4)
