"""Hencky's constants: published values, and the boundary value problem solved another way."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from problems.exact.hencky import hencky

# Deflection C and apex strain S of Hencky's problem; 0.653 at nu = 0.3 is the literature's (Campbell 1956).
PUBLISHED = {
    0.0: (0.718319, 0.405103),
    0.2: (0.677435, 0.336546),
    0.25: (0.665791, 0.319209),
    0.3: (0.653443, 0.301771),
    0.4: (0.626255, 0.266531),
    0.5: (0.594879, 0.230664),
}


@pytest.mark.parametrize(("poisson_ratio", "constants"), PUBLISHED.items())
def test_constants(poisson_ratio: float, constants: tuple[float, float]) -> None:
    found = hencky(poisson_ratio)
    assert (found.deflection, found.strain) == pytest.approx(constants, abs=6e-7)


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3, 0.5])
def test_by_collocation(poisson_ratio: float) -> None:
    """The same equations by collocation, the singular term 3 n'/x apart."""

    def rates(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.vstack([y[1], -0.125 / y[0] ** 2, -0.5 * x / y[0]])

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array([a[1], b[1] + (1.0 - poisson_ratio) * b[0], b[2]])

    x = np.linspace(0.0, 1.0, 200)
    start = np.vstack([0.45 - 0.1 * x**2, -0.2 * x, 0.65 * (1.0 - x**2)])
    solution = solve_bvp(rates, ends, x, start, S=np.diag([0.0, -3.0, 0.0]), tol=1e-9, max_nodes=20000)
    assert solution.success
    assert hencky(poisson_ratio).force == pytest.approx(solution.y[0, 0], abs=1e-8)
    assert hencky(poisson_ratio).profile([0.25, 0.5, 0.75]) == pytest.approx(
        solution.sol([0.25, 0.5, 0.75])[2], abs=1e-8
    )


def test_bad_poisson_ratio_is_refused() -> None:
    with pytest.raises(ValueError, match="between 0 and 1/2"):
        hencky(0.6)
