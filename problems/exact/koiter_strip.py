"""A plane extensible strip of Koiter's energy: what a finite element shell of that energy must converge to.

Per width, with the stretch l and the angle t of the tangent of a strip that is straight at rest,

    W = A/2 ((l^2 - 1)/2)^2 + D/2 (l^k t')^2,    A = E T / (1 - nu^2),  D = E T^3 / (12 (1 - nu^2)),

nu = 0 if the long edges are free to contract (plane stress). l t' is the change of the second fundamental form
b, Koiter's measure (W. T. Koiter, Proc. Kon. Ned. Akad. Wet. B 69 (1966) 1-54): k = 1. k = 0 takes the angle of
the normals alone, or b times the thickness stretch 1/l of an incompressible strip in plane strain. Dead forces
(H, V) and a moment M at the free end s = L; with m = dW/dt' the first variation gives

    A l (l^2 - 1)/2 + k m^2 / (D l^(2k+1)) = H cos t + V sin t,    m' = l (H sin t - V cos t),    m(L) = M.

`elastica` is the limit of T/L to 0; both differ by O((T/L)^2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, newton

Array = npt.NDArray[np.float64]


class StripState(NamedTuple):
    """Position (x, y), angle and stretch of the free end, and the moment at the clamp."""

    x: float
    y: float
    angle: float
    stretch: float
    clamp_moment: float


@dataclass(frozen=True)
class KoiterStrip:
    """Clamped at s = 0 along x. Any consistent units, stiffnesses and loads per width."""

    length: float
    membrane: float
    bending: float
    stretch_power: int = 1

    def bent(self, horizontal: float = 0.0, vertical: float = 0.0, moment: float = 0.0) -> StripState:
        """The state reached from rest under proportional loading; RuntimeError if the path turns back."""
        steps = 1 + math.ceil(2.0 * (self._size(math.hypot(horizontal, vertical), 2) + self._size(moment, 1)) ** 0.5)
        clamp, history = 0.0, [0.0]
        for step in range(1, steps + 1):
            part = step / steps
            loads = part * horizontal, part * vertical, part * moment

            def mismatch(first: float, loads: tuple[float, float, float] = loads) -> float:
                return float(self._shoot(first, *loads)[1]) - loads[2]

            guess = 2.0 * clamp - history[-2] if len(history) > 1 else loads[2] + loads[1] * self.length
            clamp = float(newton(mismatch, guess, x1=guess * (1.0 + 1e-4) + 1e-9 * self.bending, tol=1e-14))
            history.append(clamp)
        angle, last, x, y = self._shoot(clamp, horizontal, vertical, moment)
        return StripState(x, y, angle, self.stretch(angle, last, horizontal, vertical), clamp)

    def stretch(self, angle: float, moment: float, horizontal: float, vertical: float) -> float:
        """Root l near 1 of the first equation."""
        pull = horizontal * math.cos(angle) + vertical * math.sin(angle)
        k = self.stretch_power

        def excess(l: float) -> float:  # noqa: E741
            return 0.5 * self.membrane * l * (l**2 - 1.0) + k * moment**2 / (self.bending * l ** (2 * k + 1)) - pull

        return float(brentq(excess, 0.7, 3.0, xtol=1e-15, rtol=1e-14))

    def _size(self, load: float, power: int) -> float:
        return abs(load) * self.length**power / self.bending

    def _shoot(self, clamp: float, horizontal: float, vertical: float, moment: float) -> tuple[float, ...]:
        """(angle, moment, x, y) at the free end for a moment at the clamp."""

        def rates(_: float, state: Array) -> list[float]:
            angle, m = float(state[0]), float(state[1])
            l = self.stretch(angle, m, horizontal, vertical)  # noqa: E741
            sine, cosine = math.sin(angle), math.cos(angle)
            turn = m / (self.bending * l ** (2 * self.stretch_power))
            return [turn, l * (horizontal * sine - vertical * cosine), l * cosine, l * sine]

        path = solve_ivp(rates, (0.0, self.length), [0.0, clamp, 0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-13)
        return tuple(float(v) for v in path.y[:, -1])


def koiter_strip(
    length: float, thickness: float, young: float, poisson_ratio: float = 0.0, stretch_power: int = 1
) -> KoiterStrip:
    """The strip of Hooke's law in plane strain; `poisson_ratio` 0 if its long edges are free to contract."""
    membrane = young * thickness / (1.0 - poisson_ratio**2)
    return KoiterStrip(length, membrane, membrane * thickness**2 / 12.0, stretch_power)
