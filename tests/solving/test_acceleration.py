"""Accelerated fixed points on maps whose fixed point and derivative are known."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from embedding.solving.acceleration import Accelerator, Aitken, QuasiNewton, Relaxation, contraction, independent

Map = Callable[[Any], Any]
KINDS: dict[str, Callable[[], Accelerator]] = {
    "plain": Relaxation,
    "Aitken": Aitken,
    "IQN-ILS": QuasiNewton,
}
seeds = st.integers(0, 10_000)


def iterate(accelerator: Accelerator, function: Map, start: Any, turns: int = 200, tolerance: float = 1e-12) -> Any:
    """The fixed point, how many evaluations it took (``turns`` + 1 if it was not met), and all pairs."""
    accelerator.begin()
    x = np.asarray(start, float)
    inputs, answers = [], []
    for turn in range(1, turns + 1):
        answer = function(x)
        inputs.append(x.copy())
        answers.append(answer.copy())
        if np.linalg.norm(answer - x) < tolerance * max(1.0, float(np.linalg.norm(x))):
            return answer, turn, (inputs, answers)
        if not np.all(np.isfinite(answer)) or np.linalg.norm(answer) > 1e12:
            break
        x = accelerator.propose(x, answer)
    return x, turns + 1, (inputs, answers)


def symmetric(eigenvalues: Any, seed: int) -> Any:
    """A symmetric matrix with these eigenvalues in directions of chance."""
    rng = np.random.default_rng(seed)
    q, _ = np.linalg.qr(rng.normal(size=(len(eigenvalues), len(eigenvalues))))
    return q @ np.diag(eigenvalues) @ q.T


@pytest.mark.parametrize("kind", KINDS)
def test_cosine(kind: str) -> None:
    """x = cos x has the one solution 0.739085133215 (Dottie's number)."""
    found, turns, _ = iterate(KINDS[kind](), np.cos, [1.0])
    assert found[0] == pytest.approx(0.7390851332151607, abs=1e-11)
    assert turns < {"plain": 80, "Aitken": 10, "IQN-ILS": 10}[kind]


@given(seeds, st.integers(1, 6))
def test_quasi_newton_ends_on_a_linear_map(seed: int, size: int) -> None:
    """n differences of a linear map in n dimensions are all there is to know; expanding maps are no harder."""
    rng = np.random.default_rng(seed)
    matrix = symmetric(rng.uniform(-3.0, 0.5, size), seed)
    exact = rng.normal(size=size)
    found, turns, _ = iterate(QuasiNewton(), lambda x: exact + matrix @ (x - exact), np.zeros(size), tolerance=1e-9)
    assert found == pytest.approx(exact, abs=1e-6)
    # Dependent columns are dropped: that may cost a few turns.
    assert turns <= 2 * size + 3


@given(st.floats(-20.0, 0.99).filter(lambda a: abs(a) > 1e-3), st.floats(-5.0, 5.0))
def test_aitken_is_a_secant_in_one_dimension(factor: float, exact: float) -> None:
    found, turns, _ = iterate(Aitken(), lambda x: exact + factor * (x - exact), [exact + 1.0])
    assert found[0] == pytest.approx(exact, abs=1e-8)
    assert turns <= 5


@settings(max_examples=30, deadline=None)
@given(seeds)
def test_all_reach_the_same_point_of_a_nonlinear_map(seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix, shift = symmetric(rng.uniform(-0.7, 0.7, 8), seed), rng.normal(size=8)

    def function(x: Any) -> Any:
        return matrix @ np.tanh(x) + shift

    found = {kind: iterate(make(), function, np.zeros(8)) for kind, make in KINDS.items()}
    for kind, (point, turns, _) in found.items():
        assert point == pytest.approx(found["plain"][0], abs=1e-9), kind
        assert turns <= 200
    assert found["IQN-ILS"][1] <= found["plain"][1]


@settings(max_examples=30, deadline=None)
@given(seeds)
def test_quasi_newton_where_the_plain_iteration_runs_away(seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix, exact = symmetric(np.append(rng.uniform(-0.5, 0.5, 9), -4.0), seed), rng.normal(size=10)

    def function(x: Any) -> Any:
        y = x - exact
        return exact + matrix @ y + 0.01 * y**2

    start = exact + 0.1 * rng.normal(size=10)
    assert iterate(Relaxation(), function, start)[1] == 201
    found, turns, _ = iterate(QuasiNewton(), function, start)
    assert turns <= 40
    assert found == pytest.approx(exact, abs=1e-9)


def test_relaxation_holds_what_swings_away() -> None:
    """The factor of x + omega r is 1 + omega (a - 1): for a = -3 plain is -3, omega = 0.4 gives -0.6."""
    assert iterate(Relaxation(), lambda x: 1.0 - 3.0 * x, [0.0])[1] == 201
    found, turns, _ = iterate(Relaxation(0.4), lambda x: 1.0 - 3.0 * x, [0.0])
    assert found[0] == pytest.approx(0.25)
    assert turns == pytest.approx(math.log(1e-12) / math.log(0.6), abs=5)


@pytest.mark.parametrize("kind", KINDS)
def test_a_load_step_forgets_the_last_one(kind: str) -> None:
    matrix, used, fresh = symmetric([-0.5, 0.3, 0.5], 3), KINDS[kind](), KINDS[kind]()
    iterate(used, lambda x: -0.5 * x + 1.0, np.zeros(3))
    again, first = (iterate(one, lambda x: matrix @ x + 1.5, np.zeros(3)) for one in (used, fresh))
    assert again[1] == first[1]
    assert np.array_equal(again[0], first[0])


@given(seeds, st.sampled_from(sorted(KINDS)))
def test_contraction_is_the_largest_eigenvalue(seed: int, kind: str) -> None:
    matrix = symmetric([0.8, -0.5, 0.2], seed)
    start = np.random.default_rng(seed).normal(size=3)
    _, _, pairs = iterate(KINDS[kind](), lambda x: matrix @ x, start, tolerance=1e-9)
    # Within the span of what was seen: all of it, unless the start lies near an eigenvector.
    assert abs(contraction(*pairs)) <= 0.8 + 1e-9
    if kind != "Aitken":
        assert contraction(*pairs) == pytest.approx(0.8, abs=0.05)


def test_contraction_needs_two_pairs() -> None:
    one = [np.ones(3)]
    assert math.isnan(contraction([], [])) and math.isnan(contraction(one, one))
    assert contraction([np.zeros(2), np.array([1.0, 0.0])], [np.ones(2), np.array([3.0, 5.0])]) == pytest.approx(2.0)


def test_dependent_columns_are_dropped() -> None:
    first, second = np.array([1.0, 0.0, 1.0]), np.array([0.0, 2.0, 0.0])
    columns = [first, 2.0 * first, np.zeros(3), second, first + second + 1e-6, np.array([0.0, 0.0, 1.0])]
    kept, q, r = independent(columns, limit=3)
    assert kept == [0, 3, 5]
    assert q.T @ q == pytest.approx(np.eye(3), abs=1e-14)
    assert q @ r == pytest.approx(np.column_stack([columns[i] for i in kept]), abs=1e-14)
    assert independent(columns, limit=2)[0] == [0, 3]
