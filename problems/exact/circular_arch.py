"""Deep circular arch under a dead crown load: the inextensible elastica, through its limit load.

D. A. DaDeppo and R. Schmidt, J. Appl. Mech. 42 (1975) 896-898. Radius R, half opening angle, bending stiffness
EI, no stress at rest; the force P pushes the material point of the crown down. Clamped-hinged, half angle
107.5 degrees: P R^2 / EI = 8.97 at the limit point, as published. With R = EI = 1 and the angle t of the tangent,

    t' = -1 + m,    m' = H sin t - V cos t,

the force (H, V) in the arch constant on either side of the crown, V greater by P behind it. The other kind of
failure, sideways bifurcation of arches with equal ends, is not sought.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve, minimize_scalar

Array = npt.NDArray[np.float64]
Ends = Literal["clamped-hinged", "clamped-clamped", "hinged-hinged"]


class ArchState(NamedTuple):
    """P R^2 / EI; displacement of the crown per radius, down and sideways (+x)."""

    load: float
    down: float
    sideways: float


@dataclass(frozen=True)
class CircularArch:
    """`half_angle` a in radians. "clamped-hinged": hinged at s = 0 (x < 0), clamped at s = 2 a."""

    half_angle: float
    ends: Ends = "clamped-hinged"

    def path(self, down: npt.ArrayLike) -> list[ArchState]:
        """States at increasing displacements of the crown, reached one from another from rest."""
        guess, states = np.zeros(4), []
        for value in np.atleast_1d(np.asarray(down, dtype=np.float64)):
            guess, state = self._solve(float(value), guess)
            states.append(state)
        return states

    def limit(self, step: float = 0.1, largest: float = 2.0) -> ArchState:
        """The first maximum of the load; RuntimeError if there is none up to the displacement `largest`."""
        guesses, states = [np.zeros(4)], [ArchState(0.0, 0.0, 0.0)]
        while states[-1].down < largest:
            guess, state = self._solve(states[-1].down + step, 2.0 * guesses[-1] - guesses[max(0, len(guesses) - 2)])
            if state.load < states[-1].load:
                return self._peak(states[-2].down, state.down, guesses[-1])
            guesses.append(guess)
            states.append(state)
        raise RuntimeError(f"no limit load up to the displacement {largest:.6g}")

    def _peak(self, low: float, high: float, guess: Array) -> ArchState:
        best = minimize_scalar(
            lambda down: -self._solve(down, guess)[1].load,
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-7},
        )
        return self._solve(float(best.x), guess)[1]

    def _solve(self, down: float, guess: Array) -> tuple[Array, ArchState]:
        """Unknowns: rotation (hinge) or moment (clamp) at the first end, H, V, P."""

        def mismatch(unknowns: Array) -> list[float]:
            crown, last = self._shoot(unknowns)
            end = last[1] if self.ends.startswith("hinged") else last[0] + self.half_angle
            return [
                end,
                last[2] - math.sin(self.half_angle),
                last[3] - math.cos(self.half_angle),
                crown[3] - 1.0 + down,
            ]

        found, _, flag, message = fsolve(mismatch, guess, xtol=1e-12, full_output=True)
        if flag != 1 and max(abs(v) for v in mismatch(found)) > 1e-9:
            raise RuntimeError(f"no equilibrium found at the displacement {down:.6g}: {message}")
        crown, _ = self._shoot(found)
        return found, ArchState(float(found[3]), down, float(crown[2]))

    def _shoot(self, unknowns: Array) -> tuple[Array, Array]:
        """(t, m, x, y) at the crown and at the second end; the centre of the circle is the origin."""
        first, pull, shear, load = (float(v) for v in unknowns)
        hinged = self.ends.endswith("hinged")
        a = self.half_angle
        start = [a + first, 0.0] if hinged else [a, first]
        crown = _segment([*start, -math.sin(a), math.cos(a)], a, pull, shear)
        return crown, _segment(list(crown), a, pull, shear + load)


def _segment(start: list[float], length: float, pull: float, shear: float) -> Array:
    def rates(_: float, state: Array) -> list[float]:
        sine, cosine = math.sin(state[0]), math.cos(state[0])
        return [float(state[1]) - 1.0, pull * sine - shear * cosine, cosine, sine]

    end: Array = solve_ivp(rates, (0.0, length), start, method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]
    return end
