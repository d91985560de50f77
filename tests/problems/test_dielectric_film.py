"""Dielectric film, free and with its width held: pull-in as a limit point, the branch beyond, charge control."""

from __future__ import annotations

import math

import numpy as np
import pytest

from embedding.scene.scales import EPSILON_0
from problems import dielectric_film, dielectric_film_held


@pytest.mark.parametrize("order", [1, 2, 3])
def test_pull_in_is_a_limit_point(order: int) -> None:
    """l = 2^(1/3) and V = (2^(-2/3) - 2^(-8/3))^(1/2) T (mu/eps)^(1/2), whatever the elements."""
    past = "path=[{until={where=['100 mm', '0 mm', '0 mm'], axis='x', value='26.2 mm'}}]"
    solution = dielectric_film.run(f"discretisation.order={order}", past)
    limit = dielectric_film.pull_in(solution)
    unit = 1e-3 * math.sqrt(100e3 / (3.0 * EPSILON_0))
    assert limit.load == pytest.approx(0.687364818 * unit, rel=1e-9)
    assert limit.stretch == pytest.approx(2.0 ** (1.0 / 3.0), abs=1e-7)
    first = solution.critical_points[0]
    assert first.kind == "limit" and first.unstable[0] == 0
    assert first.unstable[1] is not None and first.unstable[1] > 0


def test_the_branch_beyond() -> None:
    solution = dielectric_film.run()
    assert solution["stretch"][-1] == pytest.approx(1.4, abs=1e-9)
    assert dielectric_film.error(solution) < 1e-9


def test_a_held_charge_goes_beyond() -> None:
    """One uniform state for every charge: no limit point where the voltage has its maximum, nor up to l = 2."""
    solution = dielectric_film.run(*dielectric_film.by_charge(2.0))
    assert solution["stretch"][-1] == pytest.approx(2.0, abs=1e-8)
    assert dielectric_film.error(solution) < 1e-8
    assert not any(point.kind == "limit" for point in solution.critical_points)
    voltage = np.abs(solution["voltage_jump"])
    assert voltage[-1] < 0.8 * voltage.max(), "the voltage falls again"


def test_a_held_width_has_no_pull_in() -> None:
    solution = dielectric_film_held.run()
    assert dielectric_film_held.error(solution) < 1e-8
    assert not solution.critical_points
    assert (np.diff(dielectric_film_held.along(solution)) > 0.0).all()
    top = 1e-3 * math.sqrt(100e3 / (3.0 * EPSILON_0)) / 1.5
    near = dielectric_film_held.run(f"faces.bottom.voltage={0.99 * top!r}")
    assert dielectric_film_held.error(near) < 1e-7
