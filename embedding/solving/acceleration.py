"""Fixed points x = H(x) reached in few evaluations of H, when all that is known of H are its answers.

With the residual r = H(x) - x every method proposes the next x from the pairs (x, H(x)) it has seen:

* :class:`Relaxation`: x + omega r with a constant omega; omega = 1 is the plain iteration.
* :class:`Aitken`: omega from the last two residuals, the secant method along them (Irons and Tuck, Int. J. Numer.
  Meth. Engng 1 (1969) 275; Kuettler and Wall, Comput. Mech. 43 (2008) 61).
* :class:`QuasiNewton`: H(x) + W c, where c combines the seen differences V of residuals to -r in least squares and W
  are the differences of H that belong to them: IQN-ILS (Degroote, Bathe and Vierendeels, Comput. Struct. 87 (2009)
  793). Columns that are nearly a combination of newer ones are dropped while V is factored (Haelterman et al., Comput.
  Struct. 171 (2016) 9).

Nothing here knows of shells or fields.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

DEPENDENT = 1e-2
"""A column is dropped if less than this part of it is new."""
NOISE = 1e-4
"""Differences below this part of the largest one say nothing about H beyond its rounding."""


class Accelerator(Protocol):
    """Proposes inputs of H; one object serves a whole path of load steps."""

    def begin(self) -> None:
        """Another load step starts, with another H: what was seen of the last one is forgotten."""

    def propose(self, given: Array, answer: Array) -> Array:
        """The next input, after H(``given``) was found to be ``answer``; all of shape (n,)."""


class Relaxation:
    """x + omega r with a constant ``omega``."""

    def __init__(self, omega: float = 1.0) -> None:
        self.omega = omega

    def begin(self) -> None:
        """Nothing is remembered."""

    def propose(self, given: Array, answer: Array) -> Array:
        """See :class:`Accelerator`."""
        return given + self.omega * (answer - given)


class Aitken:
    """x + omega r, omega adapted by the last two residuals; a load step starts with the ``first`` one."""

    def __init__(self, first: float = 1.0) -> None:
        self._first, self.omega = first, first
        self._last: Array | None = None

    def begin(self) -> None:
        """See :class:`Accelerator`."""
        self.omega, self._last = self._first, None

    def propose(self, given: Array, answer: Array) -> Array:
        """See :class:`Accelerator`."""
        residual = answer - given
        if self._last is not None:
            change = residual - self._last
            squared = float(change @ change)
            if squared > 0.0:
                self.omega *= -float(self._last @ change) / squared
        self._last = residual
        return given + self.omega * residual


class QuasiNewton:
    """IQN-ILS: a Newton step with what the seen differences say about the inverse Jacobian of the residual.

    Differences of earlier load steps are not reused: with shells of rubber the stiffnesses change too much from step to
    step, and turns were lost more often than won.
    """

    def __init__(self) -> None:
        self._inputs: list[Array] = []
        self._answers: list[Array] = []

    def begin(self) -> None:
        """See :class:`Accelerator`."""
        self._inputs, self._answers = [], []

    def propose(self, given: Array, answer: Array) -> Array:
        """See :class:`Accelerator`."""
        self._inputs.append(given.copy())
        self._answers.append(answer.copy())
        moves, changes = differences(self._inputs, self._answers)
        residual = answer - given
        columns = [change - move for move, change in zip(moves, changes, strict=True)]
        kept, q, r = independent(columns, limit=len(residual))
        if not kept:
            return answer.copy()
        weights = np.linalg.solve(r, q.T @ -residual)
        return answer + np.column_stack([changes[i] for i in kept]) @ weights


def differences(inputs: Sequence[Array], answers: Sequence[Array]) -> tuple[list[Array], list[Array]]:
    """Differences of successive inputs, newest first, and those of their answers."""
    pairs = range(len(inputs) - 1, 0, -1)
    return [inputs[i] - inputs[i - 1] for i in pairs], [answers[i] - answers[i - 1] for i in pairs]


def independent(columns: Sequence[Array], limit: int) -> tuple[list[int], Array, Array]:
    """Numbers of the columns that are new beside those before them, at most ``limit``, and their factors Q, R.

    Q is (n, kept), R is (kept, kept); Gram and Schmidt's method, twice for accuracy.
    """
    kept: list[int] = []
    basis: list[Array] = []
    factors: list[Array] = []
    for number, column in enumerate(columns):
        size = float(np.linalg.norm(column))
        if size == 0.0 or len(kept) == limit:
            continue
        rest, shares = column, np.zeros(len(basis))
        for _ in range(2 if basis else 0):
            share = np.array([vector @ rest for vector in basis])
            rest = rest - np.column_stack(basis) @ share
            shares = shares + share
        new = float(np.linalg.norm(rest))
        if new <= DEPENDENT * size:
            continue
        kept.append(number)
        basis.append(rest / new)
        factors.append(np.append(shares, new))
    r = np.zeros((len(kept), len(kept)))
    for i, factor in enumerate(factors):
        r[: len(factor), i] = factor
    return kept, np.column_stack(basis) if basis else np.empty((0, 0)), r


def contraction(inputs: Sequence[Array], answers: Sequence[Array]) -> float:
    """By what factor H multiplies the worst error that was seen: the largest eigenvalue of its derivative, as far as
    the differences of the pairs show it; nan before there are two pairs.

    A Ritz value on the span of the differences; of a complex pair the size, with the sign of the real part. Above 1 the
    plain iteration runs away from the fixed point, below -1 it swings away from it.
    """
    moves, changes = differences(inputs, answers)
    largest = max((float(np.linalg.norm(move)) for move in moves), default=0.0)
    loud = [i for i, move in enumerate(moves) if float(np.linalg.norm(move)) > NOISE * largest]
    kept, q, r = independent([moves[i] for i in loud], limit=len(inputs))
    if not kept:
        return float("nan")
    answered = np.column_stack([changes[loud[i]] for i in kept])
    values = np.linalg.eigvals(np.linalg.solve(r.T, (q.T @ answered).T).T)
    worst = values[np.argmax(np.abs(values))]
    return math.copysign(abs(worst), worst.real)


ACCELERATORS: dict[str, Callable[[], Accelerator]] = {"none": Relaxation, "aitken": Aitken, "iqn-ils": QuasiNewton}
"""By the names that a scene knows them by (solver.acceleration)."""
