"""How far the meshed space around a shell follows it: fourfold inflation, half a turn."""

from __future__ import annotations

import numpy as np
import pytest

from problems import inflated_in_a_field, turned_in_a_field
from problems.turned_in_a_field import TIP

GUARD = 0.02


def test_inflation_to_four_radii() -> None:
    solution = inflated_in_a_field.run("path=[{steps=1, field=0.0, control='volume', volume_ratio=1.5}, {steps=4, "
                                       "control='volume', volume_ratio=64}]")  # fmt: skip
    assert solution["stretch"][-1] == pytest.approx(4.0, abs=1e-6)
    assert np.all(solution["min_jacobian"] > 0.2)
    known = inflated_in_a_field.pressure(solution.scene, 4.0)
    assert solution["pressure_difference"][-1] == pytest.approx(known, rel=1e-4)
    assert solution["stretch_max"][-1] > 4.0002, "there is a field, if a weak one"


def test_a_strip_turned_by_half_a_turn() -> None:
    """The tip of the half circle: as of a thin strip, up to 2 (pi T / L)^2."""
    solution, tip = turned_in_a_field.run()
    assert np.all(solution["min_jacobian"] > 0.2)
    assert tip == pytest.approx(TIP, abs=2.0 * (0.01 * np.pi) ** 2)
