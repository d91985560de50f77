"""Integrals along a path that is known at its steps: the trapezoidal rule, and a cubic curve through the steps."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
FEWEST = 3  # points that say anything of a curve
GAUSS = np.polynomial.legendre.leggauss(3)  # exact for f dq of two cubic curves


def trapezoidal(force: Floats, place: Floats) -> Floats:
    """Increments of the integral of f dq from each step to the next, (n - 1,); the error of the sum falls with the
    square of the steps."""
    return np.asarray((force[1:] + force[:-1]) / 2 * np.diff(place))


def explicit(force: Floats, place: Floats) -> Floats:
    """The same with the force at the beginning of each step: an error of first order, for comparison."""
    return np.asarray(force[:-1] * np.diff(place))


def cubic(force: Floats, place: Floats) -> Floats:
    """The same on curves f(s), q(s) of third order through the steps; the error falls with the fourth power.

    The parameter s is the length of the chords in the plane of f and q, each over its range, so that a path that turns
    back in either is a smooth curve. Three points have a parabola; where there are fewer this is the trapezoidal rule.
    """
    from scipy.interpolate import CubicSpline

    s, moved = _chords(force, place)
    if moved.sum() < FEWEST:
        return trapezoidal(force, place)
    f, q = CubicSpline(s[moved], force[moved]), CubicSpline(s[moved], place[moved])
    half = np.diff(s) / 2
    at = s[:-1, None] + half[:, None] * (1 + GAUSS[0])
    return np.asarray((f(at) * q(at, 1) * GAUSS[1]).sum(axis=1) * half)


def apart(force: Floats, place: Floats) -> Floats:
    """How far the trapezoidal rule is from the cubic curves on every step; nan where there are too few points to tell,
    unless force or place stay the same."""
    if np.ptp(force) and np.ptp(place) and _chords(force, place)[1].sum() < FEWEST:
        return np.full(len(force) - 1, np.nan)
    return np.abs(cubic(force, place) - trapezoidal(force, place))


def _chords(force: Floats, place: Floats) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """The parameter of every point, and which points are apart from the one before."""
    curve = np.column_stack([_scaled(force), _scaled(place)])
    s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    return s, np.concatenate([[True], np.diff(s) > 1e-12 * s[-1]]) if s[-1] else np.zeros(len(s), bool)


def _scaled(values: Floats) -> Floats:
    span = float(np.ptp(values))
    return np.asarray(values / span) if span else np.zeros(len(values))
