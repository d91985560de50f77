"""A rigid plate on a spring pulled in over an electrode, in the limit of a thin gap: at a third of the gap.

Physics: the attraction grows as the inverse square of what is left of the gap g, the spring's force k x with x alone:
beyond x = g/3 no voltage holds the plate. It is the thick middle of a disc; the stretched film around it is the
spring, out of the reach of the field, as the electrode is smaller than the plate. Arc length finds the limit point.

Reference: `problems.exact.mems`, load eps0 A V^2 / (2 k g^3) = 4/27 (H. C. Nathanson et al., IEEE Trans. Electron
Devices 14 (1967) 117), less 8/(3 pi) g/a of it for the fringes of an electrode of radius a. What these leave out is
[c ln(a/g) + d] (g/a)^2: three gaps, each half of the one before, give the limit. k is the field's force over x at the
first step with a voltage, and is the same at the others.

Run: about ten seconds; with ``fine``, gaps half as large, half a minute.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from embedding import Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Array, Probe, Reading, print_files
from problems.exact import mems

SCENE = Path(__file__).with_suffix(".toml")
RATIOS, FINE = (0.16, 0.08, 0.04), (0.1, 0.05, 0.025)
"""Gaps over the radius of the electrode; 0.05 is that of the scene file."""
RADIUS = 0.05
"""Of the electrode, m."""


class Charged(NamedTuple):
    """What happened under a voltage, step by step: deflection x in gaps, and over their thin-gap laws the field's
    force eps A V^2 / (2 (g - x)^2); spring constant k in N/m; at the pull-in the load and x in gaps."""

    deflection: Array
    force: Array
    spring: Array
    pull_in: mems.PullIn


def scene(*changes: str) -> Scene:
    """The scene file with overrides."""
    return load_scene(SCENE, changes)


def gap(scene: Scene) -> float:
    """Between the plate and the electrode, in m; ValueError without a cylinder below it."""
    bodies = () if scene.ambient is None else scene.ambient.bodies
    if not bodies or bodies[0].kind != "cylinder":
        raise ValueError("the electrode is a cylinder")
    return -bodies[0].centre[2] - bodies[0].length / 2.0


def at(ratio: float) -> tuple[str, ...]:
    """Overrides for another gap over radius, at the same load in units of the limit."""
    stated = scene()
    factor, until = ratio * RADIUS / gap(stated), stated.path[-1].until
    assert stated.faces.both is not None and stated.faces.both.voltage is not None
    assert until is not None and stated.discretisation.shell_size is not None
    end = f"{{where = {list(until.where)!r}, axis = '{until.axis}', value = {factor * until.value!r}}}"
    centre = [0.0, 0.0, -factor * gap(stated) - 0.005]
    return (
        f"ambient.bodies=[{{kind = 'cylinder', centre = {centre}, radius = {RADIUS}, length = 0.01, voltage = '0 V'}}]",
        f"faces.both.voltage={factor**1.5 * stated.faces.both.voltage!r}",
        f"discretisation.shell_size={min(factor, 1.0) * stated.discretisation.shell_size!r}",  # resolves the edge
        f"path=[{{name = 'stretching', steps = 2, field = 0.0}}, {{name = 'charging', until = {end}}}]",
    )


def run(*changes: str, archive: Path | None = None) -> tuple[Solution, Charged]:
    """Solve the scene with overrides; ValueError if it has no limit point.

    x is that of the plate at 1/sqrt(2) of the electrode's radius: the mean over the electrode as it sags.
    """
    probe = Probe({"x": Reading((RADIUS / math.sqrt(2.0), 0.0, 0.0), "z", -1.0)})
    solution = solve(scene(*changes), archive=archive, listeners=[probe])
    charged = solution["voltage"] > 0.0
    x, voltage = np.array(probe.values["x"])[charged], solution["voltage"][charged]
    force = -solution["force_z"][charged]
    g, plates = gap(solution.scene), EPSILON_0 * math.pi * RADIUS**2 / 2.0
    for point in solution.critical_points:
        if point.kind == "limit":
            spring = force[0] / x[0]
            load = plates * point.scalars["voltage"] ** 2 / (spring * g**3)
            pull_in = mems.PullIn(-point.scalars["force_z"] / (spring * g), load)
            return solution, Charged(x / g, force / (plates * (voltage / (g - x)) ** 2), force / x, pull_in)
    raise ValueError("the path has no limit point")


def extrapolated(ratios: Sequence[float], found: Sequence[mems.PullIn]) -> mems.PullIn:
    """The pull-in of a thin gap, from that at three ratios r of gap and radius, less the fringes' known part in r:
    both loads and places go on with [c ln(1/r) + d] r^2."""
    r = np.array(ratios)
    terms = np.column_stack([np.ones(3), -(r**2) * np.log(r), r**2])
    slopes = mems.plate_fringe()
    loads = np.array([each.load for each in found]) - slopes.load * r
    places = np.array([each.centre for each in found]) - slopes.centre * r
    return mems.PullIn(float(np.linalg.solve(terms, places)[0]), float(np.linalg.solve(terms, loads)[0]))


if __name__ == "__main__":
    ratios = FINE if sys.argv[1:] == ["fine"] else RATIOS
    found = []
    for ratio in ratios:
        solution, charged = run(*at(ratio), archive=Path("plate_pull_in.vtkhdf") if ratio == ratios[-1] else None)
        found.append(charged.pull_in)
        print(f"gap {ratio:<5} of the radius: pull-in at {found[-1].centre:.5f} of it, load {found[-1].load:.6f}")
    limit, known = extrapolated(ratios, found), mems.PLATE
    print(f"extrapolated: load {limit.load:.6f}, known {known.load:.6f}: {limit.load / known.load - 1.0:+.1e}")
    print(f"at {limit.centre:.5f} of the gap, known {known.centre:.5f}: {limit.centre / known.centre - 1.0:+.1e}")
    print_files(solution)
