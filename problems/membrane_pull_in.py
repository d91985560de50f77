"""Stretched membranes, a strip and a disc, pulled in over a rigid electrode, in the limit of a thin gap.

Physics: opposite charges attract the membrane towards the electrode, the more the nearer it comes: at a largest voltage
no tension holds it any more. Arc length finds that as a limit point; beyond it the membrane would snap on.

Reference: `problems.exact.mems`, loads 1.400016 (strip) and 0.789229 (disc) for gaps without fringes and small slopes
(J. A. Pelesko, D. H. Bernstein, Modeling MEMS and NEMS, 2002). What they leave out, fringes and slopes, is
[a ln(L/g) + b] (g/L)^2 of them: three gaps, each half of the one before, give the limit and a, which is known too.

Run: half a minute; with ``fine``, gaps half as large, a minute.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from embedding import Disc, Listener, NeoHookean, Scene, Solution, load_scene, solve
from embedding.scene.scales import EPSILON_0
from problems.common import Probe, Reading, print_files
from problems.exact import mems

SCENES = {name: Path(__file__).with_name(f"{name}.toml") for name in ("membrane_pull_in", "membrane_pull_in_disc")}
STRIP, DISC = SCENES
RATIOS, FINE = (0.1, 0.05, 0.025), (0.05, 0.025, 0.0125)
"""Gaps over the size of the membrane; 0.05 is that of the scene files."""


def scene(name: str = STRIP, *changes: str) -> Scene:
    """The scene file ``name`` with overrides."""
    return load_scene(SCENES[name], changes)


def at(name: str, ratio: float) -> tuple[str, ...]:
    """Overrides for another gap over size, at the same load in units of the limit."""
    stated = scene(name)
    factor = ratio * stated.shell.shape.size / gap(stated)
    new, voltage = factor * gap(stated), factor**1.5 * full_voltage(stated)
    edges = ", ".join(f"{edge} = {factor * size!r}" for edge, size in stated.discretisation.edge_size.items())
    until = stated.path[-1].until
    assert until is not None
    end = f"{{where = {list(until.where)!r}, axis = '{until.axis}', value = {factor * until.value!r}}}"
    return (
        f"ambient.bodies=[{{kind = 'half-space', level = {-new!r}, voltage = '0 V'}}]",
        f"faces.both.voltage={voltage!r}",
        f"discretisation.edge_size={{{edges}}}",
        f"path=[{{name = 'stretching', steps = 2, field = 0.0}}, {{name = 'charging', until = {end}}}]",
    )


def run(
    name: str, *changes: str, archive: Path | None = None, listeners: Sequence[Listener] = ()
) -> Solution:
    """Solve the scene ``name`` with overrides."""
    return solve(scene(name, *changes), archive=archive, listeners=listeners)


def gap(scene: Scene) -> float:
    """Between the flat membrane and the electrode, in m; ValueError without a half-space."""
    if scene.ambient is None or not scene.ambient.bodies or scene.ambient.bodies[0].kind != "half-space":
        raise ValueError("the reference has a half-space as its electrode")
    return -scene.ambient.bodies[0].level


def full_voltage(scene: Scene) -> float:
    """Voltage of the membrane at the end of the path, in V; ValueError where it is not given."""
    if scene.faces.both is None or scene.faces.both.voltage is None:
        raise ValueError("the membrane has a voltage")
    return scene.faces.both.voltage


def tension(scene: Scene) -> tuple[float, float]:
    """(N, L): force per deformed length, N/m, and the size of the stretched membrane, m: width or radius.

    ValueError for another material than neo-Hooke.
    """
    if not isinstance(scene.shell.material, NeoHookean):
        raise ValueError("the stretch is that of neo-Hooke")
    stiffness = scene.shell.material.shear_modulus * scene.shell.thickest
    traction, power = scene.loads.edge_tractions[0].traction[0], 5 if isinstance(scene.shell.shape, Disc) else 3
    stretch = mems.bracketed_root(lambda s: stiffness * (s - s**-power) - traction, 1.0, 2.0)
    size = stretch * scene.shell.shape.size
    return (traction / stretch if isinstance(scene.shell.shape, Disc) else traction), size


def pull_in(solution: Solution) -> float:
    """Load eps0 V^2 L^2 / (2 N g^3) at the first limit point; ValueError if there is none."""
    scene = solution.scene
    (force, size), height = tension(scene), gap(scene)
    for point in solution.critical_points:
        if point.kind == "limit":
            voltage = point.scalars["voltage"]
            return EPSILON_0 * voltage**2 * size**2 / (2.0 * force * height**3)
    raise ValueError("the path has no limit point")


def known(name: str) -> mems.PullIn:
    """The thin-gap limit."""
    return mems.disc_pull_in() if name == DISC else mems.strip_pull_in()


def extrapolated(ratios: Sequence[float], loads: Sequence[float]) -> tuple[float, float]:
    """(limit, a) of load = limit {1 + [a ln(1/r) + b] r^2} through three loads at the ratios r of gap and size.

    A power alone misses the logarithm: from gaps of L/5, L/10 and L/20 it leaves 3e-4 of the strip's load. What is
    left here falls with the third power of the gap.
    """
    square = np.square(ratios)
    terms = np.column_stack([np.ones(3), -square * np.log(ratios), square])
    limit, logarithm, _ = np.linalg.solve(terms, loads)
    return float(limit), float(logarithm / limit)


def centre(name: str) -> Probe:
    """Records the displacement "centre" of the middle towards the electrode, in m."""
    until = scene(name).path[-1].until
    assert until is not None
    return Probe({"centre": Reading(until.where, until.axis, -1.0)})


if __name__ == "__main__":
    ratios = FINE if sys.argv[1:] == ["fine"] else RATIOS
    for name in (DISC, STRIP):
        solutions = [run(name, *at(name, ratio)) for ratio in ratios[:-1]]
        solutions.append(run(name, *at(name, ratios[-1]), archive=Path(f"{name}.vtkhdf")))
        loads = [pull_in(solution) for solution in solutions]
        for ratio, load in zip(ratios, loads, strict=True):
            print(f"{name}: gap {ratio:<6} of the size, pull-in at the load {load:.6f}")
        limit, logarithm = extrapolated(ratios, loads)
        exact = known(name)
        print(f"extrapolated: {limit:.6f}, known {exact.load:.6f}: {limit / exact.load - 1.0:+.1e}")
        print(f"coefficient of the logarithm: {logarithm:.3f}, known {mems.fringe(exact):.3f}")
    print_files(solutions[-1])
