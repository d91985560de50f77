"""A circular membrane through its limit pressure, Hencky's membrane and a torus, with default settings."""

from __future__ import annotations

import numpy as np
import pytest

from problems import circular_membrane, hencky_membrane, torus_inflation
from problems.exact import circular_membrane as exact
from tests.problems.measures import orders

LIMIT = 1.8791734688
SIZES = (20.0, 10.0, 5.0)


def test_circular_membrane_through_its_limit() -> None:
    """Row j of the theory: P = 1.8791734688 at the limit; 1e-6 at order 4, and every step on the exact curve."""
    path = circular_membrane.run("discretisation.order=4", "discretisation.shell_size=10 mm")
    (limit,) = circular_membrane.limit_pressures(path)
    assert limit == pytest.approx(LIMIT, abs=1e-6)
    assert circular_membrane.pressures(path) == pytest.approx(circular_membrane.reference(path), abs=1e-6)
    assert path.values["apex"][-1] / circular_membrane.RADIUS > 1.3


@pytest.mark.slow
def test_the_default_mesh_is_good_to_a_tenth_of_a_per_mille() -> None:
    path = circular_membrane.run()
    assert circular_membrane.pressures(path) == pytest.approx(circular_membrane.reference(path), abs=1e-4)
    (limit,) = circular_membrane.limit_pressures(path)
    assert limit == pytest.approx(exact.limit_state(circular_membrane.law_of(path.solution.scene)).pressure, abs=1e-5)


@pytest.mark.parametrize("order", [2, 3])
def test_the_limit_pressure_converges_at_twice_the_order(order: int) -> None:
    errors = []
    for size in SIZES:
        path = circular_membrane.run(f"discretisation.order={order}", f"discretisation.shell_size={size} mm")
        errors.append(abs(circular_membrane.limit_pressures(path)[0] - LIMIT))
    assert min(orders(SIZES, errors)) > 2 * order - 0.3


@pytest.mark.slow
def test_mooney_rivlin_has_no_limit_on_the_way() -> None:
    """c2 = c1 / 4: the pressure rises all along the path, on the exact curve."""
    material = "shell.material={law = 'mooney-rivlin', c1 = '40 kPa', c2 = '10 kPa'}"
    path = circular_membrane.run(material, "discretisation.order=4", "discretisation.shell_size=10 mm")
    assert circular_membrane.limit_pressures(path) == []
    assert circular_membrane.pressures(path) == pytest.approx(circular_membrane.reference(path), abs=1e-6)


def test_torus() -> None:
    solution = torus_inflation.run()
    number = int(np.argmin(np.abs(solution["volume_ratio"] - 1.001)))
    first = torus_inflation.linear_pressure(solution.scene, float(solution["volume_ratio"][number]))
    assert solution["pressure_difference"][number] == pytest.approx(first, rel=1e-4)


def test_energy_of_the_torus_is_the_work_of_the_pressure() -> None:
    """At four times the volume. What is left is the discretisation's, as the finer mesh shows."""
    coarse, fine = torus_inflation.run(), torus_inflation.run("discretisation.shell_size=5 mm")
    gaps = [abs(float(s["elastic_energy"][-1] / torus_inflation.work(s)[-1]) - 1.0) for s in (coarse, fine)]
    assert gaps[0] < 5e-5
    assert gaps[1] < 2.5e-6


@pytest.mark.parametrize(("nu", "C"), [(0.0, 0.718319), (0.2, 0.677435), (0.3, 0.653443), (0.5, 0.594879)])
def test_hencky(nu: float, C: float) -> None:
    """Hencky's constant, to the terms of the next order in (p a / (E h))^(2/3) = 1e-4."""
    path = hencky_membrane.run(f"shell.material.poisson_ratio={nu}")
    assert hencky_membrane.constant(path) == pytest.approx(C, rel=5e-5)
    assert hencky_membrane.reference(path) == pytest.approx(C, abs=1e-6)
