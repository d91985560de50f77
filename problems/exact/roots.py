"""Scalar root finding and differentiation shared by the exact solutions."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

Function = Callable[[float], float]
Analytic = Callable[[complex], complex]


def complex_slope(function: Analytic, at: float) -> float:
    """Derivative by a complex step, which subtracts nothing (Squire and Trapp, SIAM Review 40 (1998) 110).

    nan where the function is not finite.
    """
    value = function(at + 1e-30j)
    return value.imag / 1e-30 if cmath.isfinite(value) else math.nan


def bracketed_root(function: Function, low: float, high: float) -> float:
    """Root of `function` between two arguments at which it has opposite signs, to rounding.

    Raises ValueError where the signs agree.
    """
    return float(brentq(function, low, high, xtol=1e-15, rtol=1e-14))


def increasing_root(
    function: Function, start: float = 1.0, factor: float = 1.25, reach: float = 1e6
) -> float:
    """Root of an increasing function of a positive argument, bracketed by growing steps away from `start`.

    Raises ValueError if there is none within `start / reach ... start * reach`.
    """
    low = high = start
    while function(low) > 0.0:
        low /= factor
        if low * reach < start:
            raise ValueError(f"no root above {low:.3g}")
    while function(high) < 0.0:
        high *= factor
        if high > reach * start:
            raise ValueError(f"no root below {high:.3g}")
    return low if low == high else bracketed_root(function, low, high)


def sign_changes(function: Function, low: float, high: float, samples: int = 2000) -> tuple[float, ...]:
    """All roots that `function` shows on a geometric grid of the interval, in increasing order."""
    grid = [float(x) for x in np.geomspace(low, high, samples)]
    values = [function(x) for x in grid]
    pairs = zip(grid, grid[1:], values, values[1:], strict=False)
    return tuple(bracketed_root(function, a, b) for a, b, fa, fb in pairs if fa * fb < 0.0)
