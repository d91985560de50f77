"""Conjugate gradients for definite matrices and GMRES for any, with a preconditioner; iterations are counted."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from ngsolve import InnerProduct

from embedding.ambient.patches import Cycle
from embedding.blas import scipy_ready
from embedding.threads import shared

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Ending:
    """How an iteration ended: its count, and the norm of the residual that is left over that at the start."""

    iterations: int
    remainder: float


@shared()
def conjugate_gradients(cycle: Cycle, right_side: Any, out: Any, tolerance: float, most: int) -> Ending:
    """Solve ``cycle.matrix`` out = ``right_side`` for the free unknowns, from zero.

    Norms of residuals are r . C r with the preconditioner C, in effect the energy of the error, so that stiff parts do
    not hide soft ones. When the recursion has reached ``tolerance`` the true residual decides; if rounding has parted
    the two, the iteration starts again from there. Ends early where the matrix turns out not to be definite.
    """
    matrix, free = cycle.matrix, cycle.free
    rest, better, direction, image = (right_side.CreateVector() for _ in range(4))
    out[:] = 0.0
    count, first, remainder = 0, 0.0, math.inf
    while True:
        rest.data = right_side - matrix * out
        free.Project(rest)
        cycle.apply(rest, better)
        squared = InnerProduct(rest, better)
        if count == 0:
            first = squared
            if first == 0.0:
                return Ending(0, 0.0)
        before, remainder = remainder, math.sqrt(abs(squared / first))
        # a negative square: the preconditioner is not definite; no progress: rounding is reached
        if not squared > 0.0 or remainder <= tolerance or remainder > 0.5 * before or count >= most:
            return Ending(count, remainder if squared >= 0.0 else math.nan)
        direction.data = better
        while count < most and squared > (tolerance * tolerance) * first:
            count += 1
            image.data = matrix * direction
            free.Project(image)
            curvature = InnerProduct(direction, image)
            if not curvature > 0.0:
                return Ending(count, math.nan)
            out.data += (squared / curvature) * direction
            rest.data -= (squared / curvature) * image
            cycle.apply(rest, better)
            previous, squared = squared, InnerProduct(rest, better)
            if not math.isfinite(squared):
                return Ending(count, math.nan)
            # in two steps: NGSolve assigns a sum term by term, and would scale what it has just overwritten
            direction *= squared / previous
            direction.data += better


@shared()
def gmres(
    image: Callable[[Array], Array], better: Callable[[Array], Array], right_side: Array, tolerance: float, most: int
) -> tuple[Array, Ending]:
    """Solve ``image``(x) = ``right_side`` with the preconditioner ``better`` on the right, without restarts.

    Returns x and the ending; norms of residuals are Euclidean (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986)
    856).
    """
    size = float(np.linalg.norm(right_side))
    if size == 0.0 or not math.isfinite(size):
        return np.zeros_like(right_side), Ending(0, size)
    basis = [right_side / size]
    triangle, turned = np.zeros((most + 1, most)), np.zeros(most + 1)
    turns: list[tuple[float, float]] = []
    turned[0] = size
    count = 0
    while count < most and abs(turned[count]) > tolerance * size:
        vector = image(better(basis[count]))
        column = np.zeros(count + 2)
        for _ in range(2):  # once more, lest rounding spoils the basis
            for row, known in enumerate(basis):
                part = float(known @ vector)
                column[row] += part
                vector -= part * known
        column[count + 1] = float(np.linalg.norm(vector))
        if not np.all(np.isfinite(column)):
            return np.zeros_like(right_side), Ending(count, math.nan)
        basis.append(vector / max(column[count + 1], 1e-300))
        for row, (c, s) in enumerate(turns):
            column[row], column[row + 1] = c * column[row] + s * column[row + 1], c * column[row + 1] - s * column[row]
        length = math.hypot(column[count], column[count + 1])
        if length == 0.0:
            break
        c, s = column[count] / length, column[count + 1] / length
        turns.append((c, s))
        column[count], column[count + 1] = length, 0.0
        triangle[: count + 2, count] = column
        turned[count + 1], turned[count] = -s * turned[count], c * turned[count]
        count += 1
    from scipy.linalg import solve_triangular  # slow to load, and small systems need no iteration

    scipy_ready()
    weights = solve_triangular(triangle[:count, :count], turned[:count])
    found = np.zeros_like(right_side)
    for weight, known in zip(weights, basis, strict=False):
        found += weight * known
    return better(found), Ending(count, abs(turned[count]) / size)
