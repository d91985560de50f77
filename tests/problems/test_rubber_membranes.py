"""A circular membrane through its limit pressure, Hencky's membrane and a torus, with default settings."""

from __future__ import annotations

import numpy as np
import pytest

from problems import circular_membrane, hencky_membrane, torus_inflation
from problems.exact import circular_membrane as exact


def test_circular_membrane_through_its_limit() -> None:
    """Row j of the theory: P = 1.8791734688 at the limit; 1e-6 at order 4, and every step on the exact curve."""
    path = circular_membrane.run("discretisation.order=4", "discretisation.shell_size=10 mm")
    (limit,) = circular_membrane.limit_pressures(path)
    assert limit == pytest.approx(1.8791734688, abs=1e-6)
    assert circular_membrane.pressures(path) == pytest.approx(circular_membrane.reference(path), abs=1e-6)
    assert path.values["apex"][-1] / circular_membrane.RADIUS > 1.3


def test_the_default_mesh_is_good_to_a_tenth_of_a_per_mille() -> None:
    path = circular_membrane.run()
    assert circular_membrane.pressures(path) == pytest.approx(circular_membrane.reference(path), abs=1e-4)
    (limit,) = circular_membrane.limit_pressures(path)
    assert limit == pytest.approx(exact.limit_state(circular_membrane.law_of(path.solution.scene)).pressure, abs=1e-5)


def test_torus() -> None:
    solution = torus_inflation.run()
    first = solution["pressure_difference"][0]
    assert solution["volume_ratio"][0] == pytest.approx(1.001, abs=1e-9)
    assert first == pytest.approx(torus_inflation.linear_pressure(solution.scene, 1.001), rel=1e-4)
    gap = np.abs(solution["elastic_energy"] / torus_inflation.work(solution) - 1.0)[1:]
    assert gap.max() < 2e-3, "the work's quadrature in the first steps"
    assert gap[-1] < 1e-4


@pytest.mark.parametrize(("nu", "C"), [(0.0, 0.718319), (0.2, 0.677435), (0.3, 0.653443), (0.5, 0.594879)])
def test_hencky(nu: float, C: float) -> None:
    """Hencky's constant, to the terms of the next order in (p a / (E h))^(2/3) = 1e-4."""
    path = hencky_membrane.run(f"shell.material.poisson_ratio={nu}")
    assert hencky_membrane.constant(path) == pytest.approx(C, rel=5e-5)
    assert hencky_membrane.reference(path) == pytest.approx(C, abs=1e-6)
