"""Where the next state of a ramp will be: a start for Newton's method that is nearer than the last state.

The last states lie on a smooth curve over the part of the ramp that is done; the parabola through three of them misses
the next one by O(h^3) in steps of length h, where the first Newton step from the last state misses it by O(h^2). That
saves one iteration of four; a fourth state saves no more.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
MOST = 3
"""States that a forecast is made from, the present one among them; with fewer there is none, as a line is no nearer
than a Newton step."""


class Forecast:
    """The last accepted states of a ramp on one mesh: unknowns (n,) at fractions of the ramp, the present one last."""

    def __init__(self, known: Sequence[tuple[float, Array]] = ()) -> None:
        self._known = list(known)[-MOST:]

    @property
    def former(self) -> list[tuple[float, Array]]:
        """All states but the present one."""
        return self._known[:-1]

    def learn(self, fraction: float, unknowns: Array) -> None:
        """The state at ``fraction``, which is the present one from now on."""
        self._known = [*self._known, (fraction, unknowns)][-MOST:]

    def forget(self) -> None:
        """The states are those of another mesh."""
        self._known = []

    def at(self, fraction: float) -> Array | None:
        """The unknowns (n,) that are expected at ``fraction``; None where too few states are known."""
        if len(self._known) < MOST:
            return None
        places = np.array([place for place, _ in self._known])
        weights = [
            np.prod([(fraction - other) / (place - other) for other in places if other != place]) for place in places
        ]
        expected: Array = sum(weight * unknowns for weight, (_, unknowns) in zip(weights, self._known, strict=True))
        return expected
