"""A hard-magnetic strip in ever stronger fields, across it and against it, until it folds on itself."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from functools import cache, partial

import numpy as np

from embedding.bench.extremes.cell import RIGHT, TOLD, Cell, Numbers
from embedding.scene import Scene

LOADS = (0.1, 1.0, 5.0, 25.0, 100.0, 1e3, 1e5)
"""a = 12 B_r B L^2 / (mu0 E T^2) of a strip, with E = 4 mu."""
LENGTH, RATIO, REMANENCE, FIELD = 0.1, 1e-5, 0.1, 3e4
"""So thin that what the elastica leaves out is small beside the load: the field pulls the strip longer by a T^2 / 12
L^2, and its layer L / a^(1/2) at the clamp is hundreds of thicknesses."""
LAYER = 20.0
"""From this root of the load on the tip lies along the field to exp(-20)."""
ANGLES = {"across": 0.5 * math.pi, "nearly against": math.radians(179.0)}


def cells() -> list[Cell]:
    """A strip clamped at one end, with its remanence along it."""
    found = [_cell(row, load) for row in ANGLES for load in LOADS]
    return found + [_cell(row, LOADS[-1], within=True) for row in ANGLES]


def _cell(row: str, load: float, *, within: bool = False) -> Cell:
    """In elements of a twentieth of the length, whatever the load, or ``within`` the layer: there the error estimate
    knows what the health of the solution alone told before."""
    name = f"strip, field {row}" + (", elements within the layer" if within else "")
    coarse = (row == "nearly against" and load >= 1e3) or (load == LOADS[-1] and not within)
    return Cell(
        "remanence", name, f"a = {load:g}", partial(_scene, row, load, 1.0 / math.sqrt(load) if within else 0.05),
        partial(_tip, row, load), "the elastica of a hard-magnetic beam (Zhao et al. 2019)", tolerance=1e-3,
        warnings=("magnetic layer",),  # the beam bends within a part of the element at the clamp
        expected=TOLD if coarse else RIGHT, slow=load != 25.0, seconds=400.0,
    )  # fmt: skip


@cache
def _tip(row: str, load: float) -> Numbers:
    """Displacement of the tip of the inextensible beam t'' = a sin(t - angle), t(0) = 0, t'(1) = 0.

    With q = angle - t, which falls to q1 at the tip, q'^2 = 2 a (cos q1 - cos q): the length of the beam gives q1, and
    integrals over q the place of the tip. In strong fields q1 vanishes like exp(-a^(1/2)), and the beam bends in a
    layer at the clamp: there q' = -2 a^(1/2) sin(q/2).
    """
    angle, root = ANGLES[row], math.sqrt(load)
    if root > LAYER:
        along, across = 1.0 - 2.0 / root * (1.0 - math.cos(0.5 * angle)), 2.0 / root * math.sin(0.5 * angle)
    else:
        along, across = _pendulum(angle, load)
    cos, sin = math.cos(angle), math.sin(angle)
    tip = {"u_tip_x": LENGTH * (along * cos + across * sin - 1.0), "u_tip_y": LENGTH * (along * sin - across * cos)}
    if load < 1.0:  # the shortening by bending is no larger than that by the pull along the strip, of second order in T
        del tip["u_tip_x"]
    return tip


def _pendulum(angle: float, load: float) -> tuple[float, float]:
    """Extent of the beam along the field and across it."""
    from scipy.integrate import quad
    from scipy.optimize import brentq

    def integral(q1: float, weight: Callable[[float], float]) -> float:
        def integrand(s: float) -> float:  # q = q1 + s^2 takes the root at the tip away
            fall = 2 * math.sin(q1 + 0.5 * s * s) * (0.5 * float(np.sinc(0.5 * s * s / math.pi)))  # over s^2
            return weight(q1 + s * s) * 2 / math.sqrt(2 * load * fall)

        knee = math.sqrt(min(10 * q1, 0.5 * (angle - q1)))
        ends = (0.0, knee, math.sqrt(angle - q1))
        return float(sum(quad(integrand, a, b, limit=400)[0] for a, b in itertools.pairwise(ends)))

    def excess(logarithm: float) -> float:
        return integral(math.exp(logarithm), lambda _: 1.0) - 1.0

    q1 = math.exp(brentq(excess, -60.0, math.log(angle * (1 - 1e-12)), xtol=1e-14))
    return integral(q1, math.cos), integral(q1, math.sin)


def _scene(row: str, load: float, element: float) -> Scene:
    modulus = 12 * REMANENCE * FIELD / (4 * RATIO**2 * load)
    angle = ANGLES[row]
    return Scene.from_table(
        {
            "shell": {
                "shape": {"kind": "strip", "length": LENGTH},
                "thickness": RATIO * LENGTH,
                "material": {"law": "neo-hookean", "shear_modulus": modulus},
                "remanence": [REMANENCE, 0.0, 0.0],
            },
            "supports": [{"where": "x0", "kind": "clamped"}],
            "ambient": {
                "field": "magnetic",
                "applied_field": [FIELD * math.cos(angle), FIELD * math.sin(angle), 0.0],
            },
            "model": {"coupling": "unperturbed"},
            "discretisation": {"shell_size": 0.05 * LENGTH, "edge_size": {"x0": element * LENGTH}},
            "output": {"points": {"tip": [LENGTH, 0.0, 0.0]}},
        }
    )
