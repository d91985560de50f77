"""A membrane or a spring-borne plate pulled in over a rigid electrode: thin gap, small slopes, no fringes.

u = w/g is the deflection over the gap, -1 at the electrode; the membrane of tension N per length obeys

    Laplace u = load / (1 + u)^2,    load = eps V^2 L^2 / (2 N g^3),    u = 0 on the supports

(J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS, CRC 2002). L is the width of the strip, or the radius of the
disc. `centre` is -u in the middle, in (0, 1): it grows all the way along the path while the load goes over its
maximum, the pull-in; the branch beyond is unstable at held voltage.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Literal, NamedTuple

import numpy as np
from scipy.integrate import OdeSolution, solve_ivp

from problems.exact.roots import bracketed_root

Branch = Literal["stable", "unstable"]
START, REACH = 1e-2, 400.0  # of the disc's similarity variable: its series holds to rounding before, centre = 0.986 at


class PullIn(NamedTuple):
    """The largest load, and the deflection of the centre over the gap there."""

    centre: float
    load: float


PLATE = PullIn(1.0 / 3.0, 4.0 / 27.0)


def plate_load(deflection: float) -> float:
    """A rigid plate on a spring k: x (1 - x)^2 = eps A V^2 / (2 k g^3) at x = w/g; largest at `PLATE`."""
    return deflection * (1.0 - deflection) ** 2


def plate_fringe() -> PullIn:
    """What a gap g adds to `PLATE`, in g/a, for an electrode of radius a with an upright wall, beside a wider plate.

    Its wall at right angles to the plate has the charge (2 eps V / pi) ln(1/h) per length of its edge and more that
    does not depend on h = g - x: a force of 4 h / (pi a) times that of the gap. Then k x h^2 / (1 + 4 h / (pi a)) is
    largest at x/g = 1/3 + 8 g / (27 pi a), by 8 g / (3 pi a) less.
    """
    return PullIn(8.0 / (27.0 * math.pi), -8.0 / (3.0 * math.pi) * PLATE.load)


def strip_load(centre: float) -> float:
    """Load of the strip that holds the centre c: 2 I^2, I = (1 - c)^(1/2) [c^(1/2) + (1 - c) artanh(c^(1/2))].

    The first integral u'^2 / 2 = load [1/(1 - c) - 1/(1 + u)], integrated over half the width.
    """
    return 2.0 * _half_width(centre, 1.0) ** 2


def _half_width(centre: float, height: float) -> float:
    """Distance from the middle at which 1 + u is `height`, times (2 load)^(1/2)."""
    least = 1.0 - centre
    root = math.sqrt(max(height - least, 0.0))
    return math.sqrt(least) * (math.sqrt(height) * root + least * math.asinh(root / math.sqrt(least)))


def strip_shape(centre: float, x: float) -> float:
    """u at the distance x from the middle, in widths; ValueError beyond 1/2."""
    if abs(x) > 0.5:
        raise ValueError(f"x is {x:.6g}: the strip ends at 0.5")
    wanted = 2.0 * abs(x) * _half_width(centre, 1.0)
    if wanted >= _half_width(centre, 1.0):
        return 0.0
    return bracketed_root(lambda u: _half_width(centre, 1.0 + u) - wanted, -centre, 0.0)


@cache
def strip_pull_in() -> PullIn:
    """Load 1.400016477 at c = 0.388346719 = s^2: dI/ds = 0 reads 3 s (1 - s^2) artanh(s) = 2 - 3 s^2."""
    s = bracketed_root(lambda x: 3.0 * x * (1.0 - x**2) * math.atanh(x) - 2.0 + 3.0 * x**2, 0.4, 0.8)
    return PullIn(s**2, strip_load(s**2))


@cache
def _similarity() -> OdeSolution:
    """(h, h') of h'' + h'/x = h^-2, h(0) = 1, from `START` on: every disc is u = (1 - c) h(k r) - 1.

    Series at the start: h = 1 + x^2/4 - x^4/32 + x^6/144.
    """
    x = START
    first = [1.0 + x**2 / 4 - x**4 / 32 + x**6 / 144, x / 2 - x**3 / 8 + x**5 / 24]

    def rates(x: float, y: np.ndarray) -> list[float]:
        return [y[1], y[0] ** -2 - y[1] / x]

    solution = solve_ivp(rates, (x, REACH), first, method="DOP853", rtol=1e-13, atol=1e-14, dense_output=True)
    assert solution.sol is not None
    return solution.sol


def _height(x: float) -> float:
    if x < START:
        return 1.0 + x**2 / 4 - x**4 / 32 + x**6 / 144
    return float(_similarity()(x)[0])


def _scale(centre: float) -> float:
    """k of the disc: (1 - c) h(k) = 1; ValueError for a centre out of reach."""
    if not 0.0 <= centre <= 1.0 - 1.0 / _height(REACH):
        raise ValueError(f"centre is {centre:.6g}: it must lie in [0, {1.0 - 1.0 / _height(REACH):.4g}]")
    return bracketed_root(lambda x: (1.0 - centre) * _height(x) - 1.0, 0.0, REACH) if centre else 0.0


def disc_load(centre: float) -> float:
    """Load that holds the centre c: (1 - c)^3 k^2 (Y. Guo, Z. Pan, M. J. Ward, SIAM J. Appl. Math. 66 (2005) 309)."""
    return (1.0 - centre) ** 3 * _scale(centre) ** 2


def disc_shape(centre: float, r: float) -> float:
    """u at the radius r, in radii of the disc."""
    return (1.0 - centre) * _height(_scale(centre) * r) - 1.0


@cache
def disc_pull_in() -> PullIn:
    """Load 0.789229268 at 0.444292284: the load k^2 / h(k)^3 is largest where 2 h = 3 k h'."""

    def slope(k: float) -> float:
        height, rate = _similarity()(k)
        return float(2.0 * height - 3.0 * k * rate)

    centre = 1.0 - 1.0 / _height(bracketed_root(slope, 1.0, 4.0))
    return PullIn(centre, disc_load(centre))


def fringe(limit: PullIn) -> float:
    """a in the pull-in of a small gap, load {1 + a (g/L)^2 ln(L/g) + O(g/L)^2}: 3 load / pi^2, strip and disc.

    On its upper face, far from the edge in gaps, a membrane beside a plane at 0 has the field V / (pi s) at the
    distance s from the edge, and a pressure there of (g / pi s)^2 times that of the gap. At the fold the load rises
    by the mean of this with the weight f = du/dcentre over that of (1 + u)^-2. f vanishes like s on the edge: a
    logarithm, cut off at s = g. The second mean is, with the field x . grad u in Green's formula beside f, the edge's
    f' u' / 2 load times x; and x u' = 2/3 on the edge of every u = (1 - c) h(k x) - 1 whose load k^2 / h^3 is largest.
    """
    return 3.0 * limit.load / math.pi**2


def centre_at(load: float, body: Literal["plate", "strip", "disc"], branch: Branch = "stable") -> float:
    """Deflection of the centre over the gap at a held voltage; ValueError above the pull-in.

    The unstable branch of the disc is the first one beyond the pull-in: further folds follow at centre > 0.9.
    """
    curves: dict[str, tuple[Callable[[float], float], PullIn, float]] = {
        "plate": (plate_load, PLATE, 1.0),
        "strip": (strip_load, strip_pull_in(), 1.0 - 1e-12),
        "disc": (disc_load, disc_pull_in(), 0.86),
    }
    curve, limit, end = curves[body]
    if not 0.0 <= load <= limit.load:
        raise ValueError(f"load {load:.6g} exceeds the pull-in at {limit.load:.6g}, or is negative")
    low, high = (0.0, limit.centre) if branch == "stable" else (limit.centre, end)
    return bracketed_root(lambda centre: curve(centre) - load, low, high)
