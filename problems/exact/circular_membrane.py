"""Clamped circular membrane under follower pressure: exact finite deformation of an incompressible membrane.

A flat disc of radius A and thickness T, clamped on its rim, carries the pressure p on one side. With the
meridional and hoop stretches l1 and l2 = r/R, the nominal stresses s_i = (sigma_i - sigma_3) / l_i and the
slope t of the meridian, the equilibrium of a membrane of revolution (Adkins and Rivlin, Phil. Trans. R. Soc.
A 244 (1952) 505-531; Green and Adkins, Large Elastic Deformations, ch. 4) is, along the two fixed directions,

    d(R s1 cos t)/dR = s2 - (p/T) r l1 sin t,    R s1 sin t = p r^2 / (2 T),

the second being the balance of the cap above R, with dr/dR = l1 cos t and dz/dR = -l1 sin t. Lengths and
pressure scale inversely, so that one integration from the apex, where l1 = l2, to the particle with l2 = 1
gives the solution of one apex stretch: no shooting.
The membrane has no bending stiffness: a shell approaches it only as T/A tends to 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp

from problems.exact.material import Law, neo_hookean
from problems.exact.roots import bracketed_root, increasing_root

Array = npt.NDArray[np.float64]
RELATIVE, ABSOLUTE = 1e-13, 1e-15  # of the integrations
APEX = 1e-6  # where the integration starts, in radii: its error is the square
LOCKED = 1e6  # stands for an infinite stress
SECANTS, SAME = 12, 1e-14
"""Most secants for a stretch, and its last relative change."""
LARGEST_STRETCH = 10.0  # the limit pressure is sought up to this apex stretch


@dataclass(frozen=True)
class Inflated:
    """One equilibrium state, dimensionless.

    `pressure` is P = p A / (mu T), `deflection` the apex height w/A, `volume` V/A^3 between membrane and rim plane.
    """

    apex_stretch: float
    pressure: float
    deflection: float
    volume: float
    law: Law = field(repr=False)

    def profile(self, radius: npt.ArrayLike) -> tuple[Array, Array]:
        """Deformed (r, z)/A of the particles at undeformed radius R/A in [0, 1]; z is 0 on the rim."""
        points = np.atleast_1d(np.asarray(radius, dtype=np.float64))
        path = _integrate(self.apex_stretch, self.pressure, self.law, 1.0, dense=True)
        inside = np.maximum(points, APEX)
        hoop, _, height, _ = path.sol(inside)
        return hoop * points, self.deflection + height

    def stretches(self, radius: npt.ArrayLike) -> tuple[Array, Array]:
        """Meridional and hoop stretch of the particles at undeformed radius R/A."""
        points = np.maximum(np.atleast_1d(np.asarray(radius, dtype=np.float64)), APEX)
        hoop, pull, _, _ = _integrate(self.apex_stretch, self.pressure, self.law, 1.0, dense=True).sol(points)
        nominal = np.hypot(pull, 0.5 * self.pressure * hoop**2 * points)
        meridional = [_meridional(s, h, self.law) for s, h in zip(nominal, hoop, strict=True)]
        return np.array(meridional), np.asarray(hoop)


def _meridional(nominal: float, hoop: float, law: Law) -> float:
    """Meridional stretch at the nominal meridional stress, in units of the shear modulus, and the hoop stretch."""
    modulus = law.shear_modulus

    def excess(stretch: float) -> float:
        value = law.stress_difference(stretch, 1.0 / (stretch * hoop)) / (stretch * modulus) - nominal
        return LOCKED if math.isnan(value) else value  # a law that locks has no stress beyond its limit

    # By secants, in a third of the time of a bracket; where they leave the smooth part, by a bracket.
    last, stretch = hoop, 1.001 * hoop
    before = excess(last)
    for _ in range(SECANTS):
        value = excess(stretch)
        if value == before:
            break
        last, stretch, before = stretch, stretch - value * (stretch - last) / (value - before), value
        if not 0.1 * hoop < stretch < 10.0 * hoop:
            break
        if abs(stretch - last) <= SAME * stretch:
            return stretch
    return increasing_root(excess, start=hoop, factor=1.1)


def _rates(radius: float, hoop: float, pull: float, load: float, law: Law) -> tuple[float, float, float, float]:
    """Derivatives of (l2, s1 cos t / mu, z, V) along the undeformed radius."""
    lift = 0.5 * load * hoop**2 * radius
    nominal = math.hypot(pull, lift)
    stretch = _meridional(nominal, hoop, law)
    cosine, sine = pull / nominal, lift / nominal
    circumferential = law.stress_difference(hoop, 1.0 / (stretch * hoop)) / (hoop * law.shear_modulus)
    return (
        (stretch * cosine - hoop) / radius,
        (circumferential - load * hoop * radius * stretch * sine - pull) / radius,
        -stretch * sine,
        math.pi * (hoop * radius) ** 2 * stretch * sine,
    )


def _integrate(apex: float, load: float, law: Law, end: float, dense: bool = False, stop: bool = False) -> Any:
    """(l2, s1 cos t / mu, z, V) from the apex to the radius `end`, or to where l2 = 1."""
    start = law.stress_difference(apex, apex**-2) / (apex * law.shear_modulus)

    def clamped(_: float, state: Array) -> float:
        return float(state[0]) - 1.0

    clamped.terminal = True  # type: ignore[attr-defined]
    return solve_ivp(
        lambda r, y: _rates(r, y[0], y[1], load, law),
        (APEX, end),
        [apex, start, 0.0, 0.0],
        dense_output=dense,
        events=clamped if stop else None,
        first_step=APEX,
        method="DOP853",
        rtol=RELATIVE,
        atol=ABSOLUTE,
    )


def state(apex_stretch: float, law: Law | None = None) -> Inflated:
    """The state of a given apex stretch, on whichever branch.

    Raises ValueError for an apex that is not stretched.
    """
    law = law or neo_hookean()
    if not apex_stretch > 1.0:
        raise ValueError(f"apex_stretch is {apex_stretch:.6g}: it must exceed 1")
    # Hencky's small-strain pressure makes the radius of the scaled problem of order one.
    load = min(3.0 * ((apex_stretch - 1.0) / 0.230664) ** 1.5, 2.0)
    path = _integrate(apex_stretch, load, law, 100.0, stop=True)
    near, values = float(path.t[-2]), path.y[:, -2]  # the last point is interpolated, the one before it is a step

    def by_hoop(hoop: float, y: Array) -> list[float]:
        """The rest of the way with l2 as the variable (Henon's trick): it ends exactly at the rim."""
        rates = _rates(float(y[0]), hoop, float(y[1]), load, law)
        return [1.0 / rates[0], *(rate / rates[0] for rate in rates[1:])]

    way = solve_ivp(
        by_hoop, (float(values[0]), 1.0), [near, *values[1:]], method="DOP853", rtol=RELATIVE, atol=ABSOLUTE
    )
    radius, _, height, volume = (float(x) for x in way.y[:, -1])
    return Inflated(apex_stretch, load * radius, -height / radius, volume / radius**3, law)


def limit_state(law: Law | None = None, largest_stretch: float = LARGEST_STRETCH) -> Inflated | None:
    """The state of the first maximum of the pressure, or None if the pressure rises up to `largest_stretch`.

    Neo-Hooke: P = 1.8791734688 at the apex stretch 2.19594.
    """
    return _limit(law or neo_hookean(), largest_stretch)


@lru_cache(maxsize=32)
def _limit(law: Law, largest_stretch: float) -> Inflated | None:
    def slope(stretch: float) -> float:
        """Derivative of the pressure from five points: its error is far below the flatness of the maximum."""
        h = 4e-3 * (stretch - 1.0)
        p = [state(stretch + k * h, law).pressure for k in (-2, -1, 1, 2)]
        return (p[0] - 8.0 * p[1] + 8.0 * p[2] - p[3]) / (12.0 * h)

    low, stretch, pressure, factor = 1.0, 1.2, 0.0, 1.15
    while stretch < largest_stretch:
        found = state(stretch, law).pressure
        if found < pressure:
            return state(bracketed_root(slope, low, stretch), law)
        low, stretch, pressure = stretch / factor, stretch * factor, found
    return None


def at_pressure(pressure: float, law: Law | None = None) -> Inflated:
    """The state at P = p A / (mu T) on the rising branch.

    Raises ValueError for a pressure that is not positive or exceeds the limit pressure.
    """
    return _rising(pressure, law or neo_hookean())


@lru_cache(maxsize=32)
def _rising(pressure: float, law: Law) -> Inflated:
    limit = limit_state(law)
    if not pressure > 0.0:
        raise ValueError(f"pressure is {pressure:.6g}: it must be positive")
    if limit is not None and pressure > limit.pressure:
        raise ValueError(f"pressure {pressure:.6g} exceeds the limit {limit.pressure:.6g}")
    last = LARGEST_STRETCH if limit is None else limit.apex_stretch
    return state(bracketed_root(lambda x: state(x, law).pressure - pressure, 1.0 + 1e-8, last), law)


def at_deflection(deflection: float, law: Law | None = None) -> Inflated:
    """The state at the apex height w/A > 0, which grows with the apex stretch on both branches."""
    return state(1.0 + increasing_root(lambda x: state(1.0 + x, law).deflection - deflection, 0.1, 2.0), law)


def at_volume(volume: float, law: Law | None = None) -> Inflated:
    """The state at the enclosed volume V/A^3 > 0, which grows with the apex stretch on both branches."""
    return state(1.0 + increasing_root(lambda x: state(1.0 + x, law).volume - volume, 0.1, 2.0), law)
