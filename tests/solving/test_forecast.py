"""The guess of a ramp's next state: exact on a parabola, fewer iterations, and no harm where it is wrong."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

from embedding import Result, Scene, Solution, solve
from embedding.solving.forecast import Forecast
from tests.balloons import SMALL

pytestmark = pytest.mark.usefixtures("unestimated")

TEN_STEPS = Scene.from_toml(SMALL).with_overrides(["path.0.steps=10"])
Array = npt.NDArray[np.float64]


def count(solution: Solution) -> int:
    return sum(len(step.iterations) for step in solution.steps)


def stretch(solution: Solution) -> float:
    return solution.steps[-1].scalars["stretch_max"]


def none(self: Forecast, fraction: float) -> Array | None:
    return None


@pytest.mark.parametrize("degree", [0, 1, 2, 3])
def test_exact_up_to_a_parabola(degree: int) -> None:
    factors = np.array([2.0, -1.0, 0.5])

    def state(fraction: float) -> Array:
        return factors * fraction**degree

    forecast = Forecast()
    for fraction in (0.1, 0.3, 0.35, 0.4):
        forecast.learn(fraction, state(fraction))
    expected = forecast.at(0.6)
    assert expected is not None
    assert (np.abs(expected - state(0.6)).max() < 1e-14) == (degree < 3)


def test_none_of_few_states_or_of_another_mesh() -> None:
    forecast = Forecast([(0.0, np.zeros(2)), (0.1, np.ones(2))])
    assert forecast.at(0.2) is None
    forecast.learn(0.2, np.ones(2))
    assert forecast.at(0.3) is not None
    forecast.forget()
    assert forecast.at(0.3) is None


def test_fewer_iterations_to_the_same_state(monkeypatch: pytest.MonkeyPatch) -> None:
    with_it = solve(TEN_STEPS)
    monkeypatch.setattr(Forecast, "at", none)
    without = solve(TEN_STEPS)
    assert count(with_it) < 0.85 * count(without)
    assert stretch(with_it) == pytest.approx(stretch(without), rel=1e-9)


def test_a_wild_guess_costs_iterations_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Forecast, "at", none)
    without = solve(TEN_STEPS)

    def wild(self: Forecast, fraction: float) -> Array | None:
        return None if not self.former else 1e3 * np.ones_like(self.former[0][1])

    monkeypatch.setattr(Forecast, "at", wild)
    found = solve(TEN_STEPS)
    assert found.result is Result.CONVERGED and len(found.steps) == len(without.steps)
    assert found.iterations > count(without)
    assert stretch(found) == pytest.approx(stretch(without), rel=1e-9)
